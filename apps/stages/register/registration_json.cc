#include "apps/stages/register/registration_json.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "apps/text/formats/json_vectors.h"
#include "calib/lens/lens_family.h"

namespace luxfit {
namespace {

using nlohmann::json;

json CameraJson(const std::string& id, const Camera& camera) {
  const LensSpline& spline = camera.spline;
  return {{"id", id},
          {"width_px", camera.width_px},
          {"height_px", camera.height_px},
          {"fx_px", camera.fx_px},
          {"fy_px", camera.fy_px},
          {"cx_px", camera.cx_px},
          {"cy_px", camera.cy_px},
          {"lens", OpsOf(camera.lens).key},
          {"distortion", camera.distortion},
          {"spline",
           {{"order", spline.order},
            {"nx", spline.nx},
            {"ny", spline.ny},
            {"fov_x_deg", spline.fov_x_deg},
            {"control_points", spline.control_points}}}};
}

Camera CameraFromJson(const json& entry) {
  Camera camera;
  camera.width_px = entry.at("width_px");
  camera.height_px = entry.at("height_px");
  camera.fx_px = entry.at("fx_px");
  camera.fy_px = entry.at("fy_px");
  camera.cx_px = entry.at("cx_px");
  camera.cy_px = entry.at("cy_px");
  camera.distortion = entry.at("distortion").get<std::array<double, 12>>();
  for (const LensOps& ops : Lenses()) {
    if (entry.at("lens") == ops.key) camera.lens = ops.lens;
  }
  const json& spline = entry.at("spline");
  camera.spline = {spline.at("order"), spline.at("nx"), spline.at("ny"), spline.at("fov_x_deg"),
                   spline.at("control_points").get<std::vector<double>>()};
  return camera;
}

json ViewJson(const RegisteredView& view) {
  const Eigen::Matrix<double, 3, 4, Eigen::RowMajor> pose = view.cam_from_world.matrix().topRows<3>();
  return {{"view", view.view},
          {"camera", view.camera},
          {"cam_from_world", VectorJson(pose.reshaped<Eigen::RowMajor>())},
          {"position_sigma_m", VectorJson(view.position_sigma_m)},
          {"covariance", MatrixJson(view.covariance)},
          {"reprojection_rms_px", view.reprojection_rms_px},
          {"method", MethodOf(view)},
          {"tags_used", view.tags_used},
          {"points_used", view.points_used},
          {"corners_rejected", view.corners_rejected}};
}

RegisteredView ViewFromJson(const json& entry) {
  RegisteredView view;
  view.view = entry.at("view");
  view.camera = entry.at("camera");
  view.cam_from_world.matrix().topRows<3>() =
      VectorFromJson(entry.at("cam_from_world")).reshaped<Eigen::RowMajor>(3, 4);
  view.position_sigma_m = VectorOrUnknown(entry.at("position_sigma_m"), 3);
  view.covariance.setConstant(std::numeric_limits<double>::quiet_NaN());
  if (const json& covariance = entry.at("covariance"); !covariance.is_null())
    view.covariance = MatrixFromJson(covariance);
  view.reprojection_rms_px = entry.at("reprojection_rms_px");
  view.tags_used = entry.at("tags_used");
  view.points_used = entry.at("points_used");
  view.corners_rejected = entry.at("corners_rejected");
  return view;
}

// Writes the lower triangle of a symmetric matrix, row by row.
json TriangleJson(const Eigen::MatrixXd& matrix) {
  json list = json::array();
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index column = 0; column <= row; ++column) list.push_back(NumberOrNull(matrix(row, column)));
  }
  return list;
}

// Reads a symmetric matrix of `rows` rows; nlohmann::json::out_of_range where there are too few numbers.
Eigen::MatrixXd MatrixFromTriangle(const json& list, Eigen::Index rows) {
  Eigen::MatrixXd matrix(rows, rows);
  size_t next = 0;
  for (Eigen::Index row = 0; row < rows; ++row) {
    for (Eigen::Index column = 0; column <= row; ++column) {
      const json& value = list.at(next++);
      matrix(row, column) = matrix(column, row) =
          value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
    }
  }
  return matrix;
}

