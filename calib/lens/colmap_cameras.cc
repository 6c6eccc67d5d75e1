#include "calib/lens/camera_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "calib/lens/internal/camera_formats.h"
#include "calib/lens/internal/colmap_binary.h"

namespace luxfit {
namespace {

const Eigen::Vector2d kFirstPixelCentre(0.5, 0.5);  // pixel (0, 0) in COLMAP's coordinates

// Lists COLMAP's models in the order of their ids. `focals`: 1 for f, 2 for fx, fy; `coefficients`: how many
// of Camera::distortion the model has, in COLMAP's order.
struct Model {
  const char* name;
  LensModel lens;
  std::size_t focals;
  std::size_t coefficients;
  bool is_served;
};
constexpr std::array<Model, 11> kModels = {{{"SIMPLE_PINHOLE", LensModel::kOpenCv, 1, 0, true},
                                            {"PINHOLE", LensModel::kOpenCv, 2, 0, true},
                                            {"SIMPLE_RADIAL", LensModel::kOpenCv, 1, 1, true},
                                            {"RADIAL", LensModel::kOpenCv, 1, 2, true},
                                            {"OPENCV", LensModel::kOpenCv, 2, 4, true},
                                            {"OPENCV_FISHEYE", LensModel::kFisheye, 2, 4, true},
                                            {"FULL_OPENCV", LensModel::kOpenCv, 2, 8, true},
                                            {"FOV", LensModel::kOpenCv, 2, 1, false},
                                            {"SIMPLE_RADIAL_FISHEYE", LensModel::kFisheye, 1, 1, true},
                                            {"RADIAL_FISHEYE", LensModel::kFisheye, 1, 2, true},
                                            {"THIN_PRISM_FISHEYE", LensModel::kFisheye, 2, 8, false}}};

constexpr char kModelRemedy[] =
    "run COLMAP with --ImageReader.camera_model FULL_OPENCV, or OPENCV_FISHEYE for a fisheye lens";

std::size_t ParameterCount(const Model& model) { return model.focals + 2 + model.coefficients; }

const Model& Served(const Model& model, const std::string& place) {
  if (!model.is_served)
    throw std::runtime_error(place + ": expected a camera model other than FOV and THIN_PRISM_FISHEYE, got " +
                             model.name + "; " + kModelRemedy);
  return model;
}

Camera ToCamera(const Model& model, int width_px, int height_px, const std::vector<double>& parameters) {
  Camera camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.lens = model.lens;
  camera.fx_px = parameters[0];
  camera.fy_px = parameters[model.focals - 1];
  const Eigen::Vector2d centre = FromColmapPixel({parameters[model.focals], parameters[model.focals + 1]});
  camera.cx_px = centre.x();
  camera.cy_px = centre.y();
  std::copy(parameters.begin() + static_cast<std::ptrdiff_t>(model.focals + 2), parameters.end(),
            camera.distortion.begin());
  return camera;
}

// Reads one line of cameras.txt.
class CameraLine {
 public:
  CameraLine(std::string place, const std::string& line) : place_(std::move(place)), words_(line) {}

  std::pair<ColmapId, Camera> Read() {
    ColmapId id = 0;
    int width_px = 0, height_px = 0;
    std::string name;
    if (!(words_ >> id >> name >> width_px >> height_px))
      Fail("expected CAMERA_ID MODEL WIDTH HEIGHT PARAMS...; is this COLMAP's cameras.txt?");
    const auto model =
        std::find_if(kModels.begin(), kModels.end(), [&name](const Model& m) { return name == m.name; });
    if (model == kModels.end())
      Fail("expected a camera model of COLMAP 3.8, got \"" + name + "\"; " + kModelRemedy);
    std::vector<double> parameters;
    for (double value = 0; words_ >> value;) parameters.push_back(value);
    if (!words_.eof() || parameters.size() != ParameterCount(*model)) {
      Fail("expected " + std::to_string(ParameterCount(*model)) + " parameters of " + model->name + ", got " +
           std::to_string(parameters.size()));
    }
    return {id, ToCamera(Served(*model, place_), width_px, height_px, parameters)};
  }

