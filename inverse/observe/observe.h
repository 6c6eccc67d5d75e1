// Which element each pixel sees, and the mean luminance of every element in every photo.
//
// A pixel belongs to an element when its centre's ray meets the element's front first, the pixels around it
// see the same facet (a registration error of a pixel then does not mix surfaces), and no masked quad (a tag)
// covers it. An element counts in a view when enough such pixels see it and their mean point lies near its
// centre: its mean luminance then stands for the luminance at its centre. In one photo it counts when nearly
// all those pixels are valid there.
//
// Luminance is relative, in the camera's own unit (see calib/luminance/luminance.h).
// Source: house; the bias bound of the centroid rule is the gradient times centroid_tolerance * element size.
#ifndef LUXFIT_INVERSE_OBSERVE_OBSERVE_H_
#define LUXFIT_INVERSE_OBSERVE_OBSERVE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/luminance/luminance.h"
#include "forward/light/room.h"

namespace luxfit {

using PixelQuad = std::array<Eigen::Vector2d, 4>;  // corners in order around, px

struct PixelMapOptions {
  int guard_px = 2;                 // distance within which all pixels must see the same facet
  int min_pixels = 4;               // fewer: the mean is too noisy and its centroid too coarse
  double centroid_tolerance = 0.2;  // of the element's size
};

// height x width: index into room.patches.elements, -1: not used.
struct PixelMap {
  Eigen::Array<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> element;
  std::vector<int> pixels_of_element;  // one an element
};

// Unit directions of every pixel's ray in the camera frame, row by row; the same for all views of a camera.
using PixelDirections = Eigen::Matrix<float, 3, Eigen::Dynamic>;
PixelDirections UnprojectAllPixels(const Camera& camera);

// `directions` belong to `camera`.
PixelMap MapPixels(const Camera& camera, const PixelDirections& directions,
                   const Eigen::Isometry3d& cam_from_world, const Room& room,
                   const std::vector<PixelQuad>& masked, const PixelMapOptions& options = {});

struct Observation {
  int element = 0;
  int view = 0;
  int state = 0;
  int pixels = 0;
  double relative_luminance = 0;
  double variance = 0;  // of the mean, from the spread of the pixels, and no less than their stated noise
  Eigen::Vector3d relative_rgb = Eigen::Vector3d::Zero();  // the channels' means, in the same unit
  // What light from other surfaces gives a white element there (inverse/model/measured_indirect.h); 0: not asked
  // for.
  double relative_indirect = 0;
};

// The observations of one photo.
std::vector<Observation> ObservePhoto(const PixelMap& map, const LuminanceImage& photo, int view, int state);

// One value an element and state: the views' weighted mean, each view's variance enlarged by (relative_sigma
// * value)^2. Views more than outlier_sigmas from the median of three or more are left out. `view` is -1,
// `pixels` the sum.
struct MergeViewsOptions {
  double relative_sigma =
      0.01;  // registration and element-size effects differ from view to view by about this
  double outlier_sigmas = 4;
};
struct MergedObservations {
  std::vector<Observation> observations;
  int outliers = 0;
};
MergedObservations MergeViews(const std::vector<Observation>& observations,
                              const MergeViewsOptions& options = {});

// Observations of at most about `max_elements` of the observed elements, taken evenly: enough for a start or
// a comparison. Order is kept.
std::vector<Observation> ThinElements(const std::vector<Observation>& observations, int max_elements);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_OBSERVE_H_
