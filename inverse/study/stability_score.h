// Scores a fit of degraded data against reference luminaires, and checks whether its sigmas cover the errors.
//
//   success            every luminaire of the reference found within tolerance of its place and flux
//   confident wrong    one is out of tolerance and out of its own 95 % interval, and nothing warned of it
//   interval           position: sum_axes (error / sigma)^2 <= 7.81 (chi-square, 3)
//                      flux: |error| <= 1.96 sigma
//
// Luminaires are matched by id. Where the reference's id is not among those found (their number was
// estimated), the nearest one left is taken. Quantities that were given and not fitted (sigma 0) have no
// interval. Unit: m; flux has the same unit in both.
// Source: own.
#ifndef LUXFIT_INVERSE_STUDY_STABILITY_SCORE_H_
#define LUXFIT_INVERSE_STUDY_STABILITY_SCORE_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace luxfit {

struct EstimatedLuminaire {
  std::string id;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d position_sigma_m = Eigen::Vector3d::Zero();  // NaN: not determined
  double flux = 0;
  double flux_sigma = 0;
};

struct StabilityTolerance {
  double position_m = 0.05;
  double flux_relative = 0.1;
};

struct FitScore {
  bool is_success = false;
  bool is_confident_wrong = false;
  int missing = 0;              // luminaires of the reference that were not found
  double position_error_m = 0;  // median over luminaires; NaN: none was found
  double flux_error = 0;        // relative, likewise
  double worst_position_m = 0;  // likewise
  double worst_flux = 0;
  int intervals = 0, intervals_held = 0;  // for position and flux, where there is one
};

FitScore ScoreFit(const std::vector<EstimatedLuminaire>& found,
                  const std::vector<EstimatedLuminaire>& reference, bool has_warning,
                  const StabilityTolerance& tolerance = {});

// Summarizes the trials of one level of one degradation.
struct LevelSummary {
  int trials = 0, successes = 0, confident_wrong = 0;
  int intervals = 0, intervals_held = 0;
  double median_position_error_m = 0;  // median of the trials' medians; NaN: no trial has one
  double median_flux_error = 0;

  double SuccessRate() const { return trials > 0 ? static_cast<double>(successes) / trials : 0; }
  double ConfidentWrongRate() const { return trials > 0 ? static_cast<double>(confident_wrong) / trials : 0; }
};
LevelSummary SummarizeTrials(const std::vector<FitScore>& trials);

// Returns the index of the first level whose success rate is below `least`; none where all are good.
std::optional<size_t> FirstBadLevel(const std::vector<LevelSummary>& levels, double least = 0.9);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_STUDY_STABILITY_SCORE_H_
