#include <yaml-cpp/yaml.h>

#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "calib/lens/internal/camera_formats.h"
#include "calib/lens/lens_family.h"

namespace luxfit {
namespace {

class Chain {
 public:
  explicit Chain(std::string path) : path_(std::move(path)) {}

  [[noreturn]] void Fail(const YAML::Mark& mark, const std::string& key, const std::string& what) const {
    throw std::runtime_error(path_ + (mark.is_null() ? "" : ":" + std::to_string(mark.line + 1)) + ": " +
                             key + ": " + what);
  }

  std::vector<double> Numbers(const YAML::Node& camera, const std::string& key, std::size_t count) const {
    const YAML::Node node = camera[key];
    if (!node || !node.IsSequence() || node.size() != count)
      Fail(node ? node.Mark() : camera.Mark(), key,
           "expected a list of " + std::to_string(count) + " numbers");
    std::vector<double> numbers;
    numbers.reserve(count);
    for (const YAML::Node& element : node) {
      try {
        numbers.push_back(element.as<double>());
      } catch (const YAML::Exception&) {
        Fail(element.Mark(), key, "expected a number, got \"" + element.Scalar() + "\"");
      }
    }
    return numbers;
  }

  std::string Text(const YAML::Node& camera, const std::string& key) const {
    const YAML::Node node = camera[key];
    if (!node || !node.IsScalar()) Fail(node ? node.Mark() : camera.Mark(), key, "expected a name");
    return node.Scalar();
  }

  Camera ReadLens(const YAML::Node& node) const {
    const std::string model = Text(node, "camera_model");
    if (model != "pinhole")
      Fail(node["camera_model"].Mark(), "camera_model", "expected pinhole, got \"" + model + "\"");
    Camera camera;
    const std::vector<double> size = Numbers(node, "resolution", 2);
    const std::string place =
        path_ + ":" + std::to_string(node["resolution"].Mark().line + 1) + ": resolution";
    camera.width_px = ImagePixels(size[0], place);
    camera.height_px = ImagePixels(size[1], place);
    const std::vector<double> k = Numbers(node, "intrinsics", 4);
    camera.fx_px = k[0];
    camera.fy_px = k[1];
    camera.cx_px = k[2];
    camera.cy_px = k[3];
    const std::string distortion = Text(node, "distortion_model");
    if (distortion == "none") return camera;
    if (distortion != "radtan" && distortion != "equidistant")
      Fail(node["distortion_model"].Mark(), "distortion_model",
           "expected radtan, equidistant or none, got \"" + distortion + "\"");
    camera.lens = LensOfDistortion(distortion);
    const std::vector<double> d = Numbers(node, "distortion_coeffs", 4);
    std::copy(d.begin(), d.end(), camera.distortion.begin());
    return camera;
  }

  // Reads the pose of this camera from the one before; nothing where the chain has none.
  std::optional<Eigen::Isometry3d> ReadStep(const YAML::Node& node) const {
    const std::string key = "T_cn_cnm1";
    if (!node[key]) return std::nullopt;
    const YAML::Node rows = node[key];
    if (!rows.IsSequence() || rows.size() != 4) Fail(rows.Mark(), key, "expected 4 rows of 4 numbers");
    Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
    for (int row = 0; row < 3; ++row) {
      const YAML::Node& line = rows[row];
      if (!line.IsSequence() || line.size() != 4) Fail(line.Mark(), key, "expected 4 rows of 4 numbers");
      for (int col = 0; col < 4; ++col) step.matrix()(row, col) = line[col].as<double>();
    }
    const Eigen::Matrix3d r = step.linear();
    if (!((r * r.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-3) || !(r.determinant() > 0))
      Fail(rows.Mark(), key, "expected a rotation matrix");
    return step;
  }

 private:
  std::string path_;
};

}  // namespace

std::vector<FiledCamera> ReadKalibrCamchain(const std::string& path) {
  const Chain chain(path);
  std::vector<FiledCamera> cameras;
  try {
    const YAML::Node root = YAML::LoadFile(path);
    for (int i = 0;; ++i) {
      const std::string name = "cam" + std::to_string(i);
      const YAML::Node node = root[name];
      if (!node) break;
      if (!node.IsMap()) chain.Fail(node.Mark(), name, "expected a camera");
      FiledCamera filed{name, chain.ReadLens(node), std::nullopt};
      const std::optional<Eigen::Isometry3d> step = chain.ReadStep(node);
      if (i == 0) filed.cam_from_reference = Eigen::Isometry3d::Identity();
      if (i > 0 && step && cameras.back().cam_from_reference)
        filed.cam_from_reference = *step * *cameras.back().cam_from_reference;
      cameras.push_back(filed);
    }
  } catch (const YAML::Exception& e) {
    throw std::runtime_error(path + ":" + std::to_string(e.mark.line + 1) +
                             ": cannot read the calibration, expected a Kalibr camchain (YAML): " + e.msg);
  }
  return cameras;
}

std::string KalibrCamchainYaml(const std::vector<FiledCamera>& cameras) {
  std::ostringstream out;
  out << std::setprecision(17);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const Camera& camera = cameras[i].camera;
    const LensOps& ops = OpsOf(camera.lens);
    const bool fits =
        !ops.has_control_points &&
        std::all_of(camera.distortion.begin() + 4, camera.distortion.end(), [](double k) { return k == 0; });
    if (!fits)
      throw std::invalid_argument("a Kalibr camchain holds k1 k2 p1 p2 or a fisheye's k1 to k4 only");
    out << "cam" << i << ":\n  camera_model: pinhole\n  intrinsics: [" << camera.fx_px << ", " << camera.fy_px
        << ", " << camera.cx_px << ", " << camera.cy_px
        << "]\n  distortion_model: " << (ops.distortion_model != nullptr ? ops.distortion_model : "radtan")
        << "\n  distortion_coeffs: [" << camera.distortion[0] << ", " << camera.distortion[1] << ", "
        << camera.distortion[2] << ", " << camera.distortion[3] << "]\n  resolution: [" << camera.width_px
        << ", " << camera.height_px << "]\n";
    if (i == 0) continue;
    if (!cameras[i].cam_from_reference || !cameras[i - 1].cam_from_reference)
      throw std::invalid_argument("a Kalibr camchain of several cameras needs the pose of each");
    const Eigen::Isometry3d step =
        *cameras[i].cam_from_reference * cameras[i - 1].cam_from_reference->inverse();
    out << "  T_cn_cnm1:\n";
    for (int row = 0; row < 4; ++row) {
      out << "  - [" << step.matrix()(row, 0) << ", " << step.matrix()(row, 1) << ", "
          << step.matrix()(row, 2) << ", " << step.matrix()(row, 3) << "]\n";
    }
  }
  return out.str();
}

}  // namespace luxfit
