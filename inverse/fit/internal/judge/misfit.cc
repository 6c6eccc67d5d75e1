#include "inverse/fit/internal/judge/misfit.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace luxfit {
namespace {

constexpr double kUnexplained = 0.25;  // robust weight at five sigmas
constexpr double kLargeShare = 0.15;
constexpr double kNoShare = 0.005;  // would read as 0 %
// Errors of single rows average out, up to kVeryLargeError; what neighbours share is light that moves luminaires.
constexpr double kLargeError = 0.02, kLargeSharedError = 0.01, kVeryLargeError = 0.05;

struct Count {
  int unexplained = 0, all = 0;
  double Share() const { return all > 0 ? static_cast<double>(unexplained) / all : 0; }
  void Add(double weight) {
    unexplained += weight < kUnexplained ? 1 : 0;
    ++all;
  }
};

struct Misfit {
  Count all;
  std::map<std::string, Count> of_material;
  std::map<int, Count> of_state;
};

Misfit MisfitOf(const Room& room, const RoomFit& result) {
  Misfit misfit;
  for (size_t i = 0; i < result.data.observations.size() && result.fit.weight.size() > 0; ++i) {
    const double weight = result.fit.weight[static_cast<Eigen::Index>(i)];
    if (weight == 0) continue;
    const Observation& o = result.data.observations[i];
    const auto material = static_cast<size_t>(room.patches.PatchOf(o.element).material);
    misfit.all.Add(weight);
    misfit.of_material[room.scene.materials[material]].Add(weight);
    misfit.of_state[o.state].Add(weight);
  }
  return misfit;
}

// Returns the materials with more than the usual share, with their shares.
std::string WorstMaterials(const Misfit& misfit) {
  std::string worst;
  for (const auto& [material, count] : misfit.of_material)
    if (count.Share() > misfit.all.Share())
      worst += fmt::format("{}{} ({:.0f} %)", worst.empty() ? "" : ", ", material, 100 * count.Share());
  return worst.empty() ? "all surfaces alike" : worst;
}

std::string HowWellExplained(const Misfit& misfit, double relative_sigma) {
  if (misfit.all.Share() < kNoShare)
    return fmt::format("the observations are explained to no better than {:.1f} % by any light on this mesh",
                       100 * relative_sigma);
  return fmt::format(
      "{:.0f} % of the observations are not explained by any light on this mesh, and the others to no better "
      "than {:.1f} %: most on {}",
      100 * misfit.all.Share(), 100 * relative_sigma, WorstMaterials(misfit));
}

// Returns the names of those that shine in a state.
std::string LuminairesOn(const RoomFit& result, int state) {
  std::vector<std::string> ids;
  const Eigen::VectorXd& dimming = result.data.dimming[static_cast<size_t>(state)];
  for (Eigen::Index k = 0; k < dimming.size(); ++k)
    if (dimming[k] > 0) ids.push_back(result.fit.state.luminaires[static_cast<size_t>(k)].id);
  return fmt::format("{}", fmt::join(ids, ", "));
}

bool IsErrorLarge(const LuminaireFit& fit) {
  return fit.relative_sigma >= kVeryLargeError ||
         (fit.relative_sigma >= kLargeError && fit.shared_relative_sigma >= kLargeSharedError);
}

}  // namespace

void WarnOfMisfit(const Room& room, const RoomFit& result, Findings& findings) {
  const Misfit misfit = MisfitOf(room, result);
  if (misfit.all.all == 0) return;
  const auto worst =
      std::max_element(misfit.of_state.begin(), misfit.of_state.end(),
                       [](const auto& a, const auto& b) { return a.second.Share() < b.second.Share(); });
  const bool is_of_state = worst->second.Share() >= kLargeShare;
  if (!is_of_state && !IsErrorLarge(result.fit)) return;
  std::string message = HowWellExplained(misfit, result.fit.relative_sigma) +
                        "; luminaires may lie far from where they are given, beyond their sigmas";
  if (is_of_state)
    message += fmt::format("; most where {} shine: {:.0f} %", LuminairesOn(result, worst->first),
                           100 * worst->second.Share());
  findings.warnings.push_back(
      {"model_misfit", std::move(message),
       "compare the mesh with the photos: furniture that is missing or was moved, mirrors, "
       "windows, a luminaire that [states] does not name",
       is_of_state});
}

}  // namespace luxfit
