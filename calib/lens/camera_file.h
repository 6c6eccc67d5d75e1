// Reads and writes the camera files of other programs, and converts COLMAP's pixels.
//
//   OpenCV YAML or XML   camera_matrix, distortion_coefficients (4, 5, 8 or 12), image_width, image_height;
//                        distortion_model: equidistant (ROS's word) marks a fisheye's 4 coefficients
//   mrcal .cameramodel   pinhole, OPENCV4/5/8/12, stereographic, splined stereographic; extrinsics
//   COLMAP cameras       .txt or .bin: SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV, FULL_OPENCV as
//                        kOpenCv; SIMPLE_RADIAL_FISHEYE, RADIAL_FISHEYE, OPENCV_FISHEYE as kFisheye. FOV and
//                        THIN_PRISM_FISHEYE are refused by name
//   Kalibr camchain      pinhole with radtan, equidistant or none; T_cn_cnm1
//
// The ending of the name and the content of the file tell the format. Writers return the file's content. They
// throw std::invalid_argument where the format cannot hold the camera's lens.
//
// COLMAP puts the centre of the top-left pixel at (0.5, 0.5), this project at (0, 0). colmap_cameras.cc
// shifts, and no other file does.
//
// Throws std::runtime_error("FILE[:LINE]: key: expected ..., got ...") for malformed files.
// Source: OpenCV 4.6, "FileStorage"; mrcal 2.2, "Camera model file formats"; Kalibr's wiki, "YAML formats";
// COLMAP 3.8 documentation, "Output format", "Camera models".
#ifndef LUXFIT_CALIB_LENS_CAMERA_FILE_H_
#define LUXFIT_CALIB_LENS_CAMERA_FILE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calib/lens/camera.h"

namespace luxfit {

// Holds one camera of a file.
struct FiledCamera {
  std::string name;  // Kalibr: cam0; COLMAP: the camera's id; empty where the format has none
  Camera camera;
  // Pose from the file, metres; empty where the file has none. The reference is mrcal's reference frame, or
  // the first camera of a Kalibr chain.
  std::optional<Eigen::Isometry3d> cam_from_reference;
};

// Reads all cameras, at least one, in the order of the file.
std::vector<FiledCamera> ReadCameraFile(const std::string& path);

// Reads the camera of that name; an only camera is returned whatever its name. Throws where the choice is not
// clear, and names the cameras of the file.
Camera ReadCamera(const std::string& path, const std::string& name = "");

// Return the content of a file in each format. A Kalibr chain is relative to its first camera: unless it
// holds one camera only, every camera needs a pose.
std::string OpenCvCameraYaml(const Camera& camera);
std::string MrcalCameraModel(const FiledCamera& camera);
std::string KalibrCamchainYaml(const std::vector<FiledCamera>& cameras);

// Convert a pixel between COLMAP's convention and the project's, px.
Eigen::Vector2d FromColmapPixel(const Eigen::Vector2d& colmap_px);
Eigen::Vector2d ToColmapPixel(const Eigen::Vector2d& pixel);

// COLMAP numbers cameras and images from 0 to 2^32 - 1.
using ColmapId = std::int64_t;

// Reads cameras.txt, or cameras.bin where the name ends in .bin. Returns the cameras by their ids.
std::map<ColmapId, Camera> ReadColmapCameras(const std::string& path);

// Holds a model's name and its parameters, in COLMAP's order and convention.
struct ColmapCameraModel {
  std::string name;
  std::string parameters;  // comma-separated, as the option --ImageReader.camera_params takes them
};
// Returns the shortest COLMAP model that holds the camera: PINHOLE, OPENCV or FULL_OPENCV where the lens is
// kOpenCv, OPENCV_FISHEYE where it is kFisheye. Throws std::invalid_argument for a lens that COLMAP does not
// have (splined, thin prism terms).
ColmapCameraModel ToColmapModel(const Camera& camera);

// Returns the content of cameras.txt.
std::string ColmapCamerasText(const std::map<ColmapId, Camera>& cameras);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LENS_CAMERA_FILE_H_
