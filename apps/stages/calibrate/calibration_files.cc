#include "apps/stages/calibrate/calibration_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/charts/uncertainty_svg.h"
#include "apps/text/file_stem.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/formats/json_vectors.h"
#include "calib/calibrate/rig_pose.h"
#include "calib/lens/camera_file.h"
#include "calib/lens/lens_family.h"
#include "calib/targets/board.h"

namespace luxfit {
namespace {

using nlohmann::json;

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

json CoverageJson(const CalibrationCoverage& coverage) {
  json rows = json::array();
  for (Eigen::Index row = 0; row < coverage.corner_counts.rows(); ++row) {
    json counts = json::array();
    for (Eigen::Index column = 0; column < coverage.corner_counts.cols(); ++column)
      counts.push_back(coverage.corner_counts(row, column));
    rows.push_back(counts);
  }
  json out = {{"covered_share", coverage.covered_share},
              {"corner_counts", rows},
              {"images", coverage.images},
              {"nearest_m", coverage.nearest_m},
              {"farthest_m", coverage.farthest_m},
              {"lacks", coverage.lacks}};
  if (coverage.is_flat) out["max_tilt_deg"] = coverage.max_tilt_deg;
  return out;
}

// Returns the kind's name in artifacts. It has capitals there (OPENCV8), because scripts compare it.
std::string ArtifactName(const LensKind& kind) {
  std::string name = ToString(kind);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return name;
}

// Returns the sigmas of fx, fy, cx, cy, which splined lenses hold.
json CoreSigmas(const CalibratedCamera& camera) {
  const Eigen::MatrixXd& covariance = camera.uncertainty.covariance;
  if (OpsOf(camera.uncertainty.kind.lens).has_control_points || covariance.rows() < 4) return nullptr;
  return VectorJson(covariance.diagonal().head<4>().cwiseSqrt().eval());
}

json CameraJson(const CalibratedCamera& camera) {
  const Camera& c = camera.camera;
  const double infinity = std::numeric_limits<double>::infinity();
  const Eigen::Vector2d middle((c.width_px - 1) / 2.0, (c.height_px - 1) / 2.0);
  json out = {{"id", camera.id},
              {"width_px", c.width_px},
              {"height_px", c.height_px},
              {"fx_px", c.fx_px},
              {"fy_px", c.fy_px},
              {"cx_px", c.cx_px},
              {"cy_px", c.cy_px},
              {"lens", ArtifactName(camera.uncertainty.kind)},
              {"fx_fy_cx_cy_sigma_px", CoreSigmas(camera)}};
  if (!OpsOf(c.lens).has_control_points)
    out["distortion"] = std::vector<double>(c.distortion.begin(),
                                            c.distortion.begin() + camera.uncertainty.kind.coefficients);
  out["position_in_rig_m"] = VectorJson(camera.cam_from_rig.inverse().translation().eval());
  json rotation = json::array();
  for (int row = 0; row < 3; ++row)
    rotation.push_back(VectorJson(camera.cam_from_rig.linear().row(row).eval()));
  out["R_camera_from_rig"] = rotation;
  out["t_camera_from_rig_m"] = VectorJson(camera.cam_from_rig.translation().eval());
  const Eigen::VectorXd sigma = camera.cam_from_rig_covariance.diagonal().cwiseSqrt();
  out["camera_from_rig_sigma"] = {{"rotation_rad", VectorJson(sigma.head<3>())},
                                  {"translation_m", VectorJson(sigma.tail<3>())}};
  constexpr double kDegPerRad = 180 / M_PI;
  const RigPose pose = RigPoseOf(camera);
  out["baseline_m"] = pose.baseline_m;
  out["baseline_sigma_m"] = NumberOrNull(pose.baseline_sigma_m);
  out["rotation_deg"] = kDegPerRad * pose.angle_rad;
  out["rotation_sigma_deg"] = NumberOrNull(kDegPerRad * pose.angle_sigma_rad);
  out["uncertainty"] = {
      {"middle_px", NumberOrNull(ProjectionSigmaPx(c, camera.uncertainty, middle, infinity))},
      {"median_px", NumberOrNull(camera.median_sigma_px)},
      {"share_above_limit", camera.uncertain_share}};
  out["coverage"] = CoverageJson(camera.coverage);
  return out;
}

std::vector<MappedCorner> CornersOf(const CalibratedGroup& calibrated, int camera) {
  const CalibrationInput& input = calibrated.group.input;
  std::vector<MappedCorner> corners;
  std::map<std::pair<int, int>, Eigen::Vector2d> pixels;
  for (std::size_t i = 0; i < input.images.size(); ++i) {
    for (const BoardCorner& corner : input.images[i].corners)
      pixels[{static_cast<int>(i), corner.index}] = corner.pixel;
  }
  for (const CornerResidual& corner : calibrated.calibration.corners) {
    if (input.images[static_cast<std::size_t>(corner.image)].camera == camera)
      corners.push_back({pixels.at({corner.image, corner.index}), corner.is_outlier});
  }
  return corners;
}

std::string ResidualsCsv(const std::vector<CalibratedGroup>& groups) {
  std::string text = "file,camera,corner,residual_x_px,residual_y_px,outlier\n";
  for (const CalibratedGroup& calibrated : groups) {
    const CalibrationInput& input = calibrated.group.input;
    for (const CornerResidual& corner : calibrated.calibration.corners) {
      const CalibrationImage& image = input.images[static_cast<std::size_t>(corner.image)];
      text += fmt::format("\"{}\",\"{}\",{},{:.4f},{:.4f},{:d}\n", FileName(image.name),
                          input.cameras[static_cast<std::size_t>(image.camera)].id, corner.index,
                          corner.residual_px.x(), corner.residual_px.y(), corner.is_outlier);
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
              [&] { return UncertaintySvg(camera, CornersOf(calibrated, static_cast<int>(c))); });
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

json GroupJson(const CalibratedGroup& calibrated) {
  const Calibration& c = calibrated.calibration;
  const CalibrationInput& input = calibrated.group.input;
  json out = {{"usable", c.IsUsable()},
              {"is_rig", calibrated.group.is_rig},
              {"lens", c.converged ? json(ArtifactName(c.lens)) : json(nullptr)},
              {"reprojection_rms_px", {{"per_axis", c.rms_px}, {"two_d", c.rms_2d_px}}},
              {"noise_px", c.noise_px},
              {"held_out_rms_px", NumberOrNull(c.held_out_px)},
              {"outlier_share", c.outlier_share},
              {"board_bend_m", VectorJson(c.board_bend_m)},
              {"board_bend_sigma_m", VectorJson(c.board_bend_sigma_m)},
              {"cameras", json::array()},
              {"images", json::array()},
              {"outliers", json::array()},
              {"lenses", json::array()}};
  for (const CalibratedCamera& camera : c.cameras) out["cameras"].push_back(CameraJson(camera));
  for (const ImageCalibration& image : c.images) {
    const CalibrationImage& given = input.images[static_cast<std::size_t>(image.image)];
    out["images"].push_back({{"file", FileName(given.name)},
                             {"camera", input.cameras[static_cast<std::size_t>(given.camera)].id},
                             {"set", given.set},
                             {"rms_px", image.rms_px},
                             {"corners", image.corners},
                             {"outliers", image.outliers},
                             {"distance_m", image.cam_from_target.translation().norm()}});
  }
  for (const CornerResidual& corner : c.corners) {
    if (!corner.is_outlier) continue;
    out["outliers"].push_back(
        {{"file", FileName(input.images[static_cast<std::size_t>(corner.image)].name)},
         {"corner", corner.index},
         {"residual_px", VectorJson(corner.residual_px)},
         {"reason", fmt::format("{:.2f} px off, {:.1f} times the noise", corner.residual_px.norm(),
                                corner.residual_px.norm() / std::max(c.noise_px, 1e-12))}});
  }
  for (const LensScore& lens : c.lenses)
    out["lenses"].push_back({{"lens", ArtifactName(lens.kind)},
                             {"is_fitted", lens.is_fitted},
                             {"rms_px", lens.rms_px},
                             {"held_out_px", NumberOrNull(lens.held_out_px)},
                             {"outliers", lens.outliers},
                             {"verdict", lens.verdict}});
  return out;
}

std::vector<std::string> WriteCalibrationFiles(const std::vector<CalibratedGroup>& groups,
                                               const std::string& folder) {
  FileWriter files(folder);
  for (const CalibratedGroup& calibrated : groups) WriteCameraFiles(calibrated, files);
  if (!groups.empty()) WriteSharedFiles(groups, files);
  return files.names();
}

}  // namespace luxfit
