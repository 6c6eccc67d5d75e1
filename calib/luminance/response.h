// Models the response of a camera that is not linear, counts to exposure, and estimates it from exposure
// brackets.
//
//   X_c = f_c(count),   f_c increasing, piecewise linear between knots, X relative to full scale
//
// X is proportional to luminance times relative exposure. A count outside the knots takes the value of the
// nearest knot. Gauge: a response is determined up to one factor for each channel. Estimates set f_c(half
// scale) equal in all channels (a neutral grey of that count is neutral light) and the largest f_c at full
// scale to 1.
//
// Brackets determine it:
//   g(z_ij) = ln E_i + ln t_j        counts z of pixel i in exposure j; g = ln f; E_i unknown
//
// Debevec-Malik is one linear least squares:
//   min over g, ln E of sum w(z_ij) (g(z_ij) - ln E_i - ln t_j)^2 + lambda int (d2g / d(ln z)2)^2
// The E_i are eliminated, so any number of pixels costs one system of 256 unknowns. It differs from the paper
// in two points. w is the paper's hat in the first round only; then it is the inverse variance of g for equal
// noise of counts, 1 / g'^2. Smoothness is that of g against ln z, in which every gamma is straight; against
// z the steep dark end is bent. Negative increments of g are held at a least step and the rest is solved
// again.
//
// Robertson alternates between E_i and f, without smoothing:
//   E_i = sum_j w t_j f(z_ij) / sum_j w t_j^2,   f(m) = mean of t_j E_i over z_ij = m
// Gaps between counts that occur are interpolated, and f is made monotone (pool adjacent violators).
//
// Counts of more than 8 bits are taken in 256 steps, between which f is linear. Counts below dark_fraction or
// above saturation_fraction of full scale are left out. Assumes that exposures are right up to a common
// exponent: times t^a and a response f^a fit the same pictures.
//
// Held-out exposures choose the method and lambda. The candidates are a linear response and the encoding of
// sRGB, both fixed, the latter of a power of the light, Debevec-Malik from a power law (a large lambda) to rough curves, and Robertson's. Each
// inner exposure of each bracket in turn is predicted, in counts, from the response and the E_i of the
// others. The first candidate whose mean absolute error lies within one standard error (over brackets and
// exposures) of the least is chosen.
//
// That is not the standard error of the difference, which would be smaller. Held-out exposures cannot show
// all the smoothness that is needed: exposures one stop apart leave every ripple of g with a period of one
// stop undetermined, and they predict each other with it. Where no bracket has three exposures, halves of the
// pixels are held out instead. Smoothness alone then decides on ripples, and sigma grows with the step: the error of
// a film's curve is 1, 9 and 21 % at most with a step of 1, 2 and 3 stops.
//
// Throws std::invalid_argument for fewer than two knots, knots or exposures that do not increase, and numbers
// that are not finite.
// Source: Debevec and Malik (1997), sec. 2.1; Robertson, Borman, Stevenson (2003), eq. 9 to 11.
#ifndef LUXFIT_CALIB_LUMINANCE_RESPONSE_H_
#define LUXFIT_CALIB_LUMINANCE_RESPONSE_H_

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "calib/photo_files/image.h"

namespace luxfit {

class CameraResponse {
 public:
  // `exposure`: one curve for each channel, at the same counts.
  CameraResponse(Eigen::VectorXd counts, std::array<Eigen::VectorXd, 3> exposure);

  // Returns the response with the standard deviation of ln X at every knot, > 0.
  CameraResponse WithRelativeSigma(std::array<Eigen::VectorXd, 3> relative_sigma) const;

  double Exposure(size_t channel, double counts) const;
  double Counts(size_t channel, double exposure) const;  // the inverse
  double Slope(size_t channel, double counts) const;     // dX / dcount

  bool has_relative_sigma() const { return relative_sigma_[0].size() > 0; }
  double RelativeSigma(size_t channel, double counts) const;

  const Eigen::VectorXd& counts() const { return counts_; }
  const Eigen::VectorXd& exposure(size_t channel) const { return exposure_[channel]; }

 private:
  Eigen::VectorXd counts_;
  std::array<Eigen::VectorXd, 3> exposure_, relative_sigma_;
};

// Returns the decoding of sRGB (IEC 61966-2-1) for counts up to full scale, which photos without brackets are taken to
// have. Makers lift shadows and bend highlights: ln X is taken to err by 5 % (1 sigma).
CameraResponse SrgbResponse(double full_scale_counts);

// Holds some pixels of one bracket.
struct BracketSamples {
  Eigen::VectorXd exposure_s;             // relative exposures, any order
  std::array<Eigen::MatrixXd, 3> counts;  // pixels x exposures
};

struct ResponseOptions {
  double full_scale_counts = 255;
  double dark_fraction = 0.02;
  double saturation_fraction = 0.97;
};

// Return the response by each method; `smoothing` is lambda over the data's weight per unknown. Throw
// std::invalid_argument for no samples, exposures that are not > 0 and sizes that do not agree.
CameraResponse SolveDebevec(const std::vector<BracketSamples>& brackets, const ResponseOptions& options,
                            double smoothing = 1e-3);
CameraResponse SolveRobertson(const std::vector<BracketSamples>& brackets, const ResponseOptions& options);

struct ResponseScore {
  std::string method;                // "debevec, smoothing 1", "robertson"
  double held_out_error_counts = 0;  // mean absolute error
};

struct ResponseEstimate {
  // The response with the relative sigma of every count, from how exposures disagree. Empty: not determined,
  // see message.
  std::optional<CameraResponse> response;
  std::string message;
  size_t chosen = 0;  // index into scores
  std::vector<ResponseScore> scores;
};

// Chooses and estimates the response. Not determined: fewer than two exposures, no two exposures of one
// pixel within range, or a spread of exposures less than a factor of two.
ResponseEstimate EstimateResponse(const std::vector<BracketSamples>& brackets,
                                  const ResponseOptions& options);

// Chooses at most `count` pixels worth sampling in one photo. Their surroundings of 5 x 5 are flat, since an
// edge moves between exposures, and their counts are spread evenly over the range in use. `allowed`: empty,
// or false where a pixel must not be taken.
struct PixelPlace {
  int u = 0, v = 0;
};
std::vector<PixelPlace> ChooseSamplePixels(const Photo& photo, size_t count, const ResponseOptions& options,
                                           const PixelMask& allowed = {});

// Returns the mean of the 3 x 3 counts around each place, places x channels.
Eigen::MatrixX3d CountsAt(const Photo& photo, const std::vector<PixelPlace>& places);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_RESPONSE_H_
