#include "apps/commands/result/luxmap_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/commands/internal/new_photos.h"
#include "apps/export/lux_photos.h"
#include "apps/stages/simulate/given_session.h"
#include "apps/text/file_stem.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/formats/csv_text.h"
#include "apps/text/suggest.h"
#include "inverse/control/dimming.h"

namespace luxfit {
namespace {

using nlohmann::json;

constexpr double kMostlySaturated = 0.5;
constexpr double kMuchUnexplained = 0.05;

// Holds a luxmeter's place, and the element under it where it stands on a surface.
struct Place {
  std::string id;
  int element = -1;
};

// Holds what one run of the command knows.
struct Watched {
  const FittedRoom& fitted;
  SurfaceScale scale;
  Eigen::MatrixXd flux_covariance;
  double relative_model_sigma = 0;
  std::vector<Place> places;
  PlaceLight light;  // at the places
};

int ElementUnder(const Room& room, const Sensor& sensor) {
  constexpr double kOnSurfaceM = 0.02;
  const RayHit hit = room.rays.Trace(sensor.position + 1e-4 * sensor.normal, -sensor.normal);
  if (hit.facet < 0 || !hit.front || hit.distance > kOnSurfaceM) return -1;
  const int element = room.patches.ElementAt(hit.facet, hit.u, hit.v);
  if (element < 0) return -1;
  return room.patches.elements[static_cast<size_t>(element)].normal.dot(sensor.normal) > 0.99 ? element : -1;
}

Watched Watch(const FittedRoom& fitted) {
  const FitUncertainty uncertainty = ReadFitUncertainty(fitted.out);
  Watched watched{fitted,
                  ScaleOfSurfaces(fitted.camera_scale, SurfacesOf(fitted), uncertainty),
                  FluxCovariance(uncertainty, fitted.luminaires),
                  uncertainty.relative_model_sigma,
                  {},
                  {}};
  const ReadingPlaces given = PlacesOfReadings(fitted.session);
  for (size_t i = 0; i < given.sensors.size(); ++i) {
    const auto& of = given.sensor_of_reading;
    const auto reading = std::find(of.begin(), of.end(), static_cast<Eigen::Index>(i)) - of.begin();
    watched.places.push_back({fitted.session.luxmeter.readings[static_cast<size_t>(reading)].id,
                              ElementUnder(fitted.room, given.sensors[i])});
  }
  watched.light = fitted.light->LightAt(given.sensors);
  return watched;
}

json DimmingJson(const FittedRoom& fitted, const CurrentDimming& current) {
  json list = json::array();
  for (size_t k = 0; k < fitted.luminaires.size(); ++k) {
    const Eigen::Index i = static_cast<Eigen::Index>(k);
    json entry = {{"id", fitted.luminaires[k].id}, {"dimming", nullptr}, {"sigma", nullptr}};
    if (current.is_determined) {
      entry["dimming"] = current.dimming[i];
      entry["sigma"] = std::sqrt(current.covariance(i, i));
    }
    list.push_back(entry);
  }
  return list;
}

// Returns the light at each place over that at the middle of the element under it, because the photo shows the
// element's mean. It is 1 where nothing is known.
Eigen::VectorXd AtPlaces(const Watched& watched, const CurrentDimming& current) {
  Eigen::VectorXd ratio = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(watched.places.size()));
  if (!current.is_determined) return ratio;
  const Eigen::VectorXd there_lx = watched.light.Under(current.dimming);
  const Eigen::VectorXd middle_lx = watched.fitted.light->AtElements().Under(current.dimming);
  for (Eigen::Index i = 0; i < ratio.size(); ++i) {
    const int element = watched.places[static_cast<size_t>(i)].element;
    if (element >= 0 && there_lx[i] > 0 && middle_lx[element] > 0)
      ratio[i] = there_lx[i] / middle_lx[element];
  }
  return ratio;
}

// Lists the illuminance of every place: from the element under it where the photo shows that, and from the
// luminaires' dimming everywhere.
json PlacesJson(const Watched& watched, const CurrentDimming& current,
                const std::vector<ElementIlluminance>& elements) {
  json list = json::array();
  const Eigen::VectorXd at_place = AtPlaces(watched, current);
  std::vector<PlaceIlluminance> predicted;
  if (current.is_determined)
    predicted = LightByDimming(watched.light.While(current.dimming), current, watched.flux_covariance,
                               watched.relative_model_sigma);
  for (size_t i = 0; i < watched.places.size(); ++i) {
    const Place& place = watched.places[i];
    json entry = {{"id", place.id},
                  {"seen_lx", nullptr},
                  {"seen_sigma_lx", nullptr},
                  {"predicted_lx", nullptr},
                  {"predicted_sigma_lx", nullptr}};
    const auto seen = std::find_if(elements.begin(), elements.end(),
                                   [&](const ElementIlluminance& e) { return e.element == place.element; });
    if (place.element >= 0 && seen != elements.end()) {
      const double ratio = at_place[static_cast<Eigen::Index>(i)];
      entry["seen_lx"] = ratio * seen->illuminance_lx;
      entry["seen_sigma_lx"] = ratio * seen->sigma_lx;
    }
    if (!predicted.empty()) {
      entry["predicted_lx"] = predicted[i].illuminance_lx;
      entry["predicted_sigma_lx"] = predicted[i].sigma_lx;
    }
    list.push_back(entry);
  }
  return list;
}

std::string ElementCsv(const Patches& patches, const std::vector<ElementIlluminance>& elements) {
  std::string text = "element,x_m,y_m,z_m,nx,ny,nz,pixels,illuminance_lx,sigma_lx\n";
  for (const ElementIlluminance& e : elements) {
    const Element& of = patches.elements[static_cast<size_t>(e.element)];
    text += CsvLine({std::to_string(e.element), CsvField(of.center.x()), CsvField(of.center.y()),
                     CsvField(of.center.z()), CsvField(of.normal.x()), CsvField(of.normal.y()),
                     CsvField(of.normal.z()), std::to_string(e.pixels), CsvField(e.illuminance_lx),
                     CsvField(e.sigma_lx)});
  }
  return text;
}

void WarnOfPhoto(const FittedRoom& fitted, const std::string& name, const std::string& state,
                 const CurrentDimming& current, RunContext& context) {
  if (!current.is_determined) {
    context.AddUndetermined({"dimming_undetermined", name + " shows too little to tell the luminaires apart",
                             "photograph a view that shows more of the room's surfaces"});
    return;
  }
  if (current.unexplained_share > kMuchUnexplained) {
    context.warnings.push_back(
        {"unexplained_light",
         fmt::format("{}: {:.0f} % of the light is not explained by the luminaires ({:+.1f} lx in the mean); "
                     "what is predicted for places that the photo does not show is as uncertain",
                     name, 100 * current.unexplained_share, current.mean_unexplained_lx),
         "daylight, a luminaire that the fit does not know, or surfaces that changed: photograph the places, "
         "or fit the room again"});
  }
  if (state.empty()) return;
  const Eigen::VectorXd expected = DimmingOf(fitted, state);
  for (Eigen::Index k = 0; k < expected.size(); ++k) {
    const double off = current.dimming[k] - expected[k], sigma = std::sqrt(current.covariance(k, k));
    constexpr double kSigmas = 3, kLeast = 0.05;
    if (std::abs(off) < std::max(kSigmas * sigma, kLeast)) continue;
    context.warnings.push_back(
        {"not_the_state",
         fmt::format("{}: luminaire {} is at {:.2f} +- {:.2f}, state \"{}\" has it at {:.2f}", name,
                     fitted.luminaires[static_cast<size_t>(k)].id, current.dimming[k], sigma, state,
                     expected[k]),
         "look at the luminaire and its control"});
  }
}

json PhotoJson(const Watched& watched, const NewPhotos& read, const NewPhoto& photo, const std::string& stem,
               const LuxmapCommandOptions& options, const PhotoCorrections& corrections,
               RunContext& context) {
  const FittedRoom& fitted = watched.fitted;
  const Camera& camera = fitted.registered.cameras[static_cast<size_t>(photo.photo.camera)];
  const std::string name = std::filesystem::path(photo.photo.file).filename().string();
  const LuminanceImage image = ReadCorrected(read.linearized, photo.photo, camera, corrections);
  const PhotoView view = ViewOf(fitted, photo.photo.camera, UnprojectAllPixels(camera), photo.cam_from_world);
  const LuxMap lux = MapIlluminance(view.dense, image, fitted.room.patches, watched.scale);
  if (lux.saturated_share > kMostlySaturated)
    throw std::runtime_error(
        fmt::format("{}: expected a photo that shows surfaces, but {:.0f} % of their pixels are saturated; "
                    "expose shorter",
                    photo.photo.file, 100 * lux.saturated_share));
  const std::vector<ElementIlluminance> elements =
      ElementsOf(ObservePhoto(view.strict, image, 0, 0), fitted.room.patches, watched.scale);
  const CurrentDimming current = EstimateDimming(fitted.light->AtElements().total_lx, elements);
  WarnOfPhoto(fitted, name, options.state, current, context);
  const std::string path = context.out + "/maps/" + stem;
  WriteLuxMap(lux, path, name);
  WriteText(path + "_elements.csv", ElementCsv(fitted.room.patches, elements));
  return {{"file", photo.photo.file},
          {"time", photo.time},
          {"map", "maps/" + stem + ".exr"},
          {"known_share", lux.known_share},
          {"saturated_share", lux.saturated_share},
          {"elements", elements.size()},
          {"unexplained_share", current.is_determined ? json(current.unexplained_share) : json()},
          {"mean_unexplained_lx", current.is_determined ? json(current.mean_unexplained_lx) : json()},
          {"luminaires", DimmingJson(fitted, current)},
          {"places", PlacesJson(watched, current, elements)}};
}

std::string PhotosCsv(const FittedRoom& fitted, const json& photos) {
  std::vector<CsvColumn> columns{{"file", "/file"}, {"time", "/time"}, {"known_share", "/known_share"}};
  for (size_t k = 0; k < fitted.luminaires.size(); ++k) {
    const std::string at = "/luminaires/" + std::to_string(k);
    columns.push_back({CsvField("dimming of " + fitted.luminaires[k].id), at + "/dimming"});
    columns.push_back({CsvField("sigma of " + fitted.luminaires[k].id), at + "/sigma"});
  }
  columns.push_back({"unexplained_share", "/unexplained_share"});
  columns.push_back({"mean_unexplained_lx", "/mean_unexplained_lx"});
  return CsvOf(photos, columns);
}

std::string PlacesCsv(const json& photos) {
  json rows = json::array();
  for (const json& photo : photos) {
    for (json place : photo["places"]) {
      place["file"] = photo["file"];
      place["time"] = photo["time"];
      rows.push_back(place);
    }
  }
  return CsvOf(rows, {{"file", "/file"},
                      {"time", "/time"},
                      {"id", "/id"},
                      {"seen_lx", "/seen_lx"},
                      {"seen_sigma_lx", "/seen_sigma_lx"},
                      {"predicted_lx", "/predicted_lx"},
                      {"predicted_sigma_lx", "/predicted_sigma_lx"}});
}

std::string ValueText(const json& value, const json& sigma) {
  if (!value.is_number()) return "-";
  return fmt::format("{:.2f} ± {:.2f}", value.get<double>(), sigma.get<double>());
}

std::string LuxMapTable(const json& result) {
  std::string text;
  for (const json& photo : result["photos"]) {
    text += fmt::format("{} {}: {:.0f} % of the pixels have a known illuminance\n",
                        std::filesystem::path(photo["file"].get<std::string>()).filename().string(),
                        photo["time"].get<std::string>(), 100 * photo["known_share"].get<double>());
    for (const json& l : photo["luminaires"])
      text += fmt::format("  luminaire {:<10} at {}\n", l["id"].get<std::string>(),
                          ValueText(l["dimming"], l["sigma"]));
    if (photo["unexplained_share"].is_number())
      text += fmt::format("  not explained by them: {:.1f} % of the light, {:+.2f} lx in the mean\n",
                          100 * photo["unexplained_share"].get<double>(),
                          photo["mean_unexplained_lx"].get<double>());
    text += "  place        seen lx             predicted lx\n";
    for (const json& p : photo["places"])
      text += fmt::format("  {:<12} {:<19} {}\n", p["id"].get<std::string>(),
                          ValueText(p["seen_lx"], p["seen_sigma_lx"]),
                          ValueText(p["predicted_lx"], p["predicted_sigma_lx"]));
  }
  return text + WarningText(result);
}

void ExpectScale(const FittedRoom& fitted) {
  if (fitted.camera_scale > 0) return;
  throw std::runtime_error(fitted.out +
                           "/result.json: camera_scale: expected a fit of photos with an absolute scale, got "
                           "none; give a luxmeter reading the role scale and run `luxfit run` again");
}

}  // namespace

