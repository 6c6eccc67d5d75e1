#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/stages/stages.h"
#include "apps/text/formats/json_vectors.h"

namespace luxfit {
namespace {

using nlohmann::json;

std::string Number(const json& value, const char* format) {
  return value.is_number() ? fmt::format(fmt::runtime(format), value.get<double>()) : "-";
}

std::string PlusMinus(const json& value, const json& sigma, const char* format) {
  return Number(value, format) + " ± " + Number(sigma, format);
}

std::string Interval(const json& reading) {
  if (!reading.contains("interval95_lx")) return "-";
  const json& interval = reading["interval95_lx"];
  return Number(interval[0], "{:.2f}") + " to " + Number(interval[1], "{:.2f}");
}

std::string SizeText(const json& size) {
  std::string text;
  for (const json& side : size) text += (text.empty() ? "" : " x ") + Number(side, "{:.2f}");
  return text.empty() ? "" : text + " m";
}

std::string LuminaireTable(const json& result) {
  std::string text =
      "\nluminaire  position m (x, y, z), 1 sigma mm             flux lm           distribution\n";
  for (const json& l : result["luminaires"]) {
    const json& p = l["position_m"];
    std::string sigma_mm;
    for (const json& s : l["position_sigma_m"])
      sigma_mm += " " + (s.is_number() ? fmt::format("{:.1f}", 1e3 * s.get<double>()) : std::string("-"));
    std::string lobe = l["photometry"].get<std::string>();
    if (l.contains("cosine_exponent")) lobe += " " + Number(l["cosine_exponent"], "{:.2f}");
    text +=
        fmt::format("{:<10} {:6.3f} {:6.3f} {:6.3f}  ±{}{:<12} {:<17} {} {} {}\n", l["id"].get<std::string>(),
                    p[0].get<double>(), p[1].get<double>(), p[2].get<double>(), sigma_mm, "",
                    PlusMinus(l["flux_lm"], l["flux_sigma_lm"], "{:.0f}"), lobe,
                    l["shape"].get<std::string>(), SizeText(l["size_m"]));
  }
  return text;
}

std::string MaterialTable(const json& result) {
  std::string text = "\nmaterial         albedo            source\n";
  for (const json& m : result["materials"]) {
    const bool is_known = !m["albedo"].is_null();
    text += fmt::format("{:<16} {:<18} {}{}\n", m["name"].get<std::string>(),
                        is_known ? PlusMinus(m["albedo"], m["sigma"], "{:.4f}") : "-",
                        m["source"].get<std::string>(),
                        is_known && m.value("by_indirect_light", false) ? ", by indirect light" : "");
  }
  return text;
}

std::string FacingText(const json& normal) {
  if (normal.is_null()) return "several ways";
  const std::array<const char*, 3> axes = {"x", "y", "z"};
  size_t main = 0;
  for (size_t k = 1; k < 3; ++k) {
    if (std::abs(normal[k].get<double>()) > std::abs(normal[main].get<double>())) main = k;
  }
  return std::string(normal[main].get<double>() < 0 ? "-" : "+") + axes.at(main);
}

std::string SurfaceTable(const json& surfaces) {
  std::string text =
      "\nsurface          albedo             area m2   centre m               height m       faces\n";
  for (const json& s : surfaces) {
    const json &c = s["center_m"], &height = s["height_m"];
    text +=
        fmt::format("{:<16} {:<18} {:7.2f}   {:6.2f} {:6.2f} {:6.2f}   {:5.2f} .. {:4.2f}  {}\n",
                    s["name"].get<std::string>(), PlusMinus(s["albedo"], s["sigma"], "{:.4f}"),
                    s["area_m2"].get<double>(), c[0].get<double>(), c[1].get<double>(), c[2].get<double>(),
                    height[0].get<double>(), height[1].get<double>(), FacingText(s["normal"]));
  }
  return text;
}

// Says where the luminance pictures of `luxfit linearize --hdr` lie and what their values are.
std::string PicturesLine(const json& pictures) {
  const auto count = [&pictures](const char* key) {
    return std::count_if(pictures.begin(), pictures.end(),
                         [key](const json& picture) { return picture[key].get<bool>(); });
  };
  const auto absolute = static_cast<size_t>(count("is_absolute"));
  std::string unit = "in cd/m2";
  if (absolute < pictures.size()) {
    unit = absolute == 0 ? "RELATIVE" : fmt::format("{} of them RELATIVE", pictures.size() - absolute);
    unit += ": cdm2_per_count_s of the camera is not known";
  }
  return fmt::format("{} luminance pictures in luminance/, {} with a pose, {}\n", pictures.size(),
                     count("has_pose"), unit);
}

}  // namespace

std::string LuxmeterTable(const json& result) {
  std::string text =
      "\nreading      state        measured lx   predicted lx       95 % interval       error %     z  "
      "role\n";
  for (const json& r : result["luxmeter"]) {
    const bool both = r["measured_lx"].is_number() && r["predicted_lx"].is_number();
    const double measured = both ? r["measured_lx"].get<double>() : 0;
    const std::string error =
        measured > 0 ? fmt::format("{:+.2f}", 100 * (r["predicted_lx"].get<double>() / measured - 1)) : "-";
    text += fmt::format("{:<12} {:<10} {:>12}   {:<18} {:<19} {:>7} {:>5}  {}\n", r["id"].get<std::string>(),
                        r["state"].get<std::string>(), Number(r["measured_lx"], "{:.2f}"),
                        PlusMinus(r["predicted_lx"], r["sigma_lx"], "{:.2f}"), Interval(r), error,
                        r.contains("z") ? Number(r["z"], "{:.1f}") : "-", r["role"].get<std::string>());
  }
  const json& s = result["summary"];
  const int checked = s["readings_checked"].get<int>();
  // Earlier results hold errors of 0 where no reading was checked.
  const auto error = [&](const char* key) { return checked > 0 ? Number(s[key], "{:.2f}") : "-"; };
  text += fmt::format("checked {} readings: mean error {} lx = {} % of the mean reading, largest {} %\n",
                      checked, error("mean_abs_error_lx"), error("mean_abs_error_percent"),
                      error("max_abs_error_percent"));
  return text;
}

std::string SimulationTable(const json& artifact) {
  std::string text = fmt::format("session {}: simulated\n", artifact["session"].get<std::string>());
  text += "\nreading      state               lx      direct    indirect  measured lx  error %\n";
  for (const json& r : artifact["luxmeter"]) {
    const bool is_known = r["predicted_lx"].is_number();
    const double measured = r["measured_lx"].is_number() ? r["measured_lx"].get<double>() : 0;
    text += fmt::format("{:<12} {:<10} {:>11} {:>11} {:>11} {:>12} {:>8}\n", r["id"].get<std::string>(),
                        r["state"].get<std::string>(), Number(r["predicted_lx"], "{:.2f}"),
                        Number(r["direct_lx"], "{:.2f}"), Number(r["indirect_lx"], "{:.2f}"),
                        Number(r["measured_lx"], "{:.2f}"),
                        is_known && measured > 0
                            ? fmt::format("{:+.2f}", 100 * (r["predicted_lx"].get<double>() / measured - 1))
                            : "-");
  }
  const json& s = artifact["summary"];
  if (s["readings_checked"].get<int>() > 0) {
    text += fmt::format(
        "compared with {} readings: mean error {:.2f} lx = {:.2f} % of the mean reading, largest "
        "{:.2f} %\n",
        s["readings_checked"].get<int>(), s["mean_abs_error_lx"].get<double>(),
        s["mean_abs_error_percent"].get<double>(), s["max_abs_error_percent"].get<double>());
  }
  return text + WarningText(artifact);
}

std::string RegistrationTable(const json& artifact) {
  std::string text;
  for (const json& view : artifact["views"]) {
    const Eigen::Vector3d sigma_mm = 1e3 * VectorOrUnknown(view["position_sigma_m"], 3);
    text += fmt::format(
        "{:<8} {} tags, reprojection RMS {:.3f} px, camera centre ± {} {} {} mm\n",
        view["view"].get<std::string>(), view["tags_used"].get<int>(),
        view["reprojection_rms_px"].get<double>(), Number(NumberOrNull(sigma_mm.x()), "{:.1f}"),
        Number(NumberOrNull(sigma_mm.y()), "{:.1f}"), Number(NumberOrNull(sigma_mm.z()), "{:.1f}"));
  }
  return text;
}

std::string LinearizeTable(const Session& session, const json& artifact) {
  std::string text =
      fmt::format("session {}: {} views and states\n", session.name, artifact["photos"].size());
  for (const json& camera : artifact["cameras"]) {
    text += fmt::format("camera {}: response {}", camera["camera"].get<std::string>(),
                        camera["response"].get<std::string>());
    if (camera.contains("file")) text += fmt::format(", written to {}", camera["file"].get<std::string>());
    text += "\n";
  }
  for (const json& choice : artifact["choices"])
    text += fmt::format("{}: {} ({})\n", choice["what"].get<std::string>(),
                        choice["chosen"].get<std::string>(), choice["because"].get<std::string>());
  for (const json& gain : artifact["exposure_gains"])
    text += fmt::format("{:<40} exposure x {:.4f} +- {:.4f}\n", gain["file"].get<std::string>(),
                        gain["factor"].get<double>(), gain["relative_sigma"].get<double>());
  return artifact.contains("pictures") ? text + PicturesLine(artifact["pictures"]) : text;
}

std::string StatusLine(const json& result) {
  std::string line = fmt::format("session {}: {}", result["session"].get<std::string>(),
                                 result["status"].get<std::string>());
  if (result.contains("status_because"))
    line += fmt::format(" because of {}",
                        fmt::join(result["status_because"].get<std::vector<std::string>>(), ", "));
  return line + "\n";
}

std::string WarningText(const json& result) {
  const json because = result.value("status_because", json::array());
  std::string undetermined, others;
  for (const json& w : result["warnings"]) {
    const bool is_cause = std::count(because.begin(), because.end(), w.value("code", "")) > 0;
    (is_cause ? undetermined : others) +=
        fmt::format("{}: {}\n         remedy: {}\n", is_cause ? "undetermined" : "warning",
                    w["message"].get<std::string>(), w["remedy"].get<std::string>());
  }
  const std::string text = undetermined + others;
  return text.empty() ? text : "\n" + text;
}

std::string ResultTables(const json& result) {
  std::string text = StatusLine(result);
  if (!result["views"].empty()) {
    text += fmt::format("{} views registered, reprojection RMS {:.3f} px\n", result["views"].size(),
                        result["reprojection_rms_px"].get<double>());
  }
  text += LuminaireTable(result);
  if (!result["materials"].empty()) text += MaterialTable(result);
  constexpr size_t kMostSurfaces = 24;  // a screen; result.json and the report have them all
  if (result.contains("surfaces") && result["surfaces"].size() <= kMostSurfaces)
    text += SurfaceTable(result["surfaces"]);
  // Hundreds of readings would hide the rest; `luxfit check` lists them all.
  constexpr size_t kMaxReadings = 64;
  if (!result["luxmeter"].empty() && result["luxmeter"].size() <= kMaxReadings) text += LuxmeterTable(result);
  return text + WarningText(result);
}

}  // namespace luxfit
