#include "apps/stages/calibrate/calibration_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/charts/uncertainty_svg.h"
#include "apps/text/file_stem.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/formats/csv_text.h"
#include "calib/lens/camera_file.h"
#include "calib/lens/lens_family.h"
#include "calib/lens/projection_uncertainty.h"
#include "calib/targets/board.h"
#include "forward/room/one_line.h"

namespace luxfit {
namespace {

std::vector<std::string> FailedGates(const Calibration& calibration) {
  std::vector<std::string> reasons;
  for (const CalibrationNote& note : calibration.notes) {
    if (note.fails) reasons.push_back(note.message);
  }
  return reasons;
}

// Inserts comments after the first `lines` lines, which some formats require first.
std::string Marked(const std::string& text, const std::vector<std::string>& reasons, int lines) {
  if (reasons.empty()) return text;
  std::size_t at = 0;
  for (int i = 0; i < lines; ++i) at = text.find('\n', at) + 1;
  std::string comments = "# NOT USABLE as it is:\n";
  for (const std::string& reason : reasons) comments += "#   " + reason + "\n";
  return text.substr(0, at) + comments + text.substr(at);
}

// Returns the pixels at which the calibration's corners were seen, in the order of its residuals.
std::vector<Eigen::Vector2d> PixelsOf(const CalibratedGroup& calibrated) {
  const CalibrationInput& input = calibrated.group.input;
  std::map<std::pair<int, int>, Eigen::Vector2d> seen;
  for (std::size_t i = 0; i < input.images.size(); ++i) {
    for (const BoardCorner& corner : input.images[i].corners)
      seen[{static_cast<int>(i), corner.index}] = corner.pixel;
  }
  std::vector<Eigen::Vector2d> pixels;
  pixels.reserve(calibrated.calibration.corners.size());
  for (const CornerResidual& corner : calibrated.calibration.corners)
    pixels.push_back(seen.at({corner.image, corner.index}));
  return pixels;
}

UncertaintyMap MapOf(const CalibratedCamera& camera) {
  constexpr int kColumns = 40;
  const Camera& c = camera.camera;
  const int rows = std::max(1, static_cast<int>(std::lround(1.0 * kColumns * c.height_px / c.width_px)));
  UncertaintyMap map;
  map.title = fmt::format("{}: how uncertain a direction's pixel is (1 sigma)", camera.id);
  map.subtitle =
      fmt::format("{} x {} px, {}; median {:.2g} px; above the limit over {:.1f} % of the image{}",
                  c.width_px, c.height_px, ToString(camera.uncertainty.kind), camera.median_sigma_px,
                  100 * camera.uncertain_share, camera.circle.IsWholePicture() ? "" : " circle");
  map.width_px = c.width_px;
  map.height_px = c.height_px;
  map.circle = camera.circle;
  map.sigma_px =
      ProjectionSigmaMap(c, camera.uncertainty, kColumns, rows, std::numeric_limits<double>::infinity());
  return map;
}

std::vector<MappedCorner> CornersOf(const CalibratedGroup& calibrated, int camera) {
  const std::vector<Eigen::Vector2d> pixels = PixelsOf(calibrated);
  std::vector<MappedCorner> corners;
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    const CornerResidual& corner = calibrated.calibration.corners[k];
    if (calibrated.group.input.images[static_cast<std::size_t>(corner.image)].camera == camera)
      corners.push_back({pixels[k], corner.is_outlier});
  }
  return corners;
}

// Returns the field of a name, always with quotes. Bytes that are no UTF-8 become U+FFFD, as in the artifact.
std::string QuotedField(const std::string& name) {
  using nlohmann::json;
  const std::string whole = json(OneLine(name)).dump(-1, ' ', false, json::error_handler_t::replace);
  const std::string field = CsvField(json::parse(whole).get<std::string>());
  return !field.empty() && field.front() == '"' ? field : '"' + field + '"';
}

std::string ResidualsCsv(const std::vector<CalibratedGroup>& groups) {
  std::string text = "file,camera,corner,residual_x_px,residual_y_px,outlier,x_px,y_px\n";
  for (const CalibratedGroup& calibrated : groups) {
    const CalibrationInput& input = calibrated.group.input;
    const std::vector<Eigen::Vector2d> pixels = PixelsOf(calibrated);
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      const CornerResidual& corner = calibrated.calibration.corners[k];
      const CalibrationImage& image = input.images[static_cast<std::size_t>(corner.image)];
      text += fmt::format("{},{},{},{:.4f},{:.4f},{:d},{:.3f},{:.3f}\n", QuotedField(FileName(image.name)),
                          QuotedField(input.cameras[static_cast<std::size_t>(image.camera)].id), corner.index,
                          corner.residual_px.x(), corner.residual_px.y(), corner.is_outlier, pixels[k].x(),
                          pixels[k].y());
    }
  }
  return text;
}

