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

json PhotoJson(const SessionPhoto& photo) {
  json bracket = json::array();
  for (const SessionExposure& e : photo.bracket) bracket.push_back({e.file, e.relative_exposure_s, e.line});
  return {{"file", photo.file},
          {"camera", photo.camera},
          {"view", photo.view},
          {"state", photo.state},
          {"exposure_s", photo.exposure_s},
          {"f_number", photo.f_number ? json(*photo.f_number) : json()},
          {"iso", photo.iso ? json(*photo.iso) : json()},
          {"line", photo.line},
          {"bracket", bracket}};
}

SessionPhoto PhotoFromJson(const json& in) {
  SessionPhoto photo;
  photo.file = in.at("file");
  photo.camera = in.at("camera");
  photo.view = in.at("view");
  photo.state = in.at("state");
  photo.exposure_s = in.at("exposure_s");
  if (in.at("f_number").is_number()) photo.f_number = in["f_number"].get<double>();
  if (in.at("iso").is_number()) photo.iso = in["iso"].get<double>();
  photo.line = in.at("line");
  for (const json& e : in.at("bracket")) photo.bracket.push_back({e.at(0), e.at(1), e.at(2)});
  return photo;
}

}  // namespace

json LinearizedJson(const Session& linearized) {
  json out = {{"photos", json::array()}, {"cameras", json::array()}};
  for (const SessionPhoto& photo : linearized.photos) out["photos"].push_back(PhotoJson(photo));
  for (const SessionCamera& camera : linearized.cameras) {
    json entry = {{"full_scale_counts", camera.full_scale_counts}};
    if (camera.response_curve) entry["response"] = ResponseJson(*camera.response_curve);
    if (camera.vignetting_model)
      entry["vignetting"] = {{"center_px", VectorJson(camera.vignetting_model->center_px)},
                             {"radius_px", camera.vignetting_model->radius_px},
                             {"coefficients", VectorJson(camera.vignetting_model->coefficients)}};
    out["cameras"].push_back(entry);
  }
  return out;
}

Session WithLinearized(Session session, const json& in) {
  session.photos.clear();
  for (const json& photo : in.at("photos")) session.photos.push_back(PhotoFromJson(photo));
  for (size_t c = 0; c < session.cameras.size(); ++c) {
    const json& entry = in.at("cameras").at(c);
    SessionCamera& camera = session.cameras[c];
    camera.full_scale_counts = entry.at("full_scale_counts");
    if (entry.contains("response")) camera.response_curve = ResponseFromJson(entry["response"]);
    if (entry.contains("vignetting")) {
      const json& v = entry["vignetting"];
      camera.vignetting_model = Vignetting{VectorFromJson(v.at("center_px")), v.at("radius_px"),
                                           VectorFromJson(v.at("coefficients"))};
    }
  }
  return session;
}

}  // namespace luxfit
