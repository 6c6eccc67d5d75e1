// Points laid onto the surfaces of a scene: where a reconstruction without surveyed tags is, and how large.
//
//   min over world_from_points (rotation, translation and, if free, scale) of
//     sum over points of rho( (n_i . (world_from_points * p_i - q_i))^2 )
//
// q_i: nearest point of the surface, n_i: its normal; Gauss-Newton, nearest points found again every step.
// Points further off than a gate that closes from `rough_m` to three times the points' own scatter do not
// count (things that the mesh has not). From a rough start: the surface nearest to a point must mostly be its
// own.
//
// Not determined, and told so, where the points leave a direction free: one wall only, a corridor's length.
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
#include "calib/register/similarity.h"

namespace luxfit {

struct TriangleSurface {
  Eigen::Matrix3Xd vertices_m;  // in world
  Eigen::Matrix3Xi triangles;   // indices of vertices, a column each
};

struct SurfaceAlignmentOptions {
  bool scale_is_free = true;
  double rough_m = 0.5;         // what the start is off, at the points
  double least_share = 0.3;     // of the points that must lie on the surface in the end
  double most_sigma_m = 0.02;   // of a place in the middle of the points; worse is not determined
  double mesh_sigma_m = 0.002;  // of the mesh itself: plaster, skirting boards
};

struct SurfaceAlignment {
  bool is_determined = false;
  std::string message;  // where it is not, why
  Similarity world_from_points;
  // Of (rotation vector, shift of the points' middle m, log scale), world axes; the mesh's own error included
  // once for all points.
  Eigen::Matrix<double, 7, 7> covariance = Eigen::Matrix<double, 7, 7>::Zero();
  Eigen::Vector3d middle_in_world = Eigen::Vector3d::Zero();
  double scatter_m = 0;              // robust sigma of the distances of those that count
  std::vector<SurfacePlane> planes;  // nearest to each point; sigma_m 0 where the point does not count
};

// `points`: 3 x n in a frame of their own. Throws std::invalid_argument for an empty surface or indices that
// it has not.
SurfaceAlignment AlignPointsToSurface(const Eigen::Matrix3Xd& points, const TriangleSurface& surface,
                                      const Similarity& start, const SurfaceAlignmentOptions& options = {});

// The similarity that takes the views' centres to where their cameras roughly stood, of the scale given if
// one is. Nothing where fewer than three of the views have a place, or all on one line.
std::optional<Similarity> StartFromPlaces(const std::vector<FeatureView>& views,
                                          const std::map<std::string, Eigen::Vector3d>& places_m,
                                          std::optional<double> scale = std::nullopt);

// A reconstruction laid onto the surface: moved, with the planes of the points that lie on it, for
// RegisterViews to adjust without tags.
FeatureModel OnSurface(const FeatureModel& features, const SurfaceAlignment& alignment);

// A registration in a frame of its own scale (unsurveyed tags) moved rigidly; the alignment's uncertainty is
// added to every pose's.
Registration MovedToSurface(const Registration& registration, const SurfaceAlignment& alignment);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_MESH_ALIGNMENT_H_
