#include "forward/luminaire/luminaire_parts.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "forward/luminaire/distribution_ops.h"

namespace luxfit {
namespace {

bool IsRotational(const Luminaire& luminaire) {
  return OpsOf(luminaire.distribution).has_table && luminaire.table != nullptr &&
         luminaire.table->c_rad.size() == 2;
}

// The node at the horizontal is the lower side's, with a tolerance for angles from files in degrees.
bool IsAbove(double gamma_rad) { return gamma_rad > M_PI / 2 + 1e-6; }

constexpr Eigen::Index kSides = 2;

Eigen::Index PartCount(const Luminaire& luminaire, PartKind kind) {
  if (kind == PartKind::kCell) return HasUnevenEmission(luminaire) ? luminaire.emission.size() : 0;
  if (!IsRotational(luminaire)) return 0;
  const std::vector<double>& gamma_rad = luminaire.table->gamma_rad;
  if (kind == PartKind::kGammaNode) return static_cast<Eigen::Index>(gamma_rad.size());
  return !IsAbove(gamma_rad.front()) && IsAbove(gamma_rad.back()) ? kSides : 0;
}

// Shares of the flux by node.
Eigen::VectorXd NodeShares(const IntensityTable& table) {
  const auto nodes = static_cast<Eigen::Index>(table.gamma_rad.size());
  return Eigen::Map<const Eigen::VectorXd>(table.cd_per_lm.data(), nodes)
      .cwiseProduct(NodeFlux(table.gamma_rad));
}

// Shares of the flux by side and node, sides x nodes.
Eigen::MatrixXd SharesBySide(const IntensityTable& table) {
  const Eigen::VectorXd shares = NodeShares(table);
  Eigen::MatrixXd by_side = Eigen::MatrixXd::Zero(kSides, shares.size());
  for (Eigen::Index j = 0; j < shares.size(); ++j)
    by_side(IsAbove(table.gamma_rad[static_cast<size_t>(j)]) ? 1 : 0, j) = shares[j];
  return by_side;
}

}  // namespace

bool HasUnevenEmission(const Luminaire& luminaire) {
  return luminaire.shape == LuminaireShape::kRectangle && luminaire.emission.size() > 0;
}

// FluxIntegral's closed form, for each node's share of the straight pieces beside it.
Eigen::VectorXd NodeFlux(const std::vector<double>& gamma_rad) {
  Eigen::VectorXd flux = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(gamma_rad.size()));
  for (size_t g = 1; g < gamma_rad.size(); ++g) {
    const double a = gamma_rad[g - 1], b = gamma_rad[g];
    const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
    const double rising = std::cos(middle) * std::sin(half) / half - std::cos(b);
    const auto node = static_cast<Eigen::Index>(g);
    flux[node] += 2 * M_PI * rising;
    flux[node - 1] += 2 * M_PI * (2 * std::sin(middle) * std::sin(half) - rising);
  }
  return flux;
}

IntensityTable RotationalTable(const std::vector<double>& gamma_rad, const std::vector<double>& intensity) {
  return Normalized(ExpandPlanes({0}, gamma_rad, intensity, PlaneSymmetry::kRotational));
}

Eigen::VectorXd PartShares(const Luminaire& luminaire, PartKind kind) {
  const Eigen::Index n = PartCount(luminaire, kind);
  if (n == 0) return {};
  if (kind == PartKind::kCell) return Eigen::Map<const Eigen::VectorXd>(luminaire.emission.data(), n);
  if (kind == PartKind::kSide) return SharesBySide(*luminaire.table).rowwise().sum();
  return NodeShares(*luminaire.table);
}

Eigen::MatrixXd NodesOfSides(const Luminaire& luminaire) {
  if (PartCount(luminaire, PartKind::kSide) == 0)
    throw std::invalid_argument("NodesOfSides: expected a table with two sides");
  Eigen::MatrixXd nodes = SharesBySide(*luminaire.table);
  for (Eigen::Index side = 0; side < kSides; ++side) {
    const double share = nodes.row(side).sum();
    if (share > 0) nodes.row(side) /= share;
  }
  return nodes;
}

