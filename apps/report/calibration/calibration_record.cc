#include "apps/report/calibration/calibration_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "apps/text/formats/artifact.h"
#include "apps/text/formats/csv_table.h"
#include "apps/text/formats/json_vectors.h"
#include "apps/text/input_error.h"
#include "calib/lens/lens_family.h"

namespace luxfit {
namespace {

using nlohmann::json;

constexpr char kAgain[] = "run `luxfit calibrate` again";
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double NumberOr(const json& value, double absent) { return value.is_null() ? absent : value.get<double>(); }
double NumberOf(const json& value) { return NumberOr(value, std::numeric_limits<double>::quiet_NaN()); }

void Expect(bool holds, const char* what) {
  if (!holds) throw std::runtime_error(std::string("expected ") + what);
}

Eigen::Vector3d Vector3Of(const json& list) {
  Expect(list.size() == 3, "three numbers");
  return VectorFromJson(list);
}

Eigen::MatrixXd RasterOf(const json& rows) {
  Expect(!rows.empty() && !rows.at(0).empty(), "a raster of numbers");
  for (const json& row : rows) Expect(row.size() == rows.at(0).size(), "rows of equal length");
  return MatrixFromJson(rows);
}

Eigen::Isometry3d PoseOf(const json& rotation, const json& translation) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (int row = 0; row < 3; ++row)
    pose.linear().row(row) = Vector3Of(rotation.at(static_cast<std::size_t>(row))).transpose();
  pose.translation() = Vector3Of(translation);
  return pose;
}

void ReadParameters(const json& entry, RecordedCamera& camera) {
  camera.parameter_names = {"fx, px", "fy, px", "cx, px", "cy, px"};
  const std::optional<LensKind> kind = LensKindOf(entry.at("lens").get<std::string>());
  const Eigen::VectorXd distortion =
      entry.contains("distortion") ? VectorFromJson(entry.at("distortion")) : Eigen::VectorXd();
  Expect(kind && distortion.size() <= OpsOf(kind->lens).coefficients, "a lens and its coefficients");
  for (Eigen::Index i = 0; i < distortion.size(); ++i)
    camera.parameter_names.emplace_back(OpsOf(kind->lens).coefficient_names[static_cast<std::size_t>(i)]);
  camera.parameters.resize(4 + distortion.size());
  camera.parameters << entry.at("fx_px").get<double>(), entry.at("fy_px").get<double>(),
      entry.at("cx_px").get<double>(), entry.at("cy_px").get<double>(), distortion;
  const Eigen::VectorXd of_core = VectorOrUnknown(entry.at("fx_fy_cx_cy_sigma_px"), 4),
                        of_distortion =
                            VectorOrUnknown(entry.value("distortion_sigma", json()), distortion.size());
  Expect(of_core.size() == 4 && of_distortion.size() == distortion.size(),
         "a sigma for each parameter of the lens");
  camera.parameter_sigmas.resize(camera.parameters.size());
  camera.parameter_sigmas << of_core, of_distortion;
}

void ReadCoverage(const json& entry, RecordedCamera& camera) {
  const Eigen::MatrixXd counts = RasterOf(entry.at("corner_counts"));
  Expect(counts.allFinite(), "numbers of corners");
  camera.corner_counts = counts.cast<int>();
  camera.covered_share = entry.at("covered_share");
  camera.nearest_m = entry.at("nearest_m");
  camera.farthest_m = entry.at("farthest_m");
  camera.max_tilt_deg = NumberOf(entry.value("max_tilt_deg", json()));
  camera.lacks = entry.at("lacks").get<std::vector<std::string>>();
}

// Results of earlier versions have no circle.
ImageCircle CircleOf(const json& circle) {
  if (circle.is_null()) return {};
  const Eigen::VectorXd centre = VectorFromJson(circle.at("centre_px"));
  Expect(centre.size() == 2, "the centre of an image circle");
  return {centre, circle.at("radius_px")};
}

void ReadUncertainty(const json& entry, RecordedCamera& camera) {
  camera.middle_sigma_px = NumberOf(entry.at("middle_px"));
  camera.median_sigma_px = NumberOf(entry.at("median_px"));
  camera.uncertain_share = entry.at("share_above_limit");
  for (const json& map : entry.at("maps"))
    camera.maps.push_back({NumberOr(map.at("range_m"), kInfinity), RasterOf(map.at("sigma_px"))});
}

RecordedCamera CameraOf(const json& entry) {
  RecordedCamera camera;
  camera.id = entry.at("id");
  camera.width_px = entry.at("width_px");
  camera.height_px = entry.at("height_px");
  Expect(camera.width_px > 0 && camera.height_px > 0, "images of some size");
  ReadParameters(entry, camera);
  camera.cam_from_rig = PoseOf(entry.at("R_camera_from_rig"), entry.at("t_camera_from_rig_m"));
  camera.rotation_sigma_rad = Vector3Of(entry.at("camera_from_rig_sigma").at("rotation_rad"));
  camera.translation_sigma_m = Vector3Of(entry.at("camera_from_rig_sigma").at("translation_m"));
  camera.baseline_m = entry.at("baseline_m");
  camera.baseline_sigma_m = NumberOf(entry.at("baseline_sigma_m"));
  camera.rotation_deg = entry.at("rotation_deg");
  camera.rotation_sigma_deg = NumberOf(entry.at("rotation_sigma_deg"));
  for (std::size_t k = 0; k < camera.corner_directions.size(); ++k)
    camera.corner_directions[k] = Vector3Of(entry.at("corner_directions").at(k));
  camera.circle = CircleOf(entry.value("image_circle", json()));
  ReadUncertainty(entry.at("uncertainty"), camera);
  ReadCoverage(entry.at("coverage"), camera);
  return camera;
}

RecordedImage ImageOf(const json& entry) {
  RecordedImage image;
  image.file = entry.at("file");
  image.camera = entry.at("camera");
  image.set = entry.at("set");
  image.corners = entry.at("corners");
  image.outliers = entry.at("outliers");
  Expect(image.corners >= 0 && image.outliers >= 0, "numbers of corners");
  image.rms_px = entry.at("rms_px");
  image.cam_from_target = PoseOf(entry.at("R_camera_from_target"), entry.at("t_camera_from_target_m"));
  return image;
}

RecordedGroup GroupOf(const json& entry) {
  RecordedGroup group;
  group.is_usable = entry.at("usable");
  group.is_rig = entry.at("is_rig");
  group.board = entry.at("board").is_null() ? "" : entry.at("board");
  const json& extent = entry.at("target_extent_m");
  group.target = {Vector3Of(extent.at(0)), Vector3Of(extent.at(1))};
  group.lens = entry.at("lens").is_null() ? "" : entry.at("lens");
  group.rms_px = entry.at("reprojection_rms_px").at("per_axis");
  group.rms_2d_px = entry.at("reprojection_rms_px").at("two_d");
  group.noise_px = entry.at("noise_px");
  group.held_out_px = NumberOf(entry.at("held_out_rms_px"));
  group.outlier_share = entry.at("outlier_share");
  for (const json& camera : entry.at("cameras")) group.cameras.push_back(CameraOf(camera));
  for (const json& image : entry.at("images")) group.images.push_back(ImageOf(image));
  for (const json& image : entry.at("images_left_out"))
    group.left_out.push_back({image.at("file"), image.at("camera"), image.at("reason")});
  return group;
}

// Throws where something lacks that the page shows as it is.
void ExpectWhole(const json& artifact) {
  for (const char* key : {"session", "status", "command", "luxfit_version"})
    artifact.at(key).get<std::string>();
  artifact.at("inputs").get<std::map<std::string, std::string>>();
  artifact.at("files").get<std::vector<std::string>>();
  for (const json& choice : artifact.at("choices")) {
    for (const char* key : {"what", "chosen", "because"}) choice.at(key).get<std::string>();
    choice.at("among").get<std::vector<std::string>>();
  }
  for (const json& warning : artifact.at("warnings")) {
    for (const char* key : {"code", "message", "remedy"}) warning.at(key).get<std::string>();
  }
}

// Returns why the lens of these cameras was chosen.
std::string ReasonOfLens(const json& artifact, const std::string& cameras) {
  for (const json& choice : artifact.at("choices")) {
    if (choice.at("what") == "lens of " + cameras) return choice.at("because");
  }
  return "";
}

SeenCorner CornerOf(const CsvTable& table, const CsvRow& row) {
  SeenCorner corner;
  corner.pixel = {CsvNumber(table, row, "x_px"), CsvNumber(table, row, "y_px")};
  corner.is_outlier = CsvText(table, row, "outlier") == "1";
  // Where the lens has no image of a corner, the corner is left out and its residual is no number.
  if (corner.is_outlier && CsvText(table, row, "residual_x_px").find('n') != std::string::npos)
    corner.residual_px.setConstant(std::numeric_limits<double>::quiet_NaN());
  else
    corner.residual_px = {CsvNumber(table, row, "residual_x_px"), CsvNumber(table, row, "residual_y_px")};
  return corner;
}

// Hands the rows of the table to the cameras of the images, in their order.
void ReadCorners(const std::string& path, std::vector<RecordedGroup>& groups) {
  std::size_t expected = 0;
  for (const RecordedGroup& group : groups) {
    for (const RecordedImage& image : group.images) expected += static_cast<std::size_t>(image.corners);
  }
  if (expected == 0) return;
  const CsvTable table = ReadCsvTable(
      path, {{"file", "camera", "corner", "residual_x_px", "residual_y_px", "outlier"}, {"x_px", "y_px"}});
  if (table.rows.size() != expected || !HasColumn(table, "x_px") || !HasColumn(table, "y_px"))
    throw InputError(
        {path, 0}, "",
        fmt::format("expected the {} corners of stages/calibrate.json with x_px and y_px, got {} rows of "
                    "another calibration; {}",
                    expected, table.rows.size(), kAgain));
  auto row = table.rows.begin();
  for (RecordedGroup& group : groups) {
    for (const RecordedImage& image : group.images) {
      const auto camera = std::find_if(group.cameras.begin(), group.cameras.end(),
                                       [&](const RecordedCamera& c) { return c.id == image.camera; });
      for (int k = 0; k < image.corners; ++k, ++row) {
        if (camera != group.cameras.end()) camera->corners.push_back(CornerOf(table, *row));
      }
    }
  }
}

}  // namespace

