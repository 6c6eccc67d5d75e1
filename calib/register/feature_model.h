// A reconstruction from image features: views and points in a frame and scale of its own, and which view saw
// which point where.
//
//   pixel = Project(camera of the view, cam_from_model * p_in_model)
//
// Views are those of the session by name; pixels are the house's. Once a point is known to lie on a surface
// of the scene, `surface` says so (see calib/register/mesh_alignment.h).
#ifndef LUXFIT_CALIB_REGISTER_FEATURE_MODEL_H_
#define LUXFIT_CALIB_REGISTER_FEATURE_MODEL_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calib/register/colmap_model.h"
#include "calib/register/similarity.h"

namespace luxfit {

// The plane of unit normal n through a point; whatever lies on it does within sigma_m.
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
  std::vector<FeatureTrack> tracks;  // of two views and more
};

// The images of a COLMAP model that show a view of the session; where several do (exposures of one pose), the
// one with most points. `view_of_image` takes the image's name as COLMAP has it.
FeatureModel FeaturesOf(const ColmapModel& model, const std::map<std::string, std::string>& view_of_image);

// The same reconstruction moved into another frame. Throws std::invalid_argument where a track has a surface
// already: surfaces do not move.
FeatureModel Moved(const FeatureModel& features, const Similarity& b_from_model);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_FEATURE_MODEL_H_