int LuxmapCommand(const LuxmapCommandOptions& options) {
  const FittedRoom fitted = ReadFittedRoom(options.out, options.session);
  ExpectScale(fitted);
  if (!options.state.empty()) DimmingOf(fitted, options.state);  // throws, naming the known ones
  RunContext context;
  context.out = std::filesystem::absolute(options.folder.empty() ? fitted.out + "/luxmap" : options.folder)
                    .lexically_normal()
                    .string();
  context.is_quiet = true;
  const NewPhotos read = ReadNewPhotos(fitted, options, context);
  context.provenance = {options.command_line, {fitted.out + "/result.json"}};
  std::vector<std::string> names;
  for (const NewPhoto& photo : read.photos) {
    context.provenance.inputs.push_back(photo.photo.file);
    names.push_back(std::filesystem::path(photo.photo.file).stem().string());
  }
  const std::vector<std::string> stems = DistinctFileStems(names);
  const Watched watched = Watch(fitted);
  const PhotoCorrections corrections = ReadPhotoCorrections(fitted.out);
  json result = ProvenanceJson("luxfit-luxmap-1", context.provenance);
  result["photos"] = json::array();
  for (size_t i = 0; i < read.photos.size(); ++i)
    result["photos"].push_back(
        PhotoJson(watched, read, read.photos[i], stems[i], options, corrections, context));
  result["warnings"] = WarningsJson(context);
  WriteText(context.out + "/photos.csv", PhotosCsv(fitted, result["photos"]));
  WriteText(context.out + "/places.csv", PlacesCsv(result["photos"]));
  WriteJson(context.out + "/luxmap.json", result);
  std::fputs(options.json ? JsonText(result).c_str() : LuxMapTable(result).c_str(), stdout);
  std::fprintf(stderr, "done      %s\n", (context.out + "/luxmap.json").c_str());
  return context.IsUndetermined() ? 1 : 0;
}

}  // namespace luxfit
