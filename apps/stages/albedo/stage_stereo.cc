#include "apps/stages/albedo/stage_stereo.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/stages/albedo/stereo_photos.h"
#include "apps/text/formats/json_vectors.h"
#include "calib/photo_files/image.h"

namespace luxfit {
namespace {

using nlohmann::json;

constexpr double kDegPerRad = 180 / M_PI;

void WritePictures(const StereoPhotos& photos, const PhotometricStereo& result, double factor,
                   const std::string& out) {
  const ImagePlane empty = ImagePlane::Zero(photos.height_px, photos.width_px);
  std::array<ImagePlane, 3> normals{empty, empty, empty}, albedo{empty, empty, empty};
  for (size_t i = 0; i < photos.places.size(); ++i) {
    const Eigen::Index at = static_cast<Eigen::Index>(i);
    if (!photos.regions.is_object[i] || !std::isfinite(result.albedo[at])) continue;
    const Eigen::Index u = photos.places[i].x(), v = photos.places[i].y();
    for (int c = 0; c < 3; ++c)
      normals[static_cast<size_t>(c)](v, u) = static_cast<float>(result.normal(c, at));
    albedo[0](v, u) = static_cast<float>(factor * result.albedo[at]);
    albedo[1](v, u) = static_cast<float>(factor * result.albedo_sigma[at]);
    albedo[2](v, u) = static_cast<float>(result.normal_sigma_rad[at]);
  }
  WriteExr(out + "/normals.exr", normals);
  WriteExr(out + "/albedo.exr", albedo);
}

json LightsJson(const StereoPhotos& photos, const PhotometricStereo& result, const StereoSummary& summary) {
  json lights = json::array();
  for (size_t k = 0; k < photos.states.size(); ++k) {
    const Eigen::Index image = static_cast<Eigen::Index>(k);
    const Eigen::Vector3d l = result.to_light.col(image);
    lights.push_back({{"state", photos.states[k]},
                      {"to_light", {l.x(), l.y(), l.z()}},
                      {"direction_sigma_deg", kDegPerRad * photos.data.direction_sigma_rad[image]},
                      {"adjusted_deg", kDegPerRad * summary.adjusted_rad[image]},
                      {"strength", result.strength[image]},
                      {"median_residual", NumberOrNull(summary.median_residual[image])}});
  }
  return lights;
}

json ObjectJson(const PhotometricStereo& result, const StereoSummary& summary) {
  return {{"pixels", summary.pixels},
          {"pixels_determined", summary.determined},
          {"albedo_unit", summary.is_absolute ? "reflectance" : "relative luminance over strength"},
          {"albedo_mean", NumberOrNull(summary.albedo_mean)},
          {"albedo_variation", NumberOrNull(summary.albedo_variation)},
          {"albedo_sigma_median", NumberOrNull(summary.albedo_sigma)},
          {"normal_sigma_median_deg", NumberOrNull(kDegPerRad * summary.normal_sigma_rad)},
          {"residual_sigma", result.residual_sigma}};
}

std::string LightsCsv(const json& lights) {
  std::string text = "state,x,y,z,strength,adjusted_deg,median_residual\n";
  for (const json& light : lights) {
    const json& l = light["to_light"];
    text += fmt::format("{},{:.6f},{:.6f},{:.6f},{:.5f},{:.3f},{:.3g}\n", light["state"].get<std::string>(),
                        l[0].get<double>(), l[1].get<double>(), l[2].get<double>(),
                        light["strength"].get<double>(), light["adjusted_deg"].get<double>(),
                        light["median_residual"].is_null() ? 0 : light["median_residual"].get<double>());
  }
  return text;
}

void RecordChoices(const Session& session, const PhotometricStereo& result, RunContext& context) {
  Choice curve{"reflectance curve", Describe(result.curve), {}, result.because};
  for (const CurveScore& s : result.scores)
    curve.among.push_back(fmt::format("{} (score {:.3f}, from the best by {:.3f})", ToString(s.kind), s.score,
                                      s.standard_error));
  context.choices.push_back(std::move(curve));
  context.choices.push_back({"strengths of the lights",
                             session.lights->strengths_known ? "as given" : "estimated",
                             {"known", "estimate"},
                             "lights.strengths"});
}

void WarnOfLights(const json& lights, const StereoSummary& summary, RunContext& context) {
  for (const int k : summary.suspect_lights) {
    const json& light = lights[static_cast<size_t>(k)];
    const double sigma = light["direction_sigma_deg"].get<double>();
    const double moved = light["adjusted_deg"].get<double>();
    context.warnings.push_back(
        {"light_direction",
         fmt::format("the light of {} is {:.1f} degrees from its measured direction, {:.1f} of its sigmas",
                     light["state"].get<std::string>(), moved, moved / sigma),
         "check that neither the light nor the camera moved between the photos of the sphere and of the "
         "object"});
  }
}

void WarnOfScale(const Session& session, const StereoSummary& summary, RunContext& context) {
  if (summary.is_absolute) return;
  context.warnings.push_back(
      {"albedo_relative",
       session.lights->reference_mask.empty()
           ? "albedo is known up to one common factor"
           : "albedo is known up to one common factor: no pixel of the reference is determined",
       "put a surface of known reflectance (a grey card) into the picture and name it in lights.reference"});
}

}  // namespace

json StereoSession(const Session& session, const LinearizedPhotos& linearized, RunContext& context) {
  json artifact = ProvenanceJson("luxfit-stereo-1", context.provenance);
  const StereoPhotos photos = ReadStereoPhotos(session, linearized);
  const StageTimer timer(context, "albedo",
                         fmt::format("photometric stereo of {} pixels under {} lights", photos.places.size(),
                                     photos.states.size()));
  PhotometricStereoOptions options;
  if (!session.lights->strengths_known) options.method = StereoMethod::kRobustStrengths;
  const PhotometricStereo result = SolvePhotometricStereo(photos.data, options);
  artifact["method"] = ToString(options.method);
  artifact["message"] = result.message;
  if (!result.IsUsable()) {
    context.AddUndetermined({"stereo_undetermined", "nothing is determined: " + result.message,
                             "photograph the object under more lights, spread around the camera"});
    WriteJson(context.out + "/stages/albedo.json", artifact);
    return artifact;
  }
  const StereoSummary summary = Summarize(photos.data, result, photos.regions);
  artifact["lights"] = LightsJson(photos, result, summary);
  artifact["object"] = ObjectJson(result, summary);
  const auto& p = result.curve.parameters;
  artifact["curve"] = {{"kind", ToString(result.curve.kind)},
                       {"parameters", std::vector<double>(p.begin(), p.end())}};
  RecordChoices(session, result, context);
  WarnOfLights(artifact["lights"], summary, context);
  WarnOfScale(session, summary, context);
  WritePictures(photos, result, summary.factor, context.out);
  WriteText(context.out + "/lights.csv", LightsCsv(artifact["lights"]));
  WriteJson(context.out + "/stages/albedo.json", artifact);
  return artifact;
}

json StereoResultJson(const Session& session, const json& artifact, const RunContext& context) {
  json result = ProvenanceJson("luxfit-result-1", context.provenance);
  result["session"] = session.name;
  AddStatus(context, result);
  for (const char* key : {"method", "message", "object", "lights", "curve"}) {
    if (artifact.contains(key)) result[key] = artifact[key];
  }
  result["choices"] = ChoicesJson(context);
  result["warnings"] = WarningsJson(context);
  result["timing_s"] = context.timing_s;
  return result;
}

std::string StereoTable(const json& result) {
  std::string text = StatusLine(result);
  // No pixel of the object may be determined, though some of the reference are.
  if (result.contains("object") && result["object"]["albedo_mean"].is_number()) {
    const json& o = result["object"];
    text += fmt::format("{} of {} pixels; albedo {:.4g} on average ({}), varying by {:.2f} %, sigma {:.2g}\n",
                        o["pixels_determined"].get<size_t>(), o["pixels"].get<int>(),
                        o["albedo_mean"].get<double>(), o["albedo_unit"].get<std::string>(),
                        100 * o["albedo_variation"].get<double>(), o["albedo_sigma_median"].get<double>());
    text +=
        fmt::format("normals: sigma {:.2f} degrees (median)\n", o["normal_sigma_median_deg"].get<double>());
  }
  for (const json& c : result["choices"])
    text += fmt::format("{}: {} ({})\n", c["what"].get<std::string>(), c["chosen"].get<std::string>(),
                        c["because"].get<std::string>());
  return text + WarningText(result);
}

}  // namespace luxfit