IntensityTable TwoSidedTable(double share_up) {
  if (!(share_up >= 0) || !(share_up <= 1))
    throw std::invalid_argument("TwoSidedTable: expected a share from 0 to 1");
  constexpr int kNodes = 73;  // every 2.5 degrees: the chords lie within 0.03 % of the cosine
  std::vector<double> gamma_rad, intensity;
  gamma_rad.reserve(kNodes), intensity.reserve(kNodes);
  for (int j = 0; j < kNodes; ++j) {
    gamma_rad.push_back(j * M_PI / (kNodes - 1));
    const double cosine = j == kNodes / 2 ? 0 : std::cos(gamma_rad.back());
    intensity.push_back(std::max((1 - share_up) * cosine, -share_up * cosine));
  }
  return RotationalTable(gamma_rad, intensity);
}

Luminaire WithPartShares(const Luminaire& luminaire, PartKind kind, const Eigen::VectorXd& shares) {
  const Eigen::Index parts = PartCount(luminaire, kind);
  if (parts == 0 || shares.size() != parts)
    throw std::invalid_argument("WithPartShares: expected one share a part of the luminaire");
  const double sum = shares.sum();
  if (!(shares.minCoeff() >= 0) || !(sum > 0) || !std::isfinite(sum))
    throw std::invalid_argument("WithPartShares: expected shares >= 0 with a sum above 0");
  Luminaire result = luminaire;
  if (kind == PartKind::kCell) {
    Eigen::Map<Eigen::VectorXd>(result.emission.data(), parts) = shares / sum;
    return result;
  }
  const std::vector<double>& gamma_rad = luminaire.table->gamma_rad;
  const Eigen::VectorXd node_shares =
      kind == PartKind::kSide ? (NodesOfSides(luminaire).transpose() * shares).eval() : shares;
  const Eigen::VectorXd cd_per_lm = node_shares.cwiseQuotient(NodeFlux(gamma_rad)) / sum;
  const auto nodes = static_cast<Eigen::Index>(gamma_rad.size());
  auto table = std::make_shared<IntensityTable>(
      RotationalTable(gamma_rad, {cd_per_lm.data(), cd_per_lm.data() + nodes}));
  table->table_from_luminaire = luminaire.table->table_from_luminaire;
  result.table = std::move(table);
  return result;
}

Luminaire PartOf(const Luminaire& luminaire, PartKind kind, int part) {
  const Eigen::Index parts = PartCount(luminaire, kind);
  if (part < 0 || part >= parts)
    throw std::invalid_argument("PartOf: expected a part that the luminaire has");
  Luminaire alone = WithPartShares(luminaire, kind, Eigen::VectorXd::Unit(parts, part));
  if (kind != PartKind::kCell) {
    // The number of points on the luminous surface goes by the lobe's peak.
    auto table = std::make_shared<IntensityTable>(*alone.table);
    table->peak_cd_per_lm = luminaire.table->peak_cd_per_lm;
    alone.table = std::move(table);
  }
  return alone;
}

std::vector<LuminaireCell> CellsOf(const Luminaire& luminaire) {
  if (!HasUnevenEmission(luminaire)) return {{luminaire, Eigen::Vector2d::Zero()}};
  const Eigen::Array2d counts(static_cast<double>(luminaire.emission.rows()),
                              static_cast<double>(luminaire.emission.cols()));
  const LuminaireAxes axes = AxesOf(luminaire);
  Luminaire cell = luminaire;
  cell.emission.resize(0, 0);
  cell.size_m = luminaire.size_m.array() / counts;
  std::vector<LuminaireCell> cells;
  cells.reserve(static_cast<size_t>(luminaire.emission.size()));
  for (Eigen::Index j = 0; j < luminaire.emission.cols(); ++j) {
    for (Eigen::Index i = 0; i < luminaire.emission.rows(); ++i) {
      if (luminaire.emission(i, j) == 0) continue;
      const Eigen::Array2d index(static_cast<double>(i), static_cast<double>(j));
      const Eigen::Vector2d place = (index + 0.5) / counts - 0.5;
      cell.position = luminaire.position + place[0] * luminaire.size_m[0] * axes.along +
                      place[1] * luminaire.size_m[1] * axes.across;
      cell.flux_lm = luminaire.flux_lm * luminaire.emission(i, j);
      cells.push_back({cell, place});
    }
  }
  return cells;
}

}  // namespace luxfit
