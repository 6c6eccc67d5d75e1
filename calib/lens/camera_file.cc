#include "calib/lens/camera_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "calib/lens/internal/camera_formats.h"
#include "calib/lens/lens_family.h"

namespace luxfit {
namespace {

enum class Format { kOpenCv, kMrcal, kKalibr, kColmap };

Format FormatOf(const std::string& path) {
  std::ifstream file(path);
  if (!file || file.peek() == std::ifstream::traits_type::eof()) {
    throw std::runtime_error(path +
                             ": cannot read the calibration, expected an existing file that is not empty");
  }
  const std::filesystem::path ending = std::filesystem::path(path).extension();
  if (ending == ".cameramodel") return Format::kMrcal;
  if (ending == ".txt" || ending == ".bin") return Format::kColmap;
  // A Kalibr camchain is a list of cam0:, cam1:, ...; OpenCV's files never have such a key.
  for (std::string line; std::getline(file, line);) {
    if (line.compare(0, 3, "cam") == 0 && line.find_first_not_of("0123456789", 3) == line.find(':') &&
        line.find(':') != std::string::npos && line.find(':') > 3) {
      return Format::kKalibr;
    }
  }
  return Format::kOpenCv;
}

std::string Names(const std::vector<FiledCamera>& cameras) {
  std::string names;
  for (const FiledCamera& camera : cameras) names += (names.empty() ? "" : ", ") + camera.name;
  return names;
}

}  // namespace

LensModel LensOfDistortion(const std::string& distortion_model) {
  for (const LensOps& ops : Lenses()) {
    if (ops.distortion_model != nullptr && distortion_model == ops.distortion_model) return ops.lens;
  }
  return LensModel::kOpenCv;
}

int ImagePixels(double value, const std::string& place) {
  constexpr double kMost = 1e6;
  if (!(value >= 1 && value <= kMost) || value != std::floor(value)) {
    std::ostringstream message;
    message << place << ": expected a whole number of pixels, 1 to 1000000, got " << value;
    throw std::runtime_error(message.str());
  }
  return static_cast<int>(value);
}

void CheckCamera(const Camera& camera, const std::string& place) {
  if (camera.width_px < 1 || camera.height_px < 1)
    throw std::runtime_error(place + ": expected an image of at least 1 x 1 pixels, got " +
                             std::to_string(camera.width_px) + " x " + std::to_string(camera.height_px));
  if (!(camera.fx_px > 0 && camera.fy_px > 0))
    throw std::runtime_error(place + ": expected focal lengths > 0 px, got " + std::to_string(camera.fx_px) +
                             " and " + std::to_string(camera.fy_px));
  const auto is_finite = [](double value) { return std::isfinite(value); };
  const std::vector<double>& spline = camera.spline.control_points;
  if (!std::isfinite(camera.fx_px + camera.fy_px + camera.cx_px + camera.cy_px) ||
      !std::all_of(camera.distortion.begin(), camera.distortion.end(), is_finite) ||
      !std::all_of(spline.begin(), spline.end(), is_finite)) {
    throw std::runtime_error(place + ": expected finite numbers");
  }
}

std::vector<FiledCamera> ReadCameraFile(const std::string& path) {
  std::vector<FiledCamera> cameras;
  switch (FormatOf(path)) {
    case Format::kOpenCv:
      cameras = {ReadOpenCvCamera(path)};
      break;
    case Format::kMrcal:
      cameras = {ReadMrcalCamera(path)};
      break;
    case Format::kKalibr:
      cameras = ReadKalibrCamchain(path);
      break;
    case Format::kColmap:
      for (const auto& [id, camera] : ReadColmapCameras(path))
        cameras.push_back({std::to_string(id), camera, std::nullopt});
      break;
  }
  if (cameras.empty()) throw std::runtime_error(path + ": expected at least one camera, got none");
  for (const FiledCamera& camera : cameras)
    CheckCamera(camera.camera, camera.name.empty() ? path : path + ": camera " + camera.name);
  return cameras;
}

Camera ReadCamera(const std::string& path, const std::string& name) {
  const std::vector<FiledCamera> cameras = ReadCameraFile(path);
  if (cameras.size() == 1) return cameras.front().camera;
  for (const FiledCamera& camera : cameras) {
    if (camera.name == name) return camera.camera;
  }
  throw std::runtime_error(path + ": expected a camera named \"" + name + "\" among those of the file (" +
                           Names(cameras) + "); give the session's camera the id it has there");
}

}  // namespace luxfit