json TagJson(const SurveyedTag& tag) {
  return {{"id", tag.id},
          {"size_m", tag.size_m},
          {"center_m", VectorJson(tag.center_in_world)},
          {"normal", VectorJson(tag.normal_in_world)},
          {"up", VectorJson(tag.up_in_world)}};
}

SurveyedTag TagFromJson(const json& entry) {
  SurveyedTag tag;
  tag.id = entry.at("id");
  tag.size_m = entry.at("size_m");
  tag.center_in_world = VectorFromJson(entry.at("center_m"));
  tag.normal_in_world = VectorFromJson(entry.at("normal"));
  tag.up_in_world = VectorFromJson(entry.at("up"));
  return tag;
}

json NoteJson(const RegistrationNote& note) {
  return {{"view", note.view},
          {"tag", note.tag_id},
          {"code", note.code},
          {"message", note.message},
          {"remedy", note.remedy}};
}

}  // namespace

json MisplacedJson(const std::vector<MisplacedPhoto>& photos) {
  json list = json::array();
  for (const MisplacedPhoto& photo : photos)
    list.push_back({{"view", photo.view},
                    {"state", photo.state},
                    {"as_if_view", photo.as_if_view},
                    {"tags", photo.tags}});
  return list;
}

json RegistrationJson(const Session& session, const RegisteredSession& registered) {
  const Registration& r = registered.registration;
  json out = {{"converged", r.converged},
              {"message", r.message},
              {"reprojection_rms_px", r.reprojection_rms_px},
              {"frame", r.frame},
              {"survey_sigma_m", r.survey_sigma_m},
              {"tag_size_error", r.tag_size_error},
              {"tag_size_error_sigma", r.tag_size_error_sigma},
              {"focal_scale", r.focal_scale},
              {"focal_scale_sigma", r.focal_scale_sigma},
              {"points", r.points},
              {"point_sigma_px", r.point_sigma_px},
              {"cameras", json::array()},
              {"views", json::array()},
              {"pose_covariance", TriangleJson(r.pose_covariance)},
              {"placed_tags", json::array()},
              {"misplaced_photos", MisplacedJson(registered.misplaced)},
              {"notes", json::array()}};
  for (size_t c = 0; c < registered.cameras.size(); ++c)
    out["cameras"].push_back(CameraJson(session.cameras[c].id, registered.cameras[c]));
  for (const RegisteredView& view : r.views) out["views"].push_back(ViewJson(view));
  for (const SurveyedTag& tag : r.placed_tags) out["placed_tags"].push_back(TagJson(tag));
  for (const RegistrationNote& note : r.notes) out["notes"].push_back(NoteJson(note));
  return out;
}

RegisteredSession RegistrationFromJson(const json& in) {
  RegisteredSession registered;
  Registration& r = registered.registration;
  r.converged = in.at("converged");
  r.message = in.at("message");
  r.reprojection_rms_px = in.at("reprojection_rms_px");
  r.frame = in.at("frame");
  r.survey_sigma_m = in.at("survey_sigma_m");
  r.tag_size_error = in.at("tag_size_error");
  r.tag_size_error_sigma = in.at("tag_size_error_sigma");
  r.focal_scale = in.at("focal_scale").get<std::vector<double>>();
  r.focal_scale_sigma = in.at("focal_scale_sigma").get<std::vector<double>>();
  r.points = in.at("points");
  r.point_sigma_px = in.at("point_sigma_px");
  for (const json& camera : in.at("cameras")) registered.cameras.push_back(CameraFromJson(camera));
  for (const json& view : in.at("views")) r.views.push_back(ViewFromJson(view));
  r.pose_covariance =
      MatrixFromTriangle(in.at("pose_covariance"), static_cast<Eigen::Index>(6 * r.views.size()));
  for (const json& tag : in.at("placed_tags")) r.placed_tags.push_back(TagFromJson(tag));
  for (const json& photo : in.at("misplaced_photos"))
    registered.misplaced.push_back(
        {photo.at("view"), photo.at("state"), photo.at("as_if_view"), photo.at("tags")});
  for (const json& note : in.at("notes"))
    r.notes.push_back(
        {note.at("view"), note.at("tag"), note.at("code"), note.at("message"), note.at("remedy")});
  return registered;
}

}  // namespace luxfit