class FileWriter {
 public:
  explicit FileWriter(std::string folder) : folder_(std::move(folder)) {}

  // Formats that cannot hold a lens throw std::invalid_argument.
  template <typename Text>
  void Add(const std::string& name, const Text& text) {
    try {
      WriteText(folder_ + "/" + name, text());
      names_.push_back(name);
    } catch (const std::invalid_argument&) {
      return;
    }
  }

  std::vector<std::string> names() const { return names_; }

 private:
  std::string folder_;
  std::vector<std::string> names_;
};

void WriteCameraFiles(const CalibratedGroup& calibrated, FileWriter& files) {
  const std::vector<std::string> reasons = FailedGates(calibrated.calibration);
  for (std::size_t c = 0; c < calibrated.calibration.cameras.size(); ++c) {
    const CalibratedCamera& camera = calibrated.calibration.cameras[c];
    const std::string stem = FileStem(camera.id);
    files.Add(stem + ".yaml", [&] { return Marked(OpenCvCameraYaml(camera.camera), reasons, 2); });
    files.Add(stem + ".cameramodel", [&] {
      return Marked(MrcalCameraModel({camera.id, camera.camera, camera.cam_from_rig}), reasons, 0);
    });
    files.Add(stem + "_uncertainty.svg",
              [&] { return UncertaintySvg(MapOf(camera), CornersOf(calibrated, static_cast<int>(c))); });
  }
}

// Writes one chain for a rig. Single cameras would each form a chain, so only the first group is written.
void WriteSharedFiles(const std::vector<CalibratedGroup>& groups, FileWriter& files) {
  std::map<ColmapId, Camera> colmap;
  std::vector<std::string> reasons;
  std::vector<ImageCorners> corners;
  for (const CalibratedGroup& calibrated : groups) {
    for (const CalibratedCamera& camera : calibrated.calibration.cameras)
      colmap[static_cast<int>(colmap.size()) + 1] = camera.camera;
    for (const std::string& reason : FailedGates(calibrated.calibration)) reasons.push_back(reason);
  }
  if (!colmap.empty())
    files.Add("cameras.txt", [&] { return Marked(ColmapCamerasText(colmap), reasons, 0); });
  const std::vector<CalibratedCamera>& rig = groups.front().calibration.cameras;
  std::vector<FiledCamera> chain;
  chain.reserve(rig.size());
  for (const CalibratedCamera& camera : rig) chain.push_back({camera.id, camera.camera, camera.cam_from_rig});
  if (!chain.empty())
    files.Add("camchain.yaml",
              [&] { return Marked(KalibrCamchainYaml(chain), FailedGates(groups.front().calibration), 0); });
  const CalibrationInput& input = groups.front().group.input;
  for (const CalibrationImage& image : input.images) corners.push_back({FileName(image.name), image.corners});
  files.Add("corners.vnl",
            [&] { return CornersFile(corners, static_cast<int>(input.target.points.size())); });
  files.Add("corner_residuals.csv", [&] { return ResidualsCsv(groups); });
}

}  // namespace

std::vector<std::string> WriteCalibrationFiles(const std::vector<CalibratedGroup>& groups,
                                               const std::string& folder) {
  FileWriter files(folder);
  for (const CalibratedGroup& calibrated : groups) WriteCameraFiles(calibrated, files);
  if (!groups.empty()) WriteSharedFiles(groups, files);
  return files.names();
}

}  // namespace luxfit
