#include "forward/luminaire/internal/flux_share.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "forward/room/internal/quadrature.h"

namespace luxfit {
namespace {

constexpr double kHorizontal = M_PI / 2;
constexpr double kWidestPiece = M_PI / 180;  // of gamma
constexpr int kPlanes = 144;                 // of C

// Where the integrand has kinks in gamma: the table's angles, the horizontal.
std::vector<double> Kinks(const IntensityTable& table) {
  std::vector<double> kinks = table.gamma_rad;
  kinks.push_back(kHorizontal);
  std::sort(kinks.begin(), kinks.end());
  return kinks;
}

struct GammaNode {
  double gamma, weight;
};
std::vector<GammaNode> GammaNodes(const IntensityTable& table) {
  const std::vector<double> kinks = Kinks(table);
  const std::vector<LineNode> rule = GaussLegendre(2);
  std::vector<GammaNode> nodes;
  for (size_t i = 1; i < kinks.size(); ++i) {
    const double width = kinks[i] - kinks[i - 1];
    const int pieces = static_cast<int>(std::ceil(width / kWidestPiece));
    for (int piece = 0; piece < pieces; ++piece) {
      for (const LineNode& node : rule)
        nodes.push_back({kinks[i - 1] + width * (piece + node.t) / pieces, width * node.weight / pieces});
    }
  }
  return nodes;
}

}  // namespace

FluxShares FluxSharesOf(const IntensityTable& table) {
  if (table.c_rad.size() < 2 || !table.table_from_luminaire.isIdentity())
    throw std::invalid_argument("FluxSharesOf: expected a table about the luminaire's own axis");
  FluxShares shares;
  double flux = 0;
  for (const GammaNode& node : GammaNodes(table)) {
    const double sine = std::sin(node.gamma), cosine = std::cos(node.gamma);
    for (int plane = 0; plane < kPlanes; ++plane) {
      const double c = (plane + 0.5) * 2 * M_PI / kPlanes, along = sine * std::cos(c),
                   across = sine * std::sin(c);
      const double lm = node.weight * sine * IntensityTowards(table, {along, across, -cosine}).cd_per_lm;
      flux += lm;
      if (node.gamma >= kHorizontal) continue;
      shares.downward += lm;
      for (size_t k = 0; k < kRoomIndices.size(); ++k) {
        const double side = 2 * kRoomIndices[k] * cosine;  // in h / cos(gamma), as along and across are
        shares.direct_ratio[k] +=
            lm * std::max(0.0, 1 - std::abs(along) / side) * std::max(0.0, 1 - std::abs(across) / side);
      }
    }
  }
  if (!(flux > 0)) throw std::invalid_argument("FluxSharesOf: expected a flux above 0");
  shares.downward /= flux;
  for (double& ratio : shares.direct_ratio) ratio /= flux;
  return shares;
}

}  // namespace luxfit
