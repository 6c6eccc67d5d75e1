// Finds cameras whose lens scatters light over the whole picture (veiling glare), and takes it out of observations.
//
//   Y'_ev = Y_e + g M_v          ln Y'_ea - ln Y'_eb = c + g (m_a exp(-c / 2) - m_b exp(c / 2)) / sqrt(Y'_ea Y'_eb)
//
// Y': luminance of element e as view v shows it; M, m: mean of that picture, the veil included; a, b: two views in one state;
// c: ln of the ratio of their photos' exposures that nobody states, the median of the left side. To first order in g, which
// is the slope over all pairs of views and states (inverse/observe/camera/internal/view_slope.h), repeated twice on what it leaves.
// Paint, a wrong exposure and a curve that is the same all over a photo make g = 0. Shine and furniture that the mesh lacks differ
// from view to view, and count in sigma: the jackknife's over views.
//
// A veil is found where g exceeds kLeastVeil and five sigmas. It is not judged by fewer than three views.
//
// Saturated pixels count for what was counted, so that m is a lower bound: g is then larger than the lens's own. Where the light
// that was cut off differs much between the pictures of a state, no one g explains them, sigma tells it, and a veil may not be found.
// Sources: ISO 18844:2017 (flare of cameras); McCann and Rizzi (2007), "Camera and visual veiling glare in HDR images"; own.
#ifndef LUXFIT_INVERSE_OBSERVE_CAMERA_VEILING_GLARE_H_
#define LUXFIT_INVERSE_OBSERVE_CAMERA_VEILING_GLARE_H_

#include <Eigen/Core>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "calib/luminance/luminance.h"
#include "inverse/observe/observe.h"

namespace luxfit {

constexpr double kLeastVeil = 0.002;

struct PictureMean {
  double relative_luminance = 0;
  Eigen::Vector3d relative_rgb = Eigen::Vector3d::Zero();
};

// Returns the mean over all pixels that are finite, saturated ones as they were counted.
PictureMean PictureMeanOf(const LuminanceImage& image);

using PictureMeans = std::map<std::pair<int, int>, PictureMean>;  // by view and state

struct VeilingGlare {
  double share = 0;  // g
  double sigma = 0;  // of g
  int views = 0;
  // Robust spread of ln Y between two views as given, and without the veil.
  double difference = 0, difference_without = 0;

  bool IsFound() const { return share > kLeastVeil && share > 5 * sigma; }
};

// Returns nothing for a camera that is not judged. `camera_of_view`: by view. Throws std::out_of_range for an observation of a
// picture without a mean.
std::vector<std::optional<VeilingGlare>> FindVeilingGlare(const std::vector<Observation>& observations,
                                                          const PictureMeans& means,
                                                          const std::vector<int>& camera_of_view,
                                                          int cameras);

// Takes out the veils that are found, and adds the variance of g. Leaves out observations of which more than half is veil.
std::vector<Observation> WithoutVeils(std::vector<Observation> observations, const PictureMeans& means,
                                      const std::vector<int>& camera_of_view,
                                      const std::vector<std::optional<VeilingGlare>>& by_camera);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_CAMERA_VEILING_GLARE_H_