std::string CalibrationFileOf(const std::string& out) { return out + "/stages/calibrate.json"; }

CalibrationRecord ReadCalibrationRecord(const std::string& out) {
  CalibrationRecord record;
  record.out = std::filesystem::absolute(out).lexically_normal().string();
  const std::string path = CalibrationFileOf(record.out);
  const auto artifact = std::make_shared<const json>(ReadJson(path));
  if (!artifact->is_object() || artifact->value("format", "") != "luxfit-calibrate-1")
    throw InputError({path, 0}, "format",
                     std::string("expected \"luxfit-calibrate-1\", got another file; ") + kAgain);
  record.artifact = artifact;
  try {
    ExpectWhole(*artifact);
    for (const json& group : artifact->at("groups")) record.groups.push_back(GroupOf(group));
    for (RecordedGroup& group : record.groups)
      group.lens_because = ReasonOfLens(*artifact, CameraNames(group));
  } catch (const std::exception& e) {
    throw InputError({path, 0}, "",
                     fmt::format("expected a whole calibration of this version; {}; {}", kAgain, e.what()));
  }
  ReadCorners(record.out + "/corner_residuals.csv", record.groups);
  return record;
}

std::string CameraNames(const RecordedGroup& group) {
  std::string names;
  for (const RecordedCamera& camera : group.cameras) names += (names.empty() ? "" : ", ") + camera.id;
  return names;
}

}  // namespace luxfit
