#include "apps/commands/result/glare_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>

#include "apps/text/formats/artifact.h"
#include "apps/text/formats/csv_text.h"
#include "apps/text/formats/json_vectors.h"
#include "apps/text/suggest.h"
#include "apps/text/terminal.h"
#include "apps/text/with_sigma.h"
#include "inverse/control/photo_glare.h"

namespace luxfit {
namespace {

using nlohmann::json;

constexpr double kGlareDegreesPerRad = 180 / M_PI;

PhotoGlareOptions GlareOptionsOf(const GlareCommandOptions& options) {
  PhotoGlareOptions glare;
  glare.vertical_lx = options.vertical_lx;
  const std::string& text = options.threshold;
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const std::string unit = end;
  if (end == text.c_str() || !(value > 0) || !std::isfinite(value) || (!unit.empty() && unit != "x"))
    throw std::runtime_error(
        "--threshold: expected cd/m2 above 0, or a multiple of the mean such as 5x, got " + Quoted(text) +
        "; write 2000 or 5x");
  (unit.empty() ? glare.threshold_cd_m2 : glare.threshold_over_mean) = value;
  return glare;
}

std::vector<size_t> AskedPhotos(const GlareCommandOptions& options, const MeasuredPhotos& measured) {
  std::vector<size_t> photos;
  for (const std::string& name : options.names) photos.push_back(measured.IndexOf(name, "PHOTO " + name));
  if (photos.empty()) {
    for (size_t i = 0; i < measured.names.size(); ++i) photos.push_back(i);
  }
  if (options.vertical_lx && photos.size() != 1)
    throw std::runtime_error(fmt::format(
        "--ev: expected one photo, whose lens the luxmeter stood at, got {}; name one", photos.size()));
  return photos;
}

// Expects a luxmeter at the lens to read no less than the photo shows.
void ExpectPossibleIlluminance(const PhotoGlare& glare, const std::string& name) {
  if (!glare.is_vertical_given) return;
  constexpr double kAgrees = 0.9;
  double sources_lx = 0;
  for (const PhotoGlareSource& source : glare.sources) sources_lx += source.illuminance_lx;
  if (*glare.vertical_lx >= kAgrees * glare.seen_lx && *glare.vertical_lx > sources_lx) return;
  throw std::runtime_error(
      fmt::format("--ev: expected at least the {:.4g} lx that {} shows by itself, got {:g}; check the "
                  "reading's place and "
                  "direction, and the camera's scale",
                  glare.seen_lx, name, *glare.vertical_lx));
}

const char* ToText(GlareBound bound) {
  if (bound == GlareBound::kValue) return "value";
  return bound == GlareBound::kAtLeast ? "at_least" : "of_what_is_seen";
}

json SourceJson(const PhotoGlareSource& source, const Camera& camera) {
  const Eigen::Vector2d pixel = Project(camera, source.direction);
  return {{"x_px", pixel.x()},
          {"y_px", pixel.y()},
          {"pixels", source.pixels},
          {"solid_angle_sr", source.solid_angle_sr},
          {"luminance_cd_m2", source.luminance_cd_m2},
          {"illuminance_lx", source.illuminance_lx},
          {"angle_deg", kGlareDegreesPerRad * std::acos(std::min(1.0, source.direction.z()))},
          {"ugr_index", NumberOrNull(source.ugr_index)},
          {"dgp_index", source.hemisphere_index},
          {"is_clipped", source.is_clipped}};
}

// Returns by how much a value changes with the scale; null where one of both is not known.
json SigmaByScale(const std::optional<double>& value, const std::optional<double>& more) {
  return value && more ? json(std::abs(*more - *value)) : json();
}

json RatingJson(const PhotoGlare& glare, const PixelField& field, const std::optional<double>& scale_sigma,
                const Camera& camera) {
  const GlareRating rating = RatingOf(glare);
  const bool is_bound = !glare.is_vertical_given && (!glare.is_whole || glare.is_clipped);
  json out = {{"field_share", std::min(1.0, field.coverage)},
              {"is_clipped", glare.is_clipped},
              {"is_hidden", glare.is_hidden},
              {"threshold_cd_m2", glare.threshold_cd_m2},
              {"vertical_lx", glare.vertical_lx.value_or(glare.seen_lx)},
              {"vertical_sigma_lx", nullptr},
              {"vertical_is", glare.is_vertical_given ? "given" : (is_bound ? "at_least" : "value")},
              {"seen_lx", glare.seen_lx},
              {"background_cd_m2", rating.background_cd_m2},
              {"ugr", OrNull(rating.ugr)},
              {"ugr_sigma", nullptr},
              {"ugr_is", ToText(rating.ugr_bound)},
              {"dgp", OrNull(rating.dgp)},
              {"dgp_sigma", nullptr},
              {"dgp_is", ToText(rating.dgp_bound)},
              {"sources", json::array()}};
  if (scale_sigma) {
    const GlareRating more = RatingOf(glare, 1 + *scale_sigma);
    out["ugr_sigma"] = SigmaByScale(rating.ugr, more.ugr);
    out["dgp_sigma"] = SigmaByScale(rating.dgp, more.dgp);
    if (!glare.is_vertical_given) out["vertical_sigma_lx"] = *scale_sigma * glare.seen_lx;
  }
  for (const PhotoGlareSource& source : glare.sources) out["sources"].push_back(SourceJson(source, camera));
  return out;
}

// Photos without a scale have no rating.
json GlareJson(const std::vector<size_t>& photos, const MeasuredPhotos& measured,
               const PhotoGlareOptions& options) {
  std::map<int, PixelField> field_of_camera;
  json list = json::array();
  for (const size_t i : photos) {
    const LinearizedPhoto& photo = measured.photos.photos[i];
    json entry = {
        {"photo", measured.names[i]}, {"view", photo.view}, {"state", photo.state}, {"rating", nullptr}};
    if (const std::optional<LuminanceScale>& scale = measured.ScaleOf(i)) {
      const Camera& camera = measured.registered.cameras[static_cast<size_t>(photo.camera)];
      const auto known = field_of_camera.find(photo.camera);
      const PixelField& field = known != field_of_camera.end()
                                    ? known->second
                                    : field_of_camera.emplace(photo.camera, FieldOf(camera)).first->second;
      const LuminanceImage image = measured.Read(i);
      const PhotoGlare glare =
          GlareOfPhoto(static_cast<float>(scale->cdm2_per_unit) * image.relative_luminance, image.saturated,
                       field, measured.LevelFromCamera(i), options);
      ExpectPossibleIlluminance(glare, measured.names[i]);
      entry["rating"] = RatingJson(glare, field, scale->relative_sigma, camera);
    }
    list.push_back(entry);
  }
  return list;
}

void WarnOfGlare(const json& photos, RunContext& context) {
  const auto count = [&photos](auto is) { return std::count_if(photos.begin(), photos.end(), is); };
  const auto relative = count([](const json& photo) { return photo.at("rating").is_null(); });
  const auto clipped = count([](const json& photo) {
    return photo.at("rating").is_object() && photo.at("rating").at("is_clipped").get<bool>();
  });
  const auto hidden = count([](const json& photo) {
    return photo.at("rating").is_object() && photo.at("rating").at("is_hidden").get<bool>();
  });
  if (relative > 0)
    AddNoScale(
        fmt::format("{} of {} photos have no glare rating, for their camera has", relative, photos.size()),
        context);
  if (clipped > 0)
    context.AddUndetermined(
        {"luminance_clipped",
         fmt::format("{} of {} photos have pixels that are saturated in every exposure: their "
                     "glare is at least the one stated; in {} they saturate below the threshold, "
                     "and what glares there is not seen",
                     clipped, photos.size(), hidden),
         "add shorter exposures of the same views and states to the photo table: they are "
         "merged"});
}

std::string GlareValue(const json& rating, const std::string& key) {
  const json& value = rating[key];
  if (value.is_null()) return key == "ugr" && rating["is_hidden"].get<bool>() ? "clipped" : "-";
  const json& sigma = rating[key + "_sigma"];
  const std::string text = sigma.is_number() && sigma.get<double>() > 0
                               ? WithSigma(value.get<double>(), sigma.get<double>())
                               : fmt::format("{:.3g}", value.get<double>());
  const std::string is = rating[key + "_is"].get<std::string>();
  return (is == "at_least" ? ">= " : (is == "of_what_is_seen" ? "(seen) " : "")) + text;
}

std::string VerticalText(const json& rating) {
  const std::string is = rating["vertical_is"].get<std::string>();
  const std::string text =
      rating["vertical_sigma_lx"].is_number()
          ? WithSigma(rating["vertical_lx"].get<double>(), rating["vertical_sigma_lx"].get<double>())
          : fmt::format("{:.4g}", rating["vertical_lx"].get<double>());
  return (is == "at_least" ? ">= " : "") + text + (is == "given" ? " given" : "");
}

std::string GlareTable(const json& result) {
  size_t width = 5;
  for (const json& photo : result["photos"])
    width = std::max(width, photo["photo"].get<std::string>().size());
  std::string text = fmt::format(
      "{:<{}}  field %  E_v lx            sources  L_b cd/m2  UGR                DGP\n", "photo", width);
  bool is_partial = false;
  for (const json& photo : result["photos"]) {
    const json& rating = photo["rating"];
    if (rating.is_null()) {
      text += fmt::format("{:<{}}  relative\n", photo["photo"].get<std::string>(), width);
      continue;
    }
    is_partial = is_partial || rating["ugr_is"] == "of_what_is_seen";
    text += fmt::format(
        "{:<{}}  {:>7.1f}  {:<16}  {:>7}  {:>9.4g}  {:<17}  {}\n", photo["photo"].get<std::string>(), width,
        100 * rating["field_share"].get<double>(), VerticalText(rating), rating["sources"].size(),
        rating["background_cd_m2"].get<double>(), GlareValue(rating, "ugr"), GlareValue(rating, "dgp"));
  }
  if (is_partial)
    text +=
        "a photo of less than a hemisphere: E_v is at least that of the photo, UGR that of the sources seen "
        "before the "
        "background seen; DGP needs --ev\n";
  return text + WarningText(result);
}

std::string GlareCsv(const json& photos) {
  std::vector<CsvColumn> columns{{"photo", "/photo"}, {"view", "/view"}, {"state", "/state"}};
  for (const char* key : {"field_share", "is_clipped", "is_hidden", "threshold_cd_m2", "vertical_lx",
                          "vertical_sigma_lx", "vertical_is", "seen_lx", "background_cd_m2", "ugr",
                          "ugr_sigma", "ugr_is", "dgp", "dgp_sigma", "dgp_is"})
    columns.push_back({key, std::string("/rating/") + key});
  return CsvOf(photos, columns);
}

}  // namespace

int GlareCommand(const GlareCommandOptions& options) {
  const PhotoGlareOptions glare = GlareOptionsOf(options);
  RunContext context;
  const MeasuredPhotos measured = ReadMeasuredPhotos(options, LensNeed::kDirections, context);
  json result = ProvenanceJson("luxfit-glare-1", context.provenance);
  result["photos"] = GlareJson(AskedPhotos(options, measured), measured, glare);
  WarnOfGlare(result["photos"], context);
  result["warnings"] = WarningsJson(context);
  const std::string stem = context.out + "/luminance/glare";
  WriteText(stem + ".csv", GlareCsv(result["photos"]));
  WriteJson(stem + ".json", result);
  PrintText(options.json ? JsonText(result) : GlareTable(result));
  std::fprintf(stderr, "done      %s\n", (stem + ".csv").c_str());
  return context.IsUndetermined() ? 1 : 0;
}

}  // namespace luxfit
