// COLMAP's cameras, text and binary, and its pixel convention.
//
// COLMAP puts the centre of the top-left pixel at (0.5, 0.5), the house at (0, 0): this file shifts and no
// other does.
//
//   SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV, FULL_OPENCV    kOpenCv
//   SIMPLE_RADIAL_FISHEYE, RADIAL_FISHEYE, OPENCV_FISHEYE                  kFisheye
//
// FOV and THIN_PRISM_FISHEYE are refused by name.
// Throws std::runtime_error("FILE[:LINE]: expected ..., got ...") for malformed files.
// Source: COLMAP 3.8 documentation, "Output format", "Camera models".
#ifndef LUXFIT_CALIB_LENS_COLMAP_CAMERAS_H_
#define LUXFIT_CALIB_LENS_COLMAP_CAMERAS_H_

#include <Eigen/Core>
#include <map>
#include <string>

#include "calib/lens/camera.h"

namespace luxfit {

Eigen::Vector2d FromColmapPixel(const Eigen::Vector2d& colmap_px);
Eigen::Vector2d ToColmapPixel(const Eigen::Vector2d& pixel);

// By camera id; cameras.txt, or cameras.bin where the name ends so.
std::map<int, Camera> ReadColmapCameras(const std::string& path);

// The model's name and parameters in COLMAP's order and convention: FULL_OPENCV, the shorter OPENCV or
// PINHOLE where its terms are 0, OPENCV_FISHEYE. Throws std::invalid_argument for lenses that COLMAP has not
// (splined, thin prism terms).
struct ColmapCameraModel {
  std::string name;
  std::string parameters;  // comma-separated, as the option --ImageReader.camera_params takes them
};
ColmapCameraModel ToColmapModel(const Camera& camera);

// cameras.txt.
std::string ColmapCamerasText(const std::map<int, Camera>& cameras);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LENS_COLMAP_CAMERAS_H_
