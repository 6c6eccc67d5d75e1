#include "apps/stages/linearize/linearized_json.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "apps/text/formats/json_vectors.h"

namespace luxfit {
namespace {

using nlohmann::json;

json ResponseJson(const CameraResponse& response) {
  json channels = json::array();
  for (size_t c = 0; c < 3; ++c) {
    json channel = {{"exposure", VectorJson(response.exposure(c))}};
    if (response.has_relative_sigma()) {
      Eigen::VectorXd sigma(response.counts().size());
      for (Eigen::Index i = 0; i < sigma.size(); ++i)
        sigma[i] = response.RelativeSigma(c, response.counts()[i]);
      channel["relative_sigma"] = VectorJson(sigma);
    }
    channels.push_back(channel);
  }
  return {{"counts", VectorJson(response.counts())}, {"channels", channels}};
}

CameraResponse ResponseFromJson(const json& in) {
  std::array<Eigen::VectorXd, 3> exposure, sigma;
  for (size_t c = 0; c < 3; ++c) exposure[c] = VectorFromJson(in.at("channels").at(c).at("exposure"));
  CameraResponse response(VectorFromJson(in.at("counts")), exposure);
  if (!in.at("channels").at(0).contains("relative_sigma")) return response;
  for (size_t c = 0; c < 3; ++c) sigma[c] = VectorFromJson(in.at("channels").at(c).at("relative_sigma"));
  return response.WithRelativeSigma(sigma);
}

json PhotoJson(const LinearizedPhoto& photo) {
  json bracket = json::array();
  for (const PhotoExposure& e : photo.bracket)
    bracket.push_back(
        {e.file, e.relative_exposure_s, e.line, e.cut_off_counts ? json(*e.cut_off_counts) : json()});
  return {{"file", photo.file},   {"camera", photo.camera},         {"view", photo.view},
          {"state", photo.state}, {"exposure_s", photo.exposure_s}, {"bracket", bracket}};
}

LinearizedPhoto PhotoFromJson(const json& in) {
  LinearizedPhoto photo;
  photo.file = in.at("file");
  photo.camera = in.at("camera");
  photo.view = in.at("view");
  photo.state = in.at("state");
  photo.exposure_s = in.at("exposure_s");
  for (const json& e : in.at("bracket")) {
    photo.bracket.push_back({e.at(0), e.at(1), e.at(2), {}});
    if (!e.at(3).is_null()) photo.bracket.back().cut_off_counts = e.at(3);
  }
  return photo;
}

}  // namespace

json LinearizedJson(const LinearizedPhotos& linearized) {
  json out = {{"photos", json::array()}, {"cameras", json::array()}};
  for (const LinearizedPhoto& photo : linearized.photos) out["photos"].push_back(PhotoJson(photo));
  for (const LinearizedCamera& camera : linearized.cameras) {
    json entry = {{"full_scale_counts", camera.full_scale_counts}};
    if (camera.response) entry["response"] = ResponseJson(*camera.response);
    if (camera.vignetting)
      entry["vignetting"] = {{"center_px", VectorJson(camera.vignetting->center_px)},
                             {"radius_px", camera.vignetting->radius_px},
                             {"coefficients", VectorJson(camera.vignetting->coefficients)}};
    out["cameras"].push_back(entry);
  }
  return out;
}

LinearizedPhotos LinearizedFromJson(const Session& session, const json& in) {
  LinearizedPhotos linearized;
  linearized.cameras.reserve(session.cameras.size());
  for (const json& photo : in.at("photos")) linearized.photos.push_back(PhotoFromJson(photo));
  for (size_t c = 0; c < session.cameras.size(); ++c) {
    const json& entry = in.at("cameras").at(c);
    LinearizedCamera camera;
    camera.given = session.cameras[c];
    camera.full_scale_counts = entry.at("full_scale_counts");
    if (entry.contains("response")) camera.response = ResponseFromJson(entry["response"]);
    if (entry.contains("vignetting")) {
      const json& v = entry["vignetting"];
      camera.vignetting = Vignetting{VectorFromJson(v.at("center_px")), v.at("radius_px"),
                                     VectorFromJson(v.at("coefficients"))};
    }
    linearized.cameras.push_back(std::move(camera));
  }
  return linearized;
}

}  // namespace luxfit
