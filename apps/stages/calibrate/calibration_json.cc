#include "apps/stages/calibrate/calibration_json.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/stages/calibrate/board_text.h"
#include "apps/text/file_stem.h"
#include "apps/text/formats/json_vectors.h"
#include "calib/calibrate/rig_pose.h"
#include "calib/lens/lens_family.h"

namespace luxfit {
namespace {

using nlohmann::json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMapColumns = 24;

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

json DistortionSigmas(const CalibratedCamera& camera) {
  const Eigen::MatrixXd& covariance = camera.uncertainty.covariance;
  const Eigen::Index count = camera.uncertainty.kind.coefficients;
  if (covariance.rows() < 4 + count) return nullptr;
  return VectorJson(covariance.diagonal().segment(4, count).cwiseSqrt().eval());
}

json RotationJson(const Eigen::Isometry3d& pose) { return MatrixJson(pose.linear()); }

// Returns the directions of the image's corners, from the top left clockwise.
json CornerDirections(const Camera& camera) {
  const double right = camera.width_px - 1, bottom = camera.height_px - 1;
  json directions = json::array();
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(0, 0), Eigen::Vector2d(right, 0),
                                        Eigen::Vector2d(right, bottom), Eigen::Vector2d(0, bottom)})
    directions.push_back(VectorJson(Unproject(camera, corner)));
  return directions;
}

// Returns the distance of the middle of the corners that an image shows.
double RangeM(const CalibrationInput& input, const ImageCalibration& image) {
  const std::vector<BoardCorner>& corners = input.images[static_cast<std::size_t>(image.image)].corners;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const BoardCorner& corner : corners)
    sum += input.target.points[static_cast<std::size_t>(corner.index)];
  return (image.cam_from_target * Eigen::Vector3d(sum / static_cast<double>(corners.size()))).norm();
}

// Returns the median distance of the target in the camera's images; 0 without images.
double UsualRangeM(const CalibratedGroup& calibrated, int camera) {
  const CalibrationInput& input = calibrated.group.input;
  std::vector<double> ranges_m;
  for (const ImageCalibration& image : calibrated.calibration.images) {
    if (input.images[static_cast<std::size_t>(image.image)].camera == camera)
      ranges_m.push_back(RangeM(input, image));
  }
  if (ranges_m.empty()) return 0;
  const auto middle = ranges_m.begin() + static_cast<std::ptrdiff_t>(ranges_m.size() / 2);
  std::nth_element(ranges_m.begin(), middle, ranges_m.end());
  return *middle;
}

// Returns the sigma of projections over the image, at the given range. Three digits are more than a sigma
// has.
json SigmaMapJson(const CalibratedCamera& camera, double range_m) {
  const Camera& c = camera.camera;
  const int rows = std::max(1, static_cast<int>(std::lround(1.0 * kMapColumns * c.height_px / c.width_px)));
  const Eigen::MatrixXd sigma_px =
      WithinCircle(camera.circle, c.width_px, c.height_px,
                   ProjectionSigmaMap(c, camera.uncertainty, kMapColumns, rows, range_m))
          .unaryExpr([](double sigma) {
            return std::isfinite(sigma) ? std::stod(fmt::format("{:.3g}", sigma)) : sigma;
          });
  return {{"range_m", NumberOrNull(range_m)}, {"sigma_px", MatrixJson(sigma_px)}};
}

// Returns null where all of the picture is seen.
json CircleJson(const ImageCircle& circle) {
  if (circle.IsWholePicture()) return nullptr;
  return {{"centre_px", VectorJson(circle.centre_px)}, {"radius_px", circle.radius_px}};
}

json UncertaintyJson(const CalibratedCamera& camera, double usual_range_m) {
  const Camera& c = camera.camera;
  const Eigen::Vector2d middle((c.width_px - 1) / 2.0, (c.height_px - 1) / 2.0);
  json maps = json::array({SigmaMapJson(camera, kInfinity)});
  if (usual_range_m > 0) maps.push_back(SigmaMapJson(camera, usual_range_m));
  return {{"middle_px", NumberOrNull(ProjectionSigmaPx(c, camera.uncertainty, middle, kInfinity))},
          {"median_px", NumberOrNull(camera.median_sigma_px)},
          {"share_above_limit", camera.uncertain_share},
          {"maps", maps}};
}

json CameraJson(const CalibratedCamera& camera, double usual_range_m) {
  const Camera& c = camera.camera;
  json out = {{"id", camera.id},
              {"width_px", c.width_px},
              {"height_px", c.height_px},
              {"fx_px", c.fx_px},
              {"fy_px", c.fy_px},
              {"cx_px", c.cx_px},
              {"cy_px", c.cy_px},
              {"lens", ArtifactName(camera.uncertainty.kind)},
              {"fx_fy_cx_cy_sigma_px", CoreSigmas(camera)}};
  if (!OpsOf(c.lens).has_control_points) {
    out["distortion"] = std::vector<double>(c.distortion.begin(),
                                            c.distortion.begin() + camera.uncertainty.kind.coefficients);
    out["distortion_sigma"] = DistortionSigmas(camera);
  }
  out["corner_directions"] = CornerDirections(c);
  out["position_in_rig_m"] = VectorJson(camera.cam_from_rig.inverse().translation().eval());
  out["R_camera_from_rig"] = RotationJson(camera.cam_from_rig);
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
  out["image_circle"] = CircleJson(camera.circle);
  out["uncertainty"] = UncertaintyJson(camera, usual_range_m);
  out["coverage"] = CoverageJson(camera.coverage);
  return out;
}

