#include "apps/commands/result/spot_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <utility>

#include "apps/session/session_files.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/formats/csv_table.h"
#include "apps/text/formats/csv_text.h"
#include "apps/text/suggest.h"
#include "apps/text/terminal.h"
#include "apps/text/with_sigma.h"
#include "calib/luminance/luminance_spot.h"

namespace luxfit {
namespace {

using nlohmann::json;

// Holds one spot as asked for.
struct AskedSpot {
  std::string where;  // for messages: the text on the command line, or FILE:LINE
  std::string photo;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double radius_px = 0;
};

AskedSpot SpotOfText(const std::string& text, double radius_px) {
  const size_t colon = text.rfind(':');
  std::istringstream numbers(colon == std::string::npos ? "" : text.substr(colon + 1));
  AskedSpot spot{"SPOT " + text, text.substr(0, colon), {}, radius_px};
  char comma = 0;
  if (!(numbers >> spot.pixel.x() >> comma >> spot.pixel.y()) || comma != ',' ||
      !(numbers >> std::ws).eof() || !spot.pixel.allFinite())
    throw std::runtime_error(
        "SPOT: expected PHOTO:X,Y (the photo as VIEW_STATE, the pixel), or one table .csv, got " +
        Quoted(text) + "; write it such as v00_all:240,180");
  return spot;
}

std::vector<AskedSpot> SpotsOfTable(const std::string& path, double radius_px) {
  const CsvTable table = ReadCsvTable(path, {{"photo", "x_px", "y_px"}, {"radius_px"}});
  std::vector<AskedSpot> spots;
  for (const CsvRow& row : table.rows) {
    const double radius = HasColumn(table, "radius_px") ? CsvNumber(table, row, "radius_px") : radius_px;
    if (!(radius >= 1))
      throw CsvError(
          table, row, "radius_px",
          fmt::format("expected 1 or more, got {:g}; a circle has pixels whose spread shows its noise",
                      radius));
    spots.push_back({fmt::format("{}:{}", path, row.line),
                     CsvText(table, row, "photo"),
                     {CsvNumber(table, row, "x_px"), CsvNumber(table, row, "y_px")},
                     radius});
  }
  return spots;
}

std::vector<AskedSpot> AskedSpots(const SpotCommandOptions& options) {
  std::vector<AskedSpot> spots;
  for (const std::string& spot : options.spots) {
    if (ExtensionOf(spot) == ".csv") {
      const std::vector<AskedSpot> more = SpotsOfTable(spot, options.radius_px);
      spots.insert(spots.end(), more.begin(), more.end());
    } else {
      spots.push_back(SpotOfText(spot, options.radius_px));
    }
  }
  return spots;
}

void ExpectWithinPhoto(const LuminanceImage& image, const AskedSpot& spot) {
  const Eigen::Index width = image.relative_luminance.cols(), height = image.relative_luminance.rows();
  const Eigen::Array2d least = spot.pixel.array() - spot.radius_px,
                       most = spot.pixel.array() + spot.radius_px;
  if ((least >= 0).all() && most.x() <= static_cast<double>(width - 1) &&
      most.y() <= static_cast<double>(height - 1))
    return;
  throw std::runtime_error(fmt::format(
      "{}: expected a circle within the photo of {} x {} pixels, got {:g} px about ({:g}, {:g}); move it, or "
      "give a smaller radius",
      spot.where, width, height, spot.radius_px, spot.pixel.x(), spot.pixel.y()));
}

// Returns why a spot has no luminance, or "none".
const char* GapOf(const LuminanceSpot& spot, bool is_absolute) {
  if (spot.saturated > 0) return "saturated";
  if (spot.dark > 0 || !(spot.relative_luminance > 0)) return "dark";
  return is_absolute ? "none" : "no_scale";
}

json SpotJson(const AskedSpot& asked, const MeasuredPhotos& measured, size_t index,
              const LuminanceImage& image) {
  const LinearizedPhoto& photo = measured.photos.photos[index];
  const LinearizedCamera& camera = measured.photos.cameras[static_cast<size_t>(photo.camera)];
  const std::optional<LuminanceScale>& scale = measured.ScaleOf(index);
  const LuminanceSpot spot = MeasureSpot(image, asked.pixel, asked.radius_px);
  const std::string gap = GapOf(spot, scale.has_value());
  json out = {{"photo", measured.names[index]}, {"view", photo.view},      {"state", photo.state},
              {"camera", camera.given.id},      {"x_px", asked.pixel.x()}, {"y_px", asked.pixel.y()},
              {"radius_px", asked.radius_px},   {"pixels", spot.pixels},   {"gap", gap},
              {"luminance_cd_m2", nullptr},     {"sigma_cd_m2", nullptr},  {"at_least_cd_m2", nullptr},
              {"relative_luminance", nullptr},  {"spread", nullptr},       {"relative_sigma", nullptr}};
  if (scale && gap == "saturated") out["at_least_cd_m2"] = scale->cdm2_per_unit * spot.relative_luminance;
  if (gap == "saturated" || gap == "dark") return out;
  std::optional<double> response;
  if (camera.response && camera.response->has_relative_sigma()) {
    std::vector<double> exposures_s;
    exposures_s.reserve(photo.bracket.size());
    for (const PhotoExposure& exposure : photo.bracket) exposures_s.push_back(exposure.relative_exposure_s);
    response = ResponseSigma(*camera.response, spot.relative_rgb, exposures_s, LuminanceOptionsOf(camera));
  }
  std::optional<double> of_scale;
  if (scale) of_scale = scale->relative_sigma;
  const double noise = spot.sigma / spot.relative_luminance;
  out["relative_luminance"] = spot.relative_luminance;
  out["spread"] = spot.spread / spot.relative_luminance;
  out["relative_sigma"] = {{"noise", noise}, {"response", OrNull(response)}, {"scale", OrNull(of_scale)}};
  if (!scale) return out;
  const double luminance = scale->cdm2_per_unit * spot.relative_luminance;
  out["luminance_cd_m2"] = luminance;
  out["sigma_cd_m2"] = luminance * std::hypot(noise, response.value_or(0), of_scale.value_or(0));
  return out;
}

// Reads each photo once.
json MeasureSpots(const std::vector<AskedSpot>& asked, const MeasuredPhotos& measured) {
  std::vector<size_t> photo_of_spot;
  photo_of_spot.reserve(asked.size());
  for (const AskedSpot& spot : asked) photo_of_spot.push_back(measured.IndexOf(spot.photo, spot.where));
  json spots = json::array();
  for (size_t i = 0; i < asked.size(); ++i) spots.push_back(nullptr);
  for (const size_t photo : std::set<size_t>(photo_of_spot.begin(), photo_of_spot.end())) {
    const LuminanceImage image = measured.Read(photo);
    for (size_t i = 0; i < asked.size(); ++i) {
      if (photo_of_spot[i] != photo) continue;
      ExpectWithinPhoto(image, asked[i]);
      spots[i] = SpotJson(asked[i], measured, photo, image);
    }
  }
  return spots;
}

void WarnOfGaps(const json& spots, RunContext& context) {
  const auto named = [&spots](const std::string& gap) {
    std::vector<std::string> names;
    for (const json& spot : spots) {
      if (spot.at("gap") == gap)
        names.push_back(fmt::format("{}:{:g},{:g}", spot.at("photo").get<std::string>(),
                                    spot.at("x_px").get<double>(), spot.at("y_px").get<double>()));
    }
    return names;
  };
  constexpr int kMostNames = 5;
  if (const auto names = named("saturated"); !names.empty())
    context.AddUndetermined(
        {"luminance_clipped",
         fmt::format("{} of {} spots have pixels that are saturated in every exposure, and "
                     "no luminance: {}",
                     names.size(), spots.size(), ListNames(names, kMostNames)),
         "add shorter exposures of the same views and states to the photo table: they are "
         "merged"});
  if (const auto names = named("dark"); !names.empty())
    context.AddUndetermined(
        {"luminance_dark",
         fmt::format("{} of {} spots have pixels that are too dark for a value, and no luminance: {}",
                     names.size(), spots.size(), ListNames(names, kMostNames)),
         "add longer exposures of the same views and states to the photo table: they are merged"});
  if (const auto names = named("no_scale"); !names.empty())
    AddNoScale(
        fmt::format("{} of {} spots are in relative units, for their camera has", names.size(), spots.size()),
        context);
}

std::string LuminanceText(const json& spot) {
  const std::string gap = spot["gap"].get<std::string>();
  if (gap == "none")
    return WithSigma(spot["luminance_cd_m2"].get<double>(), spot["sigma_cd_m2"].get<double>());
  if (gap == "no_scale") return fmt::format("relative {:.6g}", spot["relative_luminance"].get<double>());
  if (gap == "dark") return "too dark";
  return spot["at_least_cd_m2"].is_null()
             ? "saturated"
             : fmt::format("saturated: above {:.4g}", spot["at_least_cd_m2"].get<double>());
}

std::string SpotTable(const json& result) {
  const json& spots = result["spots"];
  size_t width = 5;
  for (const json& spot : spots) width = std::max(width, spot["photo"].get<std::string>().size());
  std::string text = fmt::format(
      "{:<{}}     x px    y px  radius px  pixels  cd/m2                  spread %\n", "photo", width);
  bool is_scale_unknown = false;
  for (const json& spot : spots) {
    const bool has_value = spot["relative_sigma"].is_object();
    is_scale_unknown =
        is_scale_unknown || (spot["gap"] == "none" && spot["relative_sigma"]["scale"].is_null());
    text +=
        fmt::format("{:<{}}  {:>7g} {:>7g}  {:>9g}  {:>6}  {:<21}  {}\n", spot["photo"].get<std::string>(),
                    width, spot["x_px"].get<double>(), spot["y_px"].get<double>(),
                    spot["radius_px"].get<double>(), spot["pixels"].get<int>(), LuminanceText(spot),
                    has_value ? fmt::format("{:>8.2f}", 100 * spot["spread"].get<double>()) : "       -");
  }
  if (is_scale_unknown)
    text +=
        "the sigmas leave out the error of the camera's scale, which is not known: --scale-sigma-percent\n";
  return text + WarningText(result);
}

std::string SpotCsv(const json& spots) {
  return CsvOf(spots, {{"photo", "/photo"},
                       {"view", "/view"},
                       {"state", "/state"},
                       {"camera", "/camera"},
                       {"x_px", "/x_px"},
                       {"y_px", "/y_px"},
                       {"radius_px", "/radius_px"},
                       {"pixels", "/pixels"},
                       {"luminance_cd_m2", "/luminance_cd_m2"},
                       {"sigma_cd_m2", "/sigma_cd_m2"},
                       {"at_least_cd_m2", "/at_least_cd_m2"},
                       {"gap", "/gap"},
                       {"relative_luminance", "/relative_luminance"},
                       {"spread", "/spread"},
                       {"noise_relative_sigma", "/relative_sigma/noise"},
                       {"response_relative_sigma", "/relative_sigma/response"},
                       {"scale_relative_sigma", "/relative_sigma/scale"}});
}

}  // namespace

int SpotCommand(const SpotCommandOptions& options) {
  const std::vector<AskedSpot> asked = AskedSpots(options);
  RunContext context;
  const MeasuredPhotos measured = ReadMeasuredPhotos(options, LensNeed::kNone, context);
  json result = ProvenanceJson("luxfit-spot-1", context.provenance);
  result["spots"] = MeasureSpots(asked, measured);
  WarnOfGaps(result["spots"], context);
  result["warnings"] = WarningsJson(context);
  const std::string stem = context.out + "/luminance/spots";
  WriteText(stem + ".csv", SpotCsv(result["spots"]));
  WriteJson(stem + ".json", result);
  PrintText(options.json ? JsonText(result) : SpotTable(result));
  std::fprintf(stderr, "done      %s\n", (stem + ".csv").c_str());
  return context.IsUndetermined() ? 1 : 0;
}

}  // namespace luxfit
