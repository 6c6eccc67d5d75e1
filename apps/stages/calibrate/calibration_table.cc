#include "apps/stages/calibrate/calibration_table.h"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "apps/stages/calibrate/image_grouping.h"
#include "apps/stages/stages.h"
#include "apps/text/with_sigma.h"
#include "calib/lens/lens_family.h"

namespace luxfit {
namespace {

using nlohmann::json;

double NumberOf(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

std::string CameraLine(const json& camera) {
  const json& sigma = camera["fx_fy_cx_cy_sigma_px"];
  return fmt::format(
      "  {:<8} f {:.2f} {:.2f} px{}, c {:.2f} {:.2f}; direction uncertain by {:.2g} px in the middle\n",
      camera["id"].get<std::string>(), camera["fx_px"].get<double>(), camera["fy_px"].get<double>(),
      sigma.is_null() || sigma[0].is_null() ? "" : fmt::format(" (± {:.2f})", sigma[0].get<double>()),
      camera["cx_px"].get<double>(), camera["cy_px"].get<double>(),
      NumberOf(camera["uncertainty"]["middle_px"]));
}

std::string RigLine(const json& camera, const json& first) {
  return fmt::format("  {} to {}: baseline {} m, rotation {} degrees\n", first["id"].get<std::string>(),
                     camera["id"].get<std::string>(),
                     WithSigma(camera["baseline_m"], NumberOf(camera["baseline_sigma_m"])),
                     WithSigma(camera["rotation_deg"], NumberOf(camera["rotation_sigma_deg"])));
}

std::string GroupText(const json& group) {
  if (group["lens"].is_null()) return "";
  const json& held_out = group["held_out_rms_px"];
  std::string text = fmt::format(
      "{} images, {}: RMS per axis {:.3f} px, held out {} px, {:.1f} % outliers{}\n", group["images"].size(),
      ToString(*LensKindOf(group["lens"].get<std::string>())),
      group["reprojection_rms_px"]["per_axis"].get<double>(),
      held_out.is_null() ? "-" : fmt::format("{:.3f}", held_out.get<double>()),
      100 * group["outlier_share"].get<double>(), group["usable"].get<bool>() ? "" : "; NOT USABLE as it is");
  const json& cameras = group["cameras"];
  for (const json& camera : cameras) text += CameraLine(camera);
  for (std::size_t c = 1; c < cameras.size(); ++c) text += RigLine(cameras[c], cameras[0]);
  return text;
}

}  // namespace

std::string CalibrationTable(const json& artifact) {
  std::string text = StatusLine(artifact);
  for (const json& choice : artifact["choices"]) {
    const std::string what = choice["what"];
    if (IsGroupingChoice(what))
      text += fmt::format("{}: {}, {}\n", what, choice["chosen"].get<std::string>(),
                          choice["because"].get<std::string>());
  }
  for (const json& group : artifact["groups"]) text += GroupText(group);
  return text + WarningText(artifact);
}

}  // namespace luxfit
