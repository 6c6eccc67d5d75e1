#include "apps/stages/albedo/stage_stereo.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/stages/albedo/stereo_photos.h"
#include "apps/text/formats/json_vectors.h"
#include "calib/luminance/image.h"
#include "calib/luminance/median.h"

namespace luxfit {
namespace {

using nlohmann::json;

constexpr double kDegPerRad = 180 / M_PI;
// A direction that is adjusted by more than this many of its sigmas was measured less well than stated.
constexpr double kSuspectSigmas = 3;

// Returns the factor from the albedo's unit to reflectance; NaN without a surface of known albedo.
double ReferenceFactor(const Session& session, const StereoPhotos& photos, const PhotometricStereo& result) {
  std::vector<double> albedo;
  for (size_t i = 0; i < photos.places.size(); ++i) {
    const double value = result.albedo[static_cast<Eigen::Index>(i)];
    if (photos.is_reference[i] && std::isfinite(value)) albedo.push_back(value);
  }
  return session.lights->reference_albedo / Quantile(std::move(albedo), 0.5);
}

// Summarizes the object's pixels alone.
struct Summary {
  std::vector<double> albedo, albedo_sigma, normal_sigma_deg;
  int pixels = 0;
};
Summary Summarize(const StereoPhotos& photos, const PhotometricStereo& result, double factor) {
  Summary summary;
  for (size_t i = 0; i < photos.places.size(); ++i) {
    if (!photos.is_object[i]) continue;
    ++summary.pixels;
    const Eigen::Index at = static_cast<Eigen::Index>(i);
    if (!std::isfinite(result.albedo[at])) continue;
    summary.albedo.push_back(factor * result.albedo[at]);
    summary.albedo_sigma.push_back(factor * result.albedo_sigma[at]);
    summary.normal_sigma_deg.push_back(kDegPerRad * result.normal_sigma_rad[at]);
  }
  return summary;
}

void WritePictures(const StereoPhotos& photos, const PhotometricStereo& result, double factor,
                   const std::string& out) {
  const ImagePlane empty = ImagePlane::Zero(photos.height_px, photos.width_px);
  std::array<ImagePlane, 3> normals{empty, empty, empty}, albedo{empty, empty, empty};
  for (size_t i = 0; i < photos.places.size(); ++i) {
    const Eigen::Index at = static_cast<Eigen::Index>(i);
    if (!photos.is_object[i] || !std::isfinite(result.albedo[at])) continue;
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

// Returns the median absolute residual of one image over the object.
double MedianResidual(const StereoPhotos& photos, const PhotometricStereo& result, Eigen::Index image) {
  std::vector<double> sizes;
  for (size_t i = 0; i < photos.places.size(); ++i) {
    const double r = result.residual(image, static_cast<Eigen::Index>(i));
    if (photos.is_object[i] && std::isfinite(r)) sizes.push_back(std::abs(r));
  }
  return Quantile(std::move(sizes), 0.5);
}

json LightsJson(const StereoPhotos& photos, const PhotometricStereo& result) {
  json lights = json::array();
  for (size_t k = 0; k < photos.states.size(); ++k) {
    const Eigen::Index image = static_cast<Eigen::Index>(k);
    const Eigen::Vector3d l = result.to_light.col(image);
    const double moved = std::acos(std::min(1.0, l.dot(photos.data.to_light.col(image))));
    lights.push_back({{"state", photos.states[k]},
                      {"to_light", {l.x(), l.y(), l.z()}},
                      {"direction_sigma_deg", kDegPerRad * photos.data.direction_sigma_rad[image]},
                      {"adjusted_deg", kDegPerRad * moved},
                      {"strength", result.strength[image]},
                      {"median_residual", NumberOrNull(MedianResidual(photos, result, image))}});
  }
  return lights;
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

void WarnOfLights(const json& lights, RunContext& context) {
  for (const json& light : lights) {
    const double sigma = light["direction_sigma_deg"].get<double>();
    const double moved = light["adjusted_deg"].get<double>();
    if (!(sigma > 0) || moved < kSuspectSigmas * sigma) continue;
    context.warnings.push_back(
        {"light_direction",
         fmt::format("the light of {} is {:.1f} degrees from its measured direction, {:.1f} of its sigmas",
                     light["state"].get<std::string>(), moved, moved / sigma),
         "check that neither the light nor the camera moved between the photos of the sphere and of the "
         "object"});
  }
}

void WarnOfScale(const Session& session, double factor, RunContext& context) {
  if (std::isfinite(factor)) return;
  context.warnings.push_back(
      {"albedo_relative",
       session.lights->reference_mask.empty()
           ? "albedo is known up to one common factor"
           : "albedo is known up to one common factor: no pixel of the reference is determined",
       "put a surface of known reflectance (a grey card) into the picture and name it in lights.reference"});
}

}  // namespace

json StereoSession(const Session& session, RunContext& context) {
  json artifact = ProvenanceJson("luxfit-stereo-1", context.provenance);
  const StereoPhotos photos = ReadStereoPhotos(session);
  const StageTimer timer(context, "albedo",
                         fmt::format("photometric stereo of {} pixels under {} lights", photos.places.size(),
                                     photos.states.size()));
  PhotometricStereoOptions options;
  if (!session.lights->strengths_known) options.method = StereoMethod::kRobustStrengths;
  const PhotometricStereo result = SolvePhotometricStereo(photos.data, options);
  artifact["method"] = ToString(options.method);
  artifact["message"] = result.message;
  if (!result.IsUsable()) {
    context.undetermined = true;
    context.warnings.push_back({"stereo_undetermined", "nothing is determined: " + result.message,
                                "photograph the object under more lights, spread around the camera"});
    WriteJson(context.out + "/stages/albedo.json", artifact);
    return artifact;
  }
  const double factor = ReferenceFactor(session, photos, result);
  const bool is_absolute = std::isfinite(factor);
  const Summary summary = Summarize(photos, result, is_absolute ? factor : 1);
  artifact["lights"] = LightsJson(photos, result);
  const Eigen::Map<const Eigen::ArrayXd> albedo(summary.albedo.data(),
                                                static_cast<Eigen::Index>(summary.albedo.size()));
  const double mean = albedo.mean();
  artifact["object"] = {{"pixels", summary.pixels},
                        {"pixels_determined", summary.albedo.size()},
                        {"albedo_unit", is_absolute ? "reflectance" : "relative luminance over strength"},
                        {"albedo_mean", NumberOrNull(mean)},
                        {"albedo_variation", NumberOrNull(std::sqrt((albedo - mean).square().mean()) / mean)},
                        {"albedo_sigma_median", NumberOrNull(Quantile(summary.albedo_sigma, 0.5))},
                        {"normal_sigma_median_deg", NumberOrNull(Quantile(summary.normal_sigma_deg, 0.5))},
                        {"residual_sigma", result.residual_sigma}};
  const auto& p = result.curve.parameters;
  artifact["curve"] = {{"kind", ToString(result.curve.kind)},
                       {"parameters", std::vector<double>(p.begin(), p.end())}};
  RecordChoices(session, result, context);
  WarnOfLights(artifact["lights"], context);
  WarnOfScale(session, factor, context);
  WritePictures(photos, result, is_absolute ? factor : 1, context.out);
  WriteText(context.out + "/lights.csv", LightsCsv(artifact["lights"]));
  WriteJson(context.out + "/stages/albedo.json", artifact);
  return artifact;
}

json StereoResultJson(const Session& session, const json& artifact, const RunContext& context) {
  json result = ProvenanceJson("luxfit-result-1", context.provenance);
  result["session"] = session.name;
  result["status"] = context.undetermined ? "undetermined" : "done";
  for (const char* key : {"method", "message", "object", "lights", "curve"}) {
    if (artifact.contains(key)) result[key] = artifact[key];
  }
  result["choices"] = ChoicesJson(context);
  result["warnings"] = WarningsJson(context);
  result["timing_s"] = context.timing_s;
  return result;
}

std::string StereoTable(const json& result) {
  std::string text = fmt::format("session {}: {}\n", result["session"].get<std::string>(),
                                 result["status"].get<std::string>());
  if (result.contains("object")) {
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
