// The response of a camera from exposure brackets.
//
//   g(z_ij) = ln E_i + ln t_j        counts z of pixel i in exposure j; g = ln f; E_i unknown
//
// Debevec-Malik: min over g, ln E of sum w(z_ij) (g(z_ij) - ln E_i - ln t_j)^2 + lambda int (d2g / d(ln
// z)2)^2, one linear least squares; the E_i are eliminated, so any number of pixels costs one system of 256
// unknowns. Other than in the paper, w is its hat in the first round only and then the inverse variance of g
// for equal noise of counts, 1 / g'^2; and smoothness is that of g against ln z, in which every gamma is
// straight (against z the steep dark end is bent). Increments of g that come out negative are held at a least
// step and the rest solved again.
//
// Robertson: alternately E_i = sum_j w t_j f(z_ij) / sum_j w t_j^2 and f(m) = mean of t_j E_i over z_ij = m,
// without smoothing. Gaps between counts that occur are interpolated, and f made monotone (pool adjacent
// violators).
//
// Counts of more than 8 bits are taken in 256 steps, between which f is linear. Counts below dark_fraction or
// above saturation_fraction of full scale are left out. Assumes that exposures are right up to a common
// exponent: times t^a and a response f^a fit the same pictures.
//
// Which is taken, and lambda: by exposures held out. Candidates are a linear response and the encoding of
// sRGB as they are, Debevec-Malik from a power law (a large lambda) to rough curves, and Robertson's. Each
// inner exposure of each bracket in turn is predicted, in counts, from the response and the E_i of the
// others; the first candidate within one standard error (over brackets and exposures) of the least mean
// absolute error is taken. It is not the difference's standard error, which would be smaller: held-out
// exposures cannot ask for all the smoothness that is needed, for exposures one stop apart leave every ripple
// of g whose period is one stop undetermined, and predict each other with it.
//
// Sources: Debevec and Malik (1997), sec. 2.1; Robertson, Borman, Stevenson (2003), eq. 9 to 11.
#ifndef LUXFIT_CALIB_LUMINANCE_ESTIMATE_RESPONSE_H_
#define LUXFIT_CALIB_LUMINANCE_ESTIMATE_RESPONSE_H_

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "calib/luminance/image.h"
#include "calib/luminance/luminance.h"
#include "calib/luminance/response.h"

namespace luxfit {

// Some pixels of one bracket.
struct BracketSamples {
  Eigen::VectorXd exposure_s;             // relative exposures, any order
  std::array<Eigen::MatrixXd, 3> counts;  // pixels x exposures
};

struct ResponseOptions {
  double full_scale_counts = 255;
  double dark_fraction = 0.02;
  double saturation_fraction = 0.97;
};

struct DebevecOptions {
  double smoothing = 1e-3;  // lambda over the data's weight per unknown
};

// Throw std::invalid_argument for no samples, exposures that are not > 0 and sizes that do not fit.
CameraResponse SolveDebevec(const std::vector<BracketSamples>& brackets, const ResponseOptions& options,
                            const DebevecOptions& debevec = {});
CameraResponse SolveRobertson(const std::vector<BracketSamples>& brackets, const ResponseOptions& options);

struct ResponseScore {
  std::string method;                // "debevec, smoothing 1", "robertson"
  double held_out_error_counts = 0;  // mean absolute
};

struct ResponseEstimate {
  // Empty: not determined, see message. With the relative sigma of every count, from how exposures disagree.
  std::optional<CameraResponse> response;
  std::string message;
  size_t chosen = 0;  // index into scores
  std::vector<ResponseScore> scores;
};

// Not determined: fewer than three exposures, no two exposures of one pixel within range, or a spread of
// exposures less than a factor of two.
ResponseEstimate EstimateResponse(const std::vector<BracketSamples>& brackets,
                                  const ResponseOptions& options);

// Pixels worth sampling in one photo: flat surroundings of 5 x 5 (an edge moves between exposures), counts
// spread evenly over the range that is used, at most `count`. `allowed`: empty, or false where a pixel must
// not be taken.
struct PixelPlace {
  int u = 0, v = 0;
};
std::vector<PixelPlace> ChooseSamplePixels(const Photo& photo, size_t count, const ResponseOptions& options,
                                           const PixelMask& allowed = {});

// Mean of the 3 x 3 counts around each place, places x channels.
Eigen::MatrixX3d CountsAt(const Photo& photo, const std::vector<PixelPlace>& places);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_ESTIMATE_RESPONSE_H_
