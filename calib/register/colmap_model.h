// A COLMAP model, text and binary: where its images were taken, its points and which image sees which.
//
//   p_in_cam = cam_from_model * p_in_model,   pixel = Project(camera, p_in_cam)
//
// The model's frame, and its scale, are arbitrary (no metres). Pixels are the house's: (0, 0) is the centre
// of the top-left pixel (shifted by calib/lens/colmap_cameras.h). Ids are COLMAP's own.
//
// Throws std::runtime_error("FILE[:LINE]: expected ..., got ...") for missing and malformed files, and where
// an image or a track names something that the model has not.
// Source: COLMAP 3.8 documentation, "Output format".
#ifndef LUXFIT_CALIB_REGISTER_COLMAP_MODEL_H_
#define LUXFIT_CALIB_REGISTER_COLMAP_MODEL_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "calib/lens/camera.h"

namespace luxfit {

struct ColmapImage {
  std::string name;  // file name relative to COLMAP's image folder
  int camera = 0;
  Eigen::Isometry3d cam_from_model = Eigen::Isometry3d::Identity();
  std::vector<Eigen::Vector2d> keypoints_px;
};

struct ColmapTrackElement {
  int image = 0;
  int keypoint = 0;  // index into that image's keypoints_px
};

struct ColmapPoint {
  Eigen::Vector3d p_in_model = Eigen::Vector3d::Zero();
  std::vector<ColmapTrackElement> track;
};

struct ColmapModel {
  std::map<int, Camera> cameras;
  std::map<int, ColmapImage> images;
  std::map<std::int64_t, ColmapPoint> points;
};

// cameras, images and points3D of a folder; .bin where there is one, else .txt.
ColmapModel ReadColmapModel(const std::string& folder);

// images.txt and points3D.txt; cameras.txt is ColmapCamerasText(model.cameras).
std::string ColmapImagesText(const ColmapModel& model);
std::string ColmapPointsText(const ColmapModel& model);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_COLMAP_MODEL_H_
