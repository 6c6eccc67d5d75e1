#include "inverse/study/stability_score.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/luminance/median.h"

namespace luxfit {
namespace {

constexpr double kChiSquare3 = 7.815;  // 95 %, three degrees of freedom
constexpr double kNormal = 1.96;       // 95 %, both sides

// Returns for each luminaire of the reference the index of the one found; -1: none.
std::vector<int> Match(const std::vector<EstimatedLuminaire>& found,
                       const std::vector<EstimatedLuminaire>& reference) {
  std::vector<int> match(reference.size(), -1);
  std::vector<bool> taken(found.size(), false);
  for (size_t r = 0; r < reference.size(); ++r) {
    for (size_t f = 0; f < found.size(); ++f) {
      if (found[f].id != reference[r].id || taken[f]) continue;
      match[r] = static_cast<int>(f);
      taken[f] = true;
      break;
    }
  }
  for (size_t r = 0; r < reference.size(); ++r) {
    double nearest = std::numeric_limits<double>::infinity();
    if (match[r] >= 0) continue;
    for (size_t f = 0; f < found.size(); ++f) {
      const double distance = (found[f].position - reference[r].position).norm();
      if (!taken[f] && distance < nearest) nearest = distance, match[r] = static_cast<int>(f);
    }
    if (match[r] >= 0) taken[static_cast<size_t>(match[r])] = true;
  }
  return match;
}

struct Held {
  bool has_interval = false, is_held = true, is_determined = true;
};

Held PositionHeld(const EstimatedLuminaire& found, const Eigen::Vector3d& error) {
  Held held;
  held.is_determined = found.position_sigma_m.allFinite();
  held.has_interval = held.is_determined && found.position_sigma_m.minCoeff() > 0;
  if (held.has_interval)
    held.is_held = error.cwiseQuotient(found.position_sigma_m).squaredNorm() <= kChiSquare3;
  return held;
}

Held FluxHeld(const EstimatedLuminaire& found, double error) {
  Held held;
  held.is_determined = std::isfinite(found.flux_sigma) && std::isfinite(found.flux);
  held.has_interval = held.is_determined && found.flux_sigma > 0;
  if (held.has_interval) held.is_held = std::abs(error) <= kNormal * found.flux_sigma;
  return held;
}

}  // namespace

FitScore ScoreFit(const std::vector<EstimatedLuminaire>& found,
                  const std::vector<EstimatedLuminaire>& reference, bool has_warning,
                  const StabilityTolerance& tolerance) {
  FitScore score;
  std::vector<double> position, flux;
  bool is_within = true;
  const std::vector<int> match = Match(found, reference);
  for (size_t r = 0; r < reference.size(); ++r) {
    if (match[r] < 0) {
      ++score.missing;
      continue;
    }
    const EstimatedLuminaire& f = found[static_cast<size_t>(match[r])];
    const Eigen::Vector3d off = f.position - reference[r].position;
    const double flux_off = f.flux - reference[r].flux;
    const double flux_error = std::abs(flux_off) / std::max(reference[r].flux, 1e-12);
    const Held place = PositionHeld(f, off), power = FluxHeld(f, flux_off);
    for (const Held& held : {place, power}) {
      score.intervals += held.has_interval ? 1 : 0;
      score.intervals_held += held.has_interval && held.is_held ? 1 : 0;
    }
    const bool place_is_good = off.norm() <= tolerance.position_m;
    const bool flux_is_good = flux_error <= tolerance.flux_relative;
    is_within = is_within && place_is_good && flux_is_good && place.is_determined && power.is_determined;
    const bool misleads = (!place_is_good && place.is_determined && !place.is_held) ||
                          (!flux_is_good && power.is_determined && !power.is_held);
    score.is_confident_wrong = score.is_confident_wrong || (misleads && !has_warning);
    position.push_back(off.norm());
    if (std::isfinite(flux_error)) flux.push_back(flux_error);
  }
  score.is_success = is_within && score.missing == 0 && !reference.empty();
  score.position_error_m = Median(position);
  score.flux_error = Median(flux);
  score.worst_position_m =
      position.empty() ? score.position_error_m : *std::max_element(position.begin(), position.end());
  score.worst_flux = flux.empty() ? score.flux_error : *std::max_element(flux.begin(), flux.end());
  return score;
}

LevelSummary SummarizeTrials(const std::vector<FitScore>& trials) {
  LevelSummary summary;
  std::vector<double> position, flux;
  for (const FitScore& trial : trials) {
    ++summary.trials;
    summary.successes += trial.is_success ? 1 : 0;
    summary.confident_wrong += trial.is_confident_wrong ? 1 : 0;
    summary.intervals += trial.intervals;
    summary.intervals_held += trial.intervals_held;
    if (std::isfinite(trial.position_error_m)) position.push_back(trial.position_error_m);
    if (std::isfinite(trial.flux_error)) flux.push_back(trial.flux_error);
  }
  summary.median_position_error_m = Median(position);
  summary.median_flux_error = Median(flux);
  return summary;
}

std::optional<size_t> FirstBadLevel(const std::vector<LevelSummary>& levels, double least) {
  for (size_t i = 0; i < levels.size(); ++i) {
    if (levels[i].trials > 0 && levels[i].SuccessRate() < least) return i;
  }
  return std::nullopt;
}

}  // namespace luxfit
