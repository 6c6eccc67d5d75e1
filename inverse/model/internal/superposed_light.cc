#include "inverse/model/internal/superposed_light.h"

#include <Eigen/QR>
#include <map>
#include <utility>

namespace luxfit {
namespace {

constexpr double kExact = 1e-6;
// Least share of the sum in the magnitudes of its terms: differences of nearly equal terms are noise.
constexpr double kLeastLeft = 0.2;

// Returns the weights of the observed states that give `state`; empty: none do.
Eigen::VectorXd WeightsOf(const std::vector<Eigen::VectorXd>& dimming, const std::vector<int>& observed,
                          int state) {
  const Eigen::VectorXd& wanted = dimming[static_cast<size_t>(state)];
  Eigen::MatrixXd columns(wanted.size(), static_cast<Eigen::Index>(observed.size()));
  for (size_t o = 0; o < observed.size(); ++o)
    columns.col(static_cast<Eigen::Index>(o)) = dimming[static_cast<size_t>(observed[o])];
  Eigen::VectorXd weights = columns.completeOrthogonalDecomposition().solve(wanted);
  const bool is_exact = (columns * weights - wanted).norm() <= kExact * wanted.norm();
  return is_exact ? weights : Eigen::VectorXd();
}

// Returns the mean luminance by element and state.
std::map<int, std::map<int, double>> MeanOfViews(const LightData& data) {
  std::map<int, std::map<int, std::pair<double, int>>> sums;
  for (const Observation& o : data.observations) {
    auto& [sum, count] = sums[o.element][o.state];
    sum += o.relative_luminance;
    ++count;
  }
  std::map<int, std::map<int, double>> means;
  for (const auto& [element, states] : sums)
    for (const auto& [state, sum] : states) means[element][state] = sum.first / sum.second;
  return means;
}

}  // namespace

std::vector<SuperposedLight> SuperposeStates(const LightData& data) {
  const auto states = static_cast<int>(data.dimming.size());
  std::map<std::pair<std::vector<int>, int>, Eigen::VectorXd>
      known;  // weights, by observed states and the missing one
  std::vector<SuperposedLight> superposed;
  for (const auto& [element, shown] : MeanOfViews(data)) {
    if (static_cast<int>(shown.size()) == states) continue;
    std::vector<int> observed;
    Eigen::VectorXd luminance(static_cast<Eigen::Index>(shown.size()));
    for (const auto& [state, value] : shown) {
      luminance[static_cast<Eigen::Index>(observed.size())] = value;
      observed.push_back(state);
    }
    for (int state = 0; state < states; ++state) {
      if (shown.count(state) > 0 || data.dimming[static_cast<size_t>(state)].norm() == 0) continue;
      const auto [weights, is_new] = known.try_emplace({observed, state});
      if (is_new) weights->second = WeightsOf(data.dimming, observed, state);
      if (weights->second.size() == 0) continue;
      const double value = weights->second.dot(luminance),
                   terms = weights->second.cwiseAbs().dot(luminance.cwiseAbs());
      if (value > kLeastLeft * terms) superposed.push_back({element, state, value});
    }
  }
  return superposed;
}

}  // namespace luxfit
