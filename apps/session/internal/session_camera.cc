#include "apps/session/internal/session_camera.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "apps/session/internal/session_board.h"
#include "apps/session/session_files.h"
#include "calib/colour/camera_colours.h"

namespace luxfit {
namespace {

std::string ReadIntrinsics(const TomlCursor& value, const std::string& folder) {
  const std::string expected = ExpectedIntrinsics();
  const std::string extension = ExtensionOf(value.Text(expected));
  const std::vector<std::string> known = {".yaml", ".yml", ".xml", ".cameramodel", ".txt", ".bin"};
  if (std::find(known.begin(), known.end(), extension) == known.end())
    throw value.Error("expected " + expected + ", got " + value.Shown());
  return AbsolutePath(FindFile(value, folder));
}

Eigen::Vector3d ReadLuminanceWeights(const TomlCursor& value) {
  Eigen::Vector3d weights = value.Vector("three weights [r, g, b]");
  if (weights.sum() <= 0)
    throw value.Error("expected weights of a sum > 0, got " + value.Shown() +
                      "; the default is [0.265, 0.670, 0.065]");
  return weights;
}

Eigen::Matrix3d ReadXyzFromRgb(const TomlCursor& value) {
  const std::string expected = "three rows [r, g, b], which give X, Y and Z";
  const std::vector<TomlCursor> rows = value.Elements(expected);
  if (rows.size() != 3) throw value.Error("expected " + expected + ", got " + value.Shown());
  Eigen::Matrix3d matrix;
  for (size_t i = 0; i < rows.size(); ++i)
    matrix.row(static_cast<Eigen::Index>(i)) = rows[i].Vector("three numbers [r, g, b]");
  constexpr double kLeastDeterminant = 1e-9;
  const double scale = matrix.cwiseAbs().maxCoeff();
  if (!(std::abs(matrix.determinant()) > kLeastDeterminant * scale * scale * scale) ||
      !(matrix.row(1).sum() > 0))
    throw value.Error("expected a matrix that has an inverse and a row of Y with a sum > 0, got " +
                      value.Shown());
  return matrix;
}

void ReadColours(const TomlCursor& table, SessionCamera& camera) {
  const auto weights = table.Find("luminance_weights"), matrix = table.Find("xyz_from_rgb");
  if (weights && matrix)
    throw matrix->Error(
        "expected either luminance_weights or xyz_from_rgb, whose row of Y is the weights; remove one of the "
        "two");
  if (weights) {
    camera.luminance_weights = ReadLuminanceWeights(*weights);
    camera.colours = "luminance_weights";
  }
  if (matrix) {
    camera.xyz_from_rgb = ReadXyzFromRgb(*matrix);
    camera.luminance_weights = LuminanceWeightsOf(*camera.xyz_from_rgb);
    camera.colours = "xyz_from_rgb";
  }
}

// Holds a word, or the name of a file and its absolute path.
struct NameOrFile {
  std::string name, path;
};
// Reads one of the words, of which the first is the default, or a file.
NameOrFile ReadNameOrFile(const TomlCursor& table, const std::string& key,
                          const std::vector<std::string>& words, const std::string& folder) {
  const auto value = table.Find(key);
  if (!value) return {words.front(), ""};
  const std::string name = value->Text(fmt::format("\"{}\" or a file", fmt::join(words, "\", \"")));
  if (std::find(words.begin(), words.end(), name) != words.end()) return {name, ""};
  // A word without an extension is a misspelt name, not a missing file.
  if (ExtensionOf(name).empty()) value->OneOf(words);
  return {name, AbsolutePath(FindFile(*value, folder))};
}

Eigen::Array2i ReadImageSize(const TomlCursor& value) {
  const std::vector<double> size = value.Numbers("[width, height] in pixels");
  constexpr double kMostPx = 1e6;
  for (const double side : size) {
    if (size.size() != 2 || !(side >= 1 && side <= kMostPx) || side != static_cast<int>(side))
      throw value.Error("expected [width, height] in whole pixels, got " + value.Shown());
  }
  if (size.empty()) throw value.Error("expected [width, height] in whole pixels, got none");
  return {static_cast<int>(size[0]), static_cast<int>(size[1])};
}

SessionCamera ReadCamera(const TomlCursor& table, const std::string& folder) {
  table.ExpectKeys({"id", "intrinsics", "calibration_images", "calibration_corners", "image_size", "board",
                    "response", "vignetting", "black_level", "cdm2_per_count_s", "luminance_weights",
                    "xyz_from_rgb"});
  SessionCamera camera;
  if (const auto board = table.Find("board")) camera.board = ReadBoard(*board);
  if (const auto images = table.Find("calibration_images"))
    camera.calibration_images = FindFiles(*images, folder);
  if (const auto corners = table.Find("calibration_corners"))
    camera.calibration_corners = AbsolutePath(FindFile(*corners, folder));
  if (const auto size = table.Find("image_size")) camera.image_size_px = ReadImageSize(*size);
  if (const auto intrinsics = table.Find("intrinsics"))
    camera.intrinsics = ReadIntrinsics(*intrinsics, folder);
  const NameOrFile response = ReadNameOrFile(table, "response", {"linear", "srgb", "estimate"}, folder);
  camera.response = response.name;
  camera.response_path = response.path;
  const NameOrFile vignetting = ReadNameOrFile(table, "vignetting", {"none", "estimate"}, folder);
  camera.vignetting = vignetting.name;
  camera.vignetting_path = vignetting.path;
  camera.line = table.place().line;
  if (const auto black = table.Find("black_level"))
    camera.black_level_counts = black->NumberAtLeast(0, "counts");
  if (const auto scale = table.Find("cdm2_per_count_s"))
    camera.cdm2_per_count_s = scale->NumberAtLeast(0, "cd/m2 per (count / s); 0: unknown");
  ReadColours(table, camera);
  return camera;
}

}  // namespace

std::string ExpectedIntrinsics() {
  return "a file of intrinsics (OpenCV YAML or XML, mrcal .cameramodel, COLMAP cameras.txt or .bin, Kalibr "
         "camchain), or calibration_images";
}

std::vector<SessionCamera> ReadCameras(const TomlCursor& list, const std::string& folder) {
  const std::vector<TomlCursor> tables = list.Elements("a list of tables [[camera]]");
  std::vector<SessionCamera> cameras;
  cameras.reserve(tables.size());
  for (const TomlCursor& table : tables) cameras.push_back(ReadCamera(table, folder));
  const std::vector<std::string> ids = UniqueIds(tables);
  for (size_t i = 0; i < cameras.size(); ++i) cameras[i].id = ids[i];
  return cameras;
}

}  // namespace luxfit
