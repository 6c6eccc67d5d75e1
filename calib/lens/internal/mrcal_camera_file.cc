#include <array>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>

#include "calib/lens/internal/camera_formats.h"
#include "calib/lens/internal/mrcal_lens.h"
#include "calib/lens/internal/python_dict.h"
#include "calib/lens/internal/rotation_vector.h"

namespace luxfit {
namespace {

std::string Read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

[[noreturn]] void Fail(const std::string& path, int line, const std::string& key, const std::string& what) {
  throw std::runtime_error(path + (line > 0 ? ":" + std::to_string(line) : "") + ": " + key + ": " + what);
}

using Entries = std::map<std::string, PythonValue>;

const PythonValue& Numbers(const Entries& entries, const std::string& path, const std::string& key,
                           std::size_t count) {
  const auto at = entries.find(key);
  const std::string expected = "expected a list of " + std::to_string(count) + " numbers";
  if (at == entries.end()) Fail(path, 0, key, expected + ", got nothing; is this a .cameramodel of mrcal?");
  if (!at->second.is_numbers || at->second.numbers.size() != count)
    Fail(path, at->second.line, key,
         expected + (at->second.is_numbers ? ", got " + std::to_string(at->second.numbers.size()) : ""));
  return at->second;
}

MrcalLens ReadLens(const Entries& entries, const std::string& path) {
  const auto at = entries.find("lensmodel");
  if (at == entries.end() || !at->second.is_text)
    Fail(path, at == entries.end() ? 0 : at->second.line, "lensmodel",
         "expected a name; is this a .cameramodel of mrcal?");
  MrcalLens lens{};
  if (!mrcal_lensmodel_from_name(&lens.model, at->second.text.c_str()) ||
      !mrcal_lensmodel_type_is_valid(lens.model.type)) {
    Fail(path, at->second.line, "lensmodel", "expected a lens model of mrcal, got '" + at->second.text + "'");
  }
  const int count = mrcal_lensmodel_num_params(&lens.model);
  lens.intrinsics = Numbers(entries, path, "intrinsics", static_cast<std::size_t>(count)).numbers;
  return lens;
}

template <typename Values>
void AppendNumbers(const Values& values, std::ostringstream& out) {
  for (const double value : values) out << " " << value << ",";
}

}  // namespace

FiledCamera ReadMrcalCamera(const std::string& path) {
  const std::string text = Read(path);
  const Entries entries = ParsePythonDict(text, path);
  const MrcalLens lens = ReadLens(entries, path);
  const PythonValue& imager = Numbers(entries, path, "imagersize", 2);
  Camera size;
  const std::string place = path + ":" + std::to_string(imager.line) + ": imagersize";
  size.width_px = ImagePixels(imager.numbers[0], place);
  size.height_px = ImagePixels(imager.numbers[1], place);
  // mrcal 2.4 and later name the entry rt_cam_ref.
  const std::string pose = entries.count("extrinsics") > 0 ? "extrinsics" : "rt_cam_ref";
  const std::vector<double>& rt = Numbers(entries, path, pose, 6).numbers;
  try {
    return {"", FromMrcal(lens, size), PoseOf(rt.data(), rt.data() + 3)};
  } catch (const std::invalid_argument& e) {
    Fail(path, entries.at("lensmodel").line, "lensmodel",
         e.what() + std::string("; convert it with mrcal-convert-lensmodel"));
  }
}

std::string MrcalCameraModel(const FiledCamera& filed) {
  const MrcalLens lens = ToMrcal(filed.camera);
  char name[128];
  if (!mrcal_lensmodel_name(name, sizeof(name), &lens.model))
    throw std::invalid_argument("camera: mrcal has no name for the lens model");
  const Eigen::Isometry3d pose = filed.cam_from_reference.value_or(Eigen::Isometry3d::Identity());
  const Eigen::Vector3d r = RotationVectorOf(pose.linear());
  std::ostringstream out;
  out << std::setprecision(17) << "{\n    'lensmodel':  '" << name << "',\n\n"
      << "    # intrinsics are fx,fy,cx,cy,distortion0,distortion1,....\n    'intrinsics': [";
  AppendNumbers(lens.intrinsics, out);
  out << "],\n\n    # extrinsics are rt_fromref\n    'extrinsics': [";
  AppendNumbers(std::array<double, 6>{r.x(), r.y(), r.z(), pose.translation().x(), pose.translation().y(),
                                      pose.translation().z()},
                out);
  out << "],\n\n    'imagersize': [ " << filed.camera.width_px << ", " << filed.camera.height_px << ",]\n}\n";
  return out.str();
}

}  // namespace luxfit