 private:
  [[noreturn]] void Fail(const std::string& message) const {
    throw std::runtime_error(place_ + ": " + message);
  }

  std::string place_;
  std::istringstream words_;
};

std::map<ColmapId, Camera> ReadText(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot read COLMAP's cameras, expected an existing file");
  std::map<ColmapId, Camera> cameras;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line[0] == '#' || line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::string place = path + ":" + std::to_string(number);
    const auto [id, camera] = CameraLine(place, line).Read();
    if (!cameras.emplace(id, camera).second)
      throw std::runtime_error(place + ": expected every camera once, got " + std::to_string(id) + " again");
  }
  return cameras;
}

std::map<ColmapId, Camera> ReadBinary(const std::string& path) {
  ColmapBinary file(path);
  std::map<ColmapId, Camera> cameras;
  const auto count = file.Read<std::uint64_t>();
  for (std::uint64_t i = 0; i < count; ++i) {
    const ColmapId id = file.Read<std::uint32_t>();
    const auto model_id = file.Read<std::int32_t>();
    const int width_px = ImagePixels(static_cast<double>(file.Read<std::uint64_t>()), path + ": width");
    const int height_px = ImagePixels(static_cast<double>(file.Read<std::uint64_t>()), path + ": height");
    if (model_id < 0 || model_id >= static_cast<int>(kModels.size()))
      throw std::runtime_error(path + ": expected a camera model of COLMAP 3.8 (0 to 10), got " +
                               std::to_string(model_id) + "; " + kModelRemedy);
    const Model& model = Served(kModels[static_cast<std::size_t>(model_id)], path);
    std::vector<double> parameters(ParameterCount(model));
    for (double& value : parameters) value = file.Read<double>();
    cameras[id] = ToCamera(model, width_px, height_px, parameters);
  }
  return cameras;
}

}  // namespace

Eigen::Vector2d FromColmapPixel(const Eigen::Vector2d& colmap_px) { return colmap_px - kFirstPixelCentre; }

Eigen::Vector2d ToColmapPixel(const Eigen::Vector2d& pixel) { return pixel + kFirstPixelCentre; }

std::map<ColmapId, Camera> ReadColmapCameras(const std::string& path) {
  return std::filesystem::path(path).extension() == ".bin" ? ReadBinary(path) : ReadText(path);
}

ColmapCameraModel ToColmapModel(const Camera& camera) {
  std::size_t used = camera.distortion.size();
  while (used > 0 && camera.distortion[used - 1] == 0) --used;
  const Model* shortest = nullptr;
  for (const Model& m : kModels) {
    if (m.lens == camera.lens && m.is_served && m.focals == 2 && m.coefficients >= used &&
        (shortest == nullptr || m.coefficients < shortest->coefficients))
      shortest = &m;
  }
  if (shortest == nullptr) throw std::invalid_argument("COLMAP has no splined lens and no thin prism terms");
  ColmapCameraModel model;
  model.name = shortest->name;
  const Eigen::Vector2d centre = ToColmapPixel({camera.cx_px, camera.cy_px});
  std::ostringstream text;
  text << std::setprecision(17) << camera.fx_px << "," << camera.fy_px << "," << centre.x() << ","
       << centre.y();
  for (std::size_t i = 0; i < shortest->coefficients; ++i) text << "," << camera.distortion[i];
  model.parameters = text.str();
  return model;
}

std::string ColmapCamerasText(const std::map<ColmapId, Camera>& cameras) {
  std::string text = "# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n";
  for (const auto& [id, camera] : cameras) {
    ColmapCameraModel model = ToColmapModel(camera);
    std::replace(model.parameters.begin(), model.parameters.end(), ',', ' ');
    text += std::to_string(id) + " " + model.name + " " + std::to_string(camera.width_px) + " " +
            std::to_string(camera.height_px) + " " + model.parameters + "\n";
  }
  return text;
}

}  // namespace luxfit
