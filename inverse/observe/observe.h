// Finds the element that each pixel sees, and the mean luminance of every element in every photo.
//
// A pixel belongs to an element under three conditions:
// - its centre's ray meets the element's front first;
// - the pixels around it see the same facet, so that a registration error of a pixel does not mix surfaces;
// - no masked quad (a tag) covers it.
// An element counts in a view when enough such pixels see it and their mean point lies near its centre. Its
// mean luminance then stands for the luminance at its centre. In one photo it counts when nearly all those
// pixels are valid there.
//
// Luminance is relative, in the camera's own unit (calib/luminance/luminance.h).
// Source: own. The bias bound of the centroid rule is the gradient times centroid_tolerance * element size.
#ifndef LUXFIT_INVERSE_OBSERVE_OBSERVE_H_
#define LUXFIT_INVERSE_OBSERVE_OBSERVE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/luminance/luminance.h"
#include "calib/targets/tags.h"
#include "forward/light/room.h"

namespace luxfit {

using PixelQuad = std::array<Eigen::Vector2d, 4>;  // corners in order round the quad, px

// Returns where surveyed tags cover a photo: no surface of the room is seen there. One quad for each tag in
// front of the camera, with the paper around its black square. `survey`: tags in the world frame.
std::vector<PixelQuad> TagQuads(const std::vector<SurveyedTag>& survey, const Camera& camera,
                                const Eigen::Isometry3d& cam_from_world);

struct PixelMapOptions {
  int guard_px = 2;                 // distance within which all pixels must see the same facet
  int min_pixels = 4;               // fewer: the mean is too noisy and its centroid too coarse
  double centroid_tolerance = 0.2;  // share of the element's size
};

// Maps pixels, height x width, to indices into room.patches.elements; -1: not used.
struct PixelMap {
  Eigen::Array<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> element;
  std::vector<int> pixels_of_element;  // one for each element
};

// Unit directions of all pixels' rays in the camera frame, row by row. All views of a camera share them.
using PixelDirections = Eigen::Matrix<float, 3, Eigen::Dynamic>;
PixelDirections UnprojectAllPixels(const Camera& camera);

// Returns the element of each pixel. `directions` are those of `camera`.
PixelMap MapPixels(const Camera& camera, const PixelDirections& directions,
                   const Eigen::Isometry3d& cam_from_world, const Room& room,
                   const std::vector<PixelQuad>& masked, const PixelMapOptions& options = {});

struct Observation {
  int element = 0;
  int view = 0;
  int state = 0;
  int pixels = 0;
  double relative_luminance = 0;
  double variance = 0;  // variance of the mean, from the pixels' spread, at least their stated noise
  Eigen::Vector3d relative_rgb = Eigen::Vector3d::Zero();  // the channels' means, in the same unit
  // Luminance that light from other surfaces gives a white element there
  // (inverse/model/internal/measured_indirect.h). 0: not computed.
  double relative_indirect = 0;
  // Luminance of ambient light that was subtracted (inverse/observe/ambient_light.h). 0: none.
  double relative_ambient = 0;
};

// Returns the observations of one photo.
std::vector<Observation> ObservePhoto(const PixelMap& map, const LuminanceImage& photo, int view, int state);

// Merges the views of one element in one state into one value: their mean, weighted by inverse variance.
//
//   w_v = 1 / (n_v + s^2 m^2)     y = sum_v w_v y_v / sum_v w_v     var y = 1 / sum_v w_v
//
// y_v, n_v: relative luminance of view v and the variance of its noise; m: the median of the y_v; s: relative
// variance component between views (inverse/observe/internal/between_views.h). All views take m, for s^2
// y_v^2 would favour those that are too dark. Of three views and more, those further than outlier_sigmas from
// the median are left out.
//
// The merged variance holds what views tell of themselves. FitLuminaires estimates its model error from what
// residuals show beyond that variance, so that nothing counts twice. Source: own.

// Says how much views of one element disagree beyond their noise.
struct BetweenViews {
  // s. At least 0.001: half of the least model error of a fit, so a smaller one changes no weight that
  // matters. The default holds where too few elements are shared: about what registration and the size of
  // elements leave.
  double relative_sigma = 0.01;
  int groups = 0;             // elements and states that several views show
  bool is_estimated = false;  // false: fewer than 30 groups, too few for s within a quarter
};

// Registration and the size of elements leave errors that views share, which their differences do not show. Relative.
constexpr double kLeastBetweenViews = 0.01;

struct MergeViewsOptions {
  std::optional<double> relative_sigma;  // s; not given: EstimateBetweenViews
  double outlier_sigmas = 4;
  double least_relative_sigma = 0;  // of the estimated s
};

struct MergedObservations {
  std::vector<Observation> observations;  // `view` is -1, `pixels` the sum over views
  BetweenViews between_views;             // the s that was used
  int outliers = 0;                       // views left out
};

MergedObservations MergeViews(const std::vector<Observation>& observations,
                              const MergeViewsOptions& options = {});

// Returns the observations of at most about `max_elements` of the observed elements, taken evenly and in
// their order. These are enough for a start or a comparison.
std::vector<Observation> ThinElements(const std::vector<Observation>& observations, int max_elements);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_OBSERVE_H_
