// Reads what photos state about their exposure (EXIF), and compares it with what their pixels show.
//
//   relative exposure = exposure_s * (iso / 100) / f_number^2      counts per luminance, up to one constant
//   r_ab = median over pixels of ln (Y_a / Y_b),   Y = counts / stated exposure
//   min over delta of sum ((delta_a - delta_b - r_ab) / sigma_ab)^2 + sum ln(1 + (delta_i / prior)^2)
//
// Times and f-numbers are nominal: 1/60 s is 1/64 s in most cameras, f/5.6 is f/5.657. The steps of a
// camera's dial are powers of two and their thirds; the labels are rounded, by up to 7 %. Values that a file
// leaves out, or gives as zero or nonsense, are empty. Reading throws nothing: a file without EXIF, or an
// unreadable one, gives no values.
//
// a and b are photos of one pose and state. True exposure = stated * exp(delta). Times are stated as labels,
// and shutters err by a percent or two. Some files are wrong: automatic ISO, a missing or a copied time. The
// prior has heavy tails (Cauchy), so that one photo that is far off leaves the others where they are.
//
// Gauge: ratios do not determine a factor common to all photos; the prior puts it where most photos are
// right. With two photos the prior cannot tell which of them is off.
//
// Comparing throws std::invalid_argument for photos out of range, sigmas that are not > 0, images of
// different sizes.
// Source: EXIF 2.32 (CIPA DC-008), ExposureTime, FNumber, PhotographicSensitivity, and the APEX values
// ShutterSpeedValue and ApertureValue where those are missing; ISO 12232. The comparison is this project's;
// the prior's reweighting as Holland and Welsch (1977).
#ifndef LUXFIT_CALIB_LUMINANCE_EXPOSURE_H_
#define LUXFIT_CALIB_LUMINANCE_EXPOSURE_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calib/luminance/luminance.h"

namespace luxfit {

struct ExposureMetadata {
  std::optional<double> exposure_s;
  std::optional<double> f_number;
  std::optional<double> iso;
};

// Returns what the file states.
ExposureMetadata ReadExposureMetadata(const std::string& path);

struct ExposureRatio {
  int first = 0, second = 0;  // indices of the two photos
  double log_ratio = 0;       // ln of the ratio; 0: as stated
  double sigma = 0;
  int pixels = 0;
};

// Measures the ratio over pixels that are valid, and show at least 2 % of full scale, in both photos.
// Takes every third pixel in each direction. `exposure_s` as in ToRelativeLuminance, to know that share.
// Empty for fewer than 100 such pixels. The sigma is the median's, from the median absolute deviation. It is
// never below 0.1 %, since neighbours are not independent evidence.
std::optional<ExposureRatio> MeasureRatio(const LuminanceImage& first, double first_exposure_s,
                                          const LuminanceImage& second, double second_exposure_s);

struct ExposureGains {
  Eigen::VectorXd log_gain;  // delta, one for each photo; 0 where no ratio includes the photo
  Eigen::VectorXd sigma;
  std::vector<int> off;  // photos whose stated exposure is wrong: off by > `least` and > 4 sigmas
};

struct ExposureGainsOptions {
  double prior = 0.02;  // in ln exposure: labels are rounded and shutters err by about this
  double least = 0.03;  // in ln exposure: less is not worth a warning
};

// Returns delta of each photo, its sigma, and the photos that are off.
ExposureGains SolveGains(int photos, const std::vector<ExposureRatio>& ratios,
                         const ExposureGainsOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_EXPOSURE_H_
