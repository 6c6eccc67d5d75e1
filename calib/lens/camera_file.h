// Camera files of other programs, read and written.
//
//   OpenCV YAML or XML   camera_matrix, distortion_coefficients (4, 5, 8 or 12), image_width, image_height;
//                        distortion_model: equidistant (ROS's word) marks a fisheye's 4 coefficients
//   mrcal .cameramodel   pinhole, OPENCV4/5/8/12, stereographic, splined stereographic; extrinsics
//   COLMAP cameras       .txt or .bin, see calib/lens/colmap_cameras.h
//   Kalibr camchain      pinhole with radtan, equidistant or none; T_cn_cnm1
//
// Which it is, is told by the name's ending and the file's first lines. Writers return the file's content;
// those that cannot hold the camera's lens throw std::invalid_argument.
//
// Throws std::runtime_error("FILE[:LINE]: key: expected ..., got ...") for malformed files.
// Source: OpenCV 4.6, "FileStorage"; mrcal 2.2, "Camera model file formats"; Kalibr's wiki, "YAML formats".
#ifndef LUXFIT_CALIB_LENS_CAMERA_FILE_H_
#define LUXFIT_CALIB_LENS_CAMERA_FILE_H_

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "calib/lens/camera.h"

namespace luxfit {

struct FiledCamera {
  std::string name;  // Kalibr: cam0; COLMAP: the camera's id; empty where the format has none
  Camera camera;
  // Where the file has it: mrcal's and Kalibr's reference frame (of Kalibr the first camera), metres.
  std::optional<Eigen::Isometry3d> cam_from_reference;
};

// In the order of the file, at least one.
std::vector<FiledCamera> ReadCameraFile(const std::string& path);

// The one of that name; the only one of the file whatever its name. Throws where that is not clear, naming
// the cameras that there are.
Camera ReadCamera(const std::string& path, const std::string& name = "");

std::string OpenCvCameraYaml(const Camera& camera);
std::string MrcalCameraModel(const FiledCamera& camera);
// The first camera is the reference of the chain: every camera needs a pose, or there is but one.
std::string KalibrCamchainYaml(const std::vector<FiledCamera>& cameras);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LENS_CAMERA_FILE_H_
