// Aligns points to the surfaces of a scene: places and scales a reconstruction without surveyed tags.
//
//   min over world_from_points (rotation, translation and, if free, scale) of
//     sum over points of rho( (n_i . (world_from_points * p_i - q_i))^2 )
//
// q_i: nearest point of the surface, n_i: its normal. Gauss-Newton finds the nearest points again in every
// step. A gate closes from `rough_m` to three times the points' own scatter. Points further off do not count:
// they are things that the mesh does not have.
//
// Assumes a rough start: the surface nearest to a point must mostly be its own. Returns `is_determined` false
// where the points leave a direction free, such as one wall only, or a corridor's length.
// Source: Chen and Medioni (1992), "Object modelling by registration of multiple range images" (point to
// plane); Besl and McKay (1992).
#ifndef LUXFIT_CALIB_REGISTER_MESH_ALIGNMENT_H_
#define LUXFIT_CALIB_REGISTER_MESH_ALIGNMENT_H_

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calib/register/feature_model.h"
#include "calib/register/registration.h"

namespace luxfit {

struct SurfaceAlignmentOptions {
  bool scale_is_free = true;
  double rough_m = 0.5;         // error of the start, at the points
  double least_share = 0.3;     // share of the points that must lie on the surface in the end
  double most_sigma_m = 0.02;   // at the middle of the points; worse is not determined
  double mesh_sigma_m = 0.002;  // error of the mesh itself: plaster, skirting boards
};

struct SurfaceAlignment {
  bool is_determined = false;
  std::string message;  // says why it is not determined
  Similarity world_from_points;
  // Covariance of (rotation vector, shift of the points' middle m, log scale), world axes. It includes the
  // mesh's own error once for all points.
  Eigen::Matrix<double, 7, 7> covariance = Eigen::Matrix<double, 7, 7>::Zero();
  Eigen::Vector3d middle_in_world = Eigen::Vector3d::Zero();
  double scatter_m = 0;              // robust sigma of the distances of points that count
  std::vector<SurfacePlane> planes;  // nearest plane to each point; sigma_m 0 where the point does not count
};

// Aligns `points`, 3 x n in a frame of their own, to the surface. Throws std::invalid_argument for an empty
// surface and indices that it does not have.
SurfaceAlignment AlignPointsToSurface(const Eigen::Matrix3Xd& points, const TriangleSurface& surface,
                                      const Similarity& start, const SurfaceAlignmentOptions& options = {});

// Returns the similarity that takes the views' centres to their cameras' rough places, with the scale given
// if one is. Returns nothing where fewer than three of the views have a place, or all lie on one line.
std::optional<Similarity> StartFromPlaces(const std::vector<FeatureView>& views,
                                          const std::map<std::string, Eigen::Vector3d>& places_m,
                                          std::optional<double> scale = std::nullopt);

// Returns the reconstruction aligned to the surface: moved, with the planes of the points that lie on it.
// Without tags, RegisterViews adjusts it.
FeatureModel OnSurface(const FeatureModel& features, const SurfaceAlignment& alignment);

// Returns a registration in a frame of its own scale (unsurveyed tags), moved rigidly. The alignment's
// uncertainty is added to that of every pose.
Registration MovedToSurface(const Registration& registration, const SurfaceAlignment& alignment);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_MESH_ALIGNMENT_H_
