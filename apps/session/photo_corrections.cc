#include "apps/session/photo_corrections.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/text/formats/artifact.h"
#include "apps/text/input_error.h"

namespace luxfit {

PhotoCorrections ReadPhotoCorrections(const std::string& out) {
  const std::string path = out + "/stages/observe.json";
  try {
    const nlohmann::json artifact = ReadJson(path);
    PhotoCorrections corrections;
    for (const nlohmann::json& camera : artifact.value("camera_gains", nlohmann::json::array()))
      corrections.of_camera[camera.at("camera")].log_gain = std::log(camera.at("gain").get<double>());
    if (!artifact.contains("self_calibration")) return corrections;
    const nlohmann::json& found = artifact["self_calibration"];
    for (const nlohmann::json& gain : found.at("exposure_gains"))
      corrections.log_gain[gain.at("file")] = std::log(gain.at("factor").get<double>());
    for (const nlohmann::json& camera : found.at("cameras")) {
      PhotoCorrection& correction = corrections.of_camera[camera.at("camera")];
      correction.vignetting = camera.at("vignetting_coefficients").get<std::vector<double>>();
      correction.exponent = 1 / camera.at("response_exponent").get<double>() - 1;
    }
    return corrections;
  } catch (const nlohmann::json::exception& e) {
    throw InputError(
        {path, 0}, "",
        std::string("expected what a run of this version observed; run `luxfit run` again; ") + e.what());
  }
}

PhotoCorrection PhotoCorrections::Of(const std::string& camera, const std::string& file) const {
  PhotoCorrection correction;
  const auto known = of_camera.find(camera);
  if (known != of_camera.end()) correction = known->second;
  const auto gain = log_gain.find(file);
  if (gain != log_gain.end()) correction.log_gain += gain->second;
  return correction;
}

}  // namespace luxfit
