#include "apps/session/photo_corrections.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/text/artifact.h"
#include "apps/text/input_error.h"
#include "calib/luminance/vignetting.h"

namespace luxfit {

PhotoCorrections ReadPhotoCorrections(const std::string& out) {
  const std::string path = out + "/stages/observe.json";
  try {
    const nlohmann::json artifact = ReadJson(path);
    PhotoCorrections corrections;
    if (!artifact.contains("self_calibration")) return corrections;
    const nlohmann::json& found = artifact["self_calibration"];
    for (const nlohmann::json& gain : found.at("exposure_gains"))
      corrections.log_gain[gain.at("file")] = std::log(gain.at("factor").get<double>());
    for (const nlohmann::json& camera : found.at("cameras")) {
      corrections.of_camera[camera.at("camera")] = {
          camera.at("vignetting_coefficients").get<std::vector<double>>(),
          1 / camera.at("response_exponent").get<double>() - 1};
    }
    return corrections;
  } catch (const nlohmann::json::exception& e) {
    throw InputError(
        {path, 0}, "",
        std::string("expected what a run of this version observed; run `luxfit run` again; ") + e.what());
  }
}

LuminanceImage Corrected(LuminanceImage image, const PhotoCorrections& corrections, const Session& session,
                         const SessionPhoto& photo) {
  PhotoCorrections::OfCamera camera;
  const auto known = corrections.of_camera.find(session.cameras[static_cast<size_t>(photo.camera)].id);
  if (known != corrections.of_camera.end()) camera = known->second;
  const auto gain = corrections.log_gain.find(photo.file);
  const double log_gain = gain == corrections.log_gain.end() ? 0 : gain->second;
  if (log_gain == 0 && camera.exponent == 0 && camera.vignetting.empty()) return image;
  ImagePlane& plane = image.relative_luminance;
  const Vignetting frame = NoVignetting(static_cast<int>(plane.cols()), static_cast<int>(plane.rows()));
  for (Eigen::Index v = 0; v < plane.rows(); ++v) {
    for (Eigen::Index u = 0; u < plane.cols(); ++u) {
      const double y = plane(v, u);
      if (!(y > 0)) continue;
      const Eigen::Vector2d pixel(static_cast<double>(u), static_cast<double>(v));
      const double r2 = (pixel - frame.center_px).squaredNorm() / (frame.radius_px * frame.radius_px);
      double log_factor =
                 camera.exponent * std::log(y * photo.bracket.front().relative_exposure_s) - log_gain,
             power = 1;
      for (const double a : camera.vignetting) log_factor -= a * (power *= r2);
      const float factor = static_cast<float>(std::exp(log_factor));
      plane(v, u) *= factor;
      for (ImagePlane& channel : image.relative_rgb) channel(v, u) *= factor;
      if (image.variance.size() > 0) image.variance(v, u) *= factor * factor;
    }
  }
  return image;
}

}  // namespace luxfit
