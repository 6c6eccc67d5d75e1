// Exposures that photos state, against those that their pixels show.
//
//   r_ab = median over pixels of ln (Y_a / Y_b),   Y = counts / stated exposure, a and b of one pose and
//   state min over delta of sum ((delta_a - delta_b - r_ab) / sigma_ab)^2 + sum ln(1 + (delta_i / prior)^2)
//
// True exposure = stated * exp(delta). Times are stated as labels (1/60 s is 1/64 s in most cameras),
// shutters err by a percent or two, and some files lie: automatic ISO, a missing or a copied time. The prior
// is of heavy tails (Cauchy), so that one photo that is far off leaves the others where they are.
//
// Gauge: ratios say nothing of a factor common to all; the prior puts it where most photos are right. With
// two photos it cannot tell which of them is off.
//
// Throws std::invalid_argument for photos out of range, sigmas that are not > 0, images of different sizes.
// Source: house; the prior's reweighting as Holland and Welsch (1977).
#ifndef LUXFIT_CALIB_LUMINANCE_EXPOSURE_GAINS_H_
#define LUXFIT_CALIB_LUMINANCE_EXPOSURE_GAINS_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calib/luminance/luminance.h"

namespace luxfit {

struct ExposureRatio {
  int first = 0, second = 0;  // photos
  double log_ratio = 0;       // 0: as stated
  double sigma = 0;
  int pixels = 0;
};

// Over pixels valid in both and of at least `min_share` of full scale in both, every third in each direction.
// `exposure_s` as in ToRelativeLuminance, to know that share. Empty for fewer than 100 such pixels. The sigma
// is of the median, from the median absolute deviation, and never below 0.1 % (neighbours are no independent
// evidence).
struct RatioOptions {
  double min_share = 0.02;
};
std::optional<ExposureRatio> MeasureRatio(const LuminanceImage& first, double first_exposure_s,
                                          const LuminanceImage& second, double second_exposure_s,
                                          const RatioOptions& options = {});

struct ExposureGains {
  Eigen::VectorXd log_gain;  // delta, one a photo; 0 where no ratio concerns it
  Eigen::VectorXd sigma;
  std::vector<int> off;  // photos whose stated exposure is wrong: beyond `least` and four sigmas
};

struct ExposureGainsOptions {
  double prior = 0.02;  // of ln exposure: labels are rounded and shutters err by about this
  double least = 0.03;  // of ln exposure: less is worth no warning
};

ExposureGains SolveGains(int photos, const std::vector<ExposureRatio>& ratios,
                         const ExposureGainsOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_EXPOSURE_GAINS_H_
