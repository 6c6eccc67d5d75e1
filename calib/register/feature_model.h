// Holds a reconstruction from image features: views and points, and where each view saw which point. Fits and
// applies similarities, which map its own frame and scale to the world.
//
//   pixel  = Project(camera of the view, cam_from_model * p_in_model)
//   p_in_b = scale * rotation * p_in_a + translation
//
// The frame and its scale are the reconstruction's own. Views are those of the session by name; pixels are
// the project's. `surface` is set once a point is known to lie on a surface of the scene
// (calib/register/mesh_alignment.h).
//
// Source: Umeyama (1991), "Least-squares estimation of transformation parameters between two point patterns".
#ifndef LUXFIT_CALIB_REGISTER_FEATURE_MODEL_H_
#define LUXFIT_CALIB_REGISTER_FEATURE_MODEL_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calib/register/colmap_files.h"

namespace luxfit {

struct Similarity {
  double scale = 1;  // > 0
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& p) const { return scale * (rotation * p) + translation; }
  Similarity Inverse() const;
};

// Returns the similarity with the least sum of |b_from_a * a_i - b_i|^2; with `scale` given, the best of that
// scale. Returns nothing where the points (3 x n) do not determine it: fewer than three, or all near one
// line.
std::optional<Similarity> FitSimilarity(const Eigen::Matrix3Xd& points_in_a,
                                        const Eigen::Matrix3Xd& points_in_b,
                                        std::optional<double> scale = std::nullopt);

// Returns the pose of a camera in b that takes the same picture as `cam_from_a` in a. Its camera frame has
// b's unit.
Eigen::Isometry3d PoseUnder(const Similarity& b_from_a, const Eigen::Isometry3d& cam_from_a);

// Holds the plane of unit normal n through a point; points on it lie within sigma_m.
struct SurfacePlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d on_surface = Eigen::Vector3d::Zero();
  double sigma_m = 0;
};

struct FeatureView {
  std::string view;
  Eigen::Isometry3d cam_from_model = Eigen::Isometry3d::Identity();
};

struct FeatureObservation {
  int view = 0;  // index into FeatureModel::views
  Eigen::Vector2d pixel;
};

struct FeatureTrack {
  Eigen::Vector3d p_in_model = Eigen::Vector3d::Zero();
  std::vector<FeatureObservation> seen;  // each view once
  std::optional<SurfacePlane> surface;   // in the frame of p_in_model
};

struct FeatureModel {
  std::vector<FeatureView> views;
  std::vector<FeatureTrack> tracks;  // each seen by at least two views
};

// Returns the images of a COLMAP model that show a view of the session. Where several do (exposures of one
// pose), the one with most points is taken. `view_of_image` is keyed by the image's name in COLMAP.
FeatureModel FeaturesOf(const ColmapModel& model, const std::map<std::string, std::string>& view_of_image);

// Returns the reconstruction moved into another frame. Throws std::invalid_argument where a track already has
// a surface: surfaces do not move.
FeatureModel Moved(const FeatureModel& features, const Similarity& b_from_model);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_FEATURE_MODEL_H_