json ImagesJson(const CalibratedGroup& calibrated) {
  const CalibrationInput& input = calibrated.group.input;
  json images = json::array();
  for (const ImageCalibration& image : calibrated.calibration.images) {
    const CalibrationImage& given = input.images[static_cast<std::size_t>(image.image)];
    images.push_back({{"file", FileName(given.name)},
                      {"camera", input.cameras[static_cast<std::size_t>(given.camera)].id},
                      {"set", given.set},
                      {"rms_px", image.rms_px},
                      {"corners", image.corners},
                      {"outliers", image.outliers},
                      {"distance_m", image.cam_from_target.translation().norm()},
                      {"R_camera_from_target", RotationJson(image.cam_from_target)},
                      {"t_camera_from_target_m", VectorJson(image.cam_from_target.translation())}});
  }
  return images;
}

// Returns why an image that is not in use was left out.
std::string WhyLeftOut(const CalibratedGroup& calibrated, int image) {
  const std::size_t corners = calibrated.group.input.images[static_cast<std::size_t>(image)].corners.size();
  const auto message = calibrated.group.messages.find(image);
  if (message != calibrated.group.messages.end()) return message->second;
  if (corners == 0) return "no corner was found";
  return calibrated.calibration.converged ? fmt::format("its {} corners give no pose of the target", corners)
                                          : "the calibration did not converge";
}

json LeftOutJson(const CalibratedGroup& calibrated) {
  const CalibrationInput& input = calibrated.group.input;
  std::set<int> in_use;
  for (const ImageCalibration& image : calibrated.calibration.images) in_use.insert(image.image);
  json left_out = json::array();
  for (std::size_t i = 0; i < input.images.size(); ++i) {
    const auto image = static_cast<int>(i);
    if (in_use.count(image) > 0) continue;
    left_out.push_back({{"file", FileName(input.images[i].name)},
                        {"camera", input.cameras[static_cast<std::size_t>(input.images[i].camera)].id},
                        {"reason", WhyLeftOut(calibrated, image)}});
  }
  return left_out;
}

json OutliersJson(const CalibratedGroup& calibrated) {
  const Calibration& c = calibrated.calibration;
  json outliers = json::array();
  for (const CornerResidual& corner : c.corners) {
    if (!corner.is_outlier) continue;
    outliers.push_back(
        {{"file", FileName(calibrated.group.input.images[static_cast<std::size_t>(corner.image)].name)},
         {"corner", corner.index},
         {"residual_px", VectorJson(corner.residual_px)},
         {"reason", fmt::format("{:.2f} px off, {:.1f} times the noise", corner.residual_px.norm(),
                                corner.residual_px.norm() / std::max(c.noise_px, 1e-12))}});
  }
  return outliers;
}

json LensesJson(const Calibration& calibration) {
  json lenses = json::array();
  for (const LensScore& lens : calibration.lenses)
    lenses.push_back({{"lens", ArtifactName(lens.kind)},
                      {"is_fitted", lens.is_fitted},
                      {"rms_px", lens.rms_px},
                      {"held_out_px", NumberOrNull(lens.held_out_px)},
                      {"outliers", lens.outliers},
                      {"verdict", lens.verdict}});
  return lenses;
}

// Returns two opposite corners of the box that holds the target's points.
json ExtentJson(const CalibrationTarget& target) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : target.points) box.extend(point);
  return json::array({VectorJson(box.min()), VectorJson(box.max())});
}

}  // namespace

json GroupJson(const CalibratedGroup& calibrated) {
  const Calibration& c = calibrated.calibration;
  const CalibrationGroup& group = calibrated.group;
  json cameras = json::array();
  for (std::size_t i = 0; i < c.cameras.size(); ++i)
    cameras.push_back(CameraJson(c.cameras[i], UsualRangeM(calibrated, static_cast<int>(i))));
  return {{"usable", c.IsUsable()},
          {"is_rig", group.is_rig},
          {"board", group.board ? json(BoardArgument(*group.board)) : json()},
          {"target_extent_m", ExtentJson(group.input.target)},
          {"lens", c.converged ? json(ArtifactName(c.lens)) : json()},
          {"reprojection_rms_px", {{"per_axis", c.rms_px}, {"two_d", c.rms_2d_px}}},
          {"noise_px", c.noise_px},
          {"held_out_rms_px", NumberOrNull(c.held_out_px)},
          {"outlier_share", c.outlier_share},
          {"board_bend_m", VectorJson(c.board_bend_m)},
          {"board_bend_sigma_m", VectorJson(c.board_bend_sigma_m)},
          {"cameras", cameras},
          {"images", ImagesJson(calibrated)},
          {"images_left_out", LeftOutJson(calibrated)},
          {"outliers", OutliersJson(calibrated)},
          {"lenses", LensesJson(c)}};
}

}  // namespace luxfit
