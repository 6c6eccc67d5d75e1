#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "apps/python/mesh_room.h"
#include "apps/session/tag_map.h"
#include "apps/stages/linearize/photo_store.h"
#include "apps/stages/observe/found_furniture.h"
#include "apps/stages/observe/observed_words.h"
#include "apps/stages/register/registration_words.h"
#include "apps/stages/warning_order.h"
#include "apps/text/suggest.h"
#include "calib/lens/camera_file.h"
#include "calib/photo_files/image.h"
#include "forward/room/threads.h"
#include "inverse/fit/fit_room.h"
#include "inverse/model/fitted_light.h"
#include "inverse/observe/observe_photos.h"

namespace luxfit {
namespace {

namespace py = pybind11;
using StateDimming = std::map<std::string, double>;  // luminaire -> 0 to 1

struct FoundLight {
  RoomFit fit;
  std::vector<std::string> materials;
  std::vector<EstimatedLuminaire> luminaires;
  std::vector<PredictedReading> readings;
  std::shared_ptr<const Room> changed;  // with the furniture that photos show; null: none
  const Room* room = nullptr;           // of the fit: that, or the caller's
};

int IndexOf(const std::vector<std::string>& names, const std::string& name, const std::string& place) {
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end()) throw std::runtime_error(place + ": " + ExpectedOneOf(names, name));
  return static_cast<int>(at - names.begin());
}

// Returns a value of a dict in a list. `place` names it, such as "fit_room: photos[3]".
template <typename T>
T Value(const py::dict& entry, const char* key, const char* expected, const std::string& place,
        const std::optional<T>& otherwise = std::nullopt) {
  if (!entry.contains(key)) {
    if (otherwise) return *otherwise;
    throw std::runtime_error(place + "." + key + ": expected " + expected + ", got nothing");
  }
  try {
    return entry[key].cast<T>();
  } catch (const py::cast_error&) {
    throw std::runtime_error(place + "." + key + ": expected " + expected + ", got " +
                             py::repr(entry[key]).cast<std::string>());
  }
}

void ExpectKeys(const py::dict& entry, const std::vector<std::string>& known, const std::string& place) {
  for (const auto& item : entry) {
    const auto key = py::str(item.first).cast<std::string>();
    if (std::count(known.begin(), known.end(), key) == 0)
      throw std::runtime_error(place + ": key: " + ExpectedOneOf(known, key));
  }
}

void ExpectDimming(double value, const std::string& id, const std::string& place) {
  if (value >= 0 && value <= 1) return;
  throw std::runtime_error(place + "[\"" + id + "\"]: expected a number in [0, 1], got " +
                           std::to_string(value));
}

// Luminaires in the order in which the states name them.
StateTable StateTableOf(const py::dict& states) {
  StateTable names;
  std::vector<StateDimming> dimming;
  for (const auto& item : states) {
    names.states.push_back(py::str(item.first).cast<std::string>());
    const std::string place = "fit_room: states[\"" + names.states.back() + "\"]";
    try {
      // A cast would turn other values into a dict.
      if (!py::isinstance<py::dict>(item.second)) throw py::cast_error();
      for (const auto& luminaire : py::reinterpret_borrow<py::dict>(item.second)) {
        const auto id = luminaire.first.cast<std::string>();
        if (std::count(names.luminaires.begin(), names.luminaires.end(), id) == 0)
          names.luminaires.push_back(id);
      }
      dimming.push_back(item.second.cast<StateDimming>());
    } catch (const py::cast_error&) {
      throw std::runtime_error(place +
                               ": expected a dict of luminaires and their dimming, such as {\"A\": 1.0}");
    }
    for (const auto& [id, value] : dimming.back()) ExpectDimming(value, id, place);
  }
  names.dimming.reserve(dimming.size());
  for (const StateDimming& state : dimming) {
    names.dimming.push_back(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(names.luminaires.size())));
    for (const auto& [id, value] : state) names.dimming.back()[IndexOf(names.luminaires, id, "")] = value;
  }
  return names;
}

struct PhotoFiles {
  RoomPhotos photos;
  std::vector<std::string> files;  // one for each
};

PhotoFiles PhotoFilesOf(const std::vector<py::dict>& given, size_t cameras, const StateTable& names) {
  PhotoFiles photos;
  photos.photos.cameras.resize(cameras);
  for (size_t i = 0; i < given.size(); ++i) {
    const std::string place = "fit_room: photos[" + std::to_string(i) + "]";
    ExpectKeys(given[i], {"file", "view", "state", "exposure_s", "camera"}, place);
    RoomPhoto photo;
    photos.files.push_back(Value<std::filesystem::path>(given[i], "file", "a path", place).string());
    photo.exposure_s = Value<double>(given[i], "exposure_s", "a time in s", place);
    photo.view = Value<std::string>(given[i], "view", "a name", place);
    photo.state =
        IndexOf(names.states, Value<std::string>(given[i], "state", "a name", place), place + ".state");
    photo.camera = Value<int>(given[i], "camera", "an index of cameras", place, 0);
    if (photo.camera < 0 || photo.camera >= static_cast<int>(cameras))
      throw std::runtime_error(place + ".camera: expected an index below " + std::to_string(cameras) +
                               ", got " + std::to_string(photo.camera));
    if (!(photo.exposure_s > 0))
      throw std::runtime_error(place + ".exposure_s: expected > 0 s, got " +
                               std::to_string(photo.exposure_s));
    photos.photos.photos.push_back(std::move(photo));
  }
  const auto store = std::make_shared<PhotoStore>();
  photos.photos.read = [store, files = photos.files, of = photos.photos.photos](size_t i) {
    return store->Get(files[i], [&] { return ToRelativeLuminance(ReadPhoto(files[i]), of[i].exposure_s); });
  };
  return photos;
}

std::vector<MeterReading> ReadingsOf(const std::vector<py::dict>& given, const StateTable& names) {
  std::vector<MeterReading> readings;
  readings.reserve(given.size());
  for (size_t i = 0; i < given.size(); ++i) {
    const std::string place = "fit_room: readings[" + std::to_string(i) + "]";
    ExpectKeys(given[i], {"position_m", "normal", "state", "illuminance_lx", "used"}, place);
    const auto position = Value<Eigen::Vector3d>(given[i], "position_m", "three numbers", place);
    const auto normal = Value<Eigen::Vector3d>(given[i], "normal", "three numbers", place);
    MeterReading reading;
    reading.sensor = SensorsFrom(position.transpose(), normal.transpose()).front();
    reading.state =
        IndexOf(names.states, Value<std::string>(given[i], "state", "a name", place), place + ".state");
    reading.illuminance_lx = Value<double>(given[i], "illuminance_lx", "a number", place);
    reading.used = Value<bool>(given[i], "used", "True or False", place, true);
    if (!(reading.illuminance_lx > 0))
      throw std::runtime_error(place + ".illuminance_lx: expected > 0 lx, got " +
                               std::to_string(reading.illuminance_lx));
    readings.push_back(reading);
  }
  return readings;
}

std::vector<std::optional<double>> KnownAlbedo(const Room& room, const std::map<std::string, double>& given) {
  std::vector<std::optional<double>> albedo(room.scene.materials.size());
  for (const auto& [name, value] : given) {
    const int m = IndexOf(room.scene.materials, name, "fit_room: albedo");
    if (!(value >= 0 && value < 1))
      throw std::runtime_error("fit_room: albedo[\"" + name + "\"]: expected a number in [0, 1), got " +
                               std::to_string(value));
    albedo[static_cast<size_t>(m)] = value;
  }
  return albedo;
}

// Puts what was said before a fit in front of its own findings.
void PutFirst(Findings before, Findings& findings) {
  findings.warnings.insert(findings.warnings.begin(), before.warnings.begin(), before.warnings.end());
  findings.choices.insert(findings.choices.begin(), before.choices.begin(), before.choices.end());
}

void TakeEvidence(Evidence evidence, RoomObservations& given) {
  given.observations = std::move(evidence.observations);
  given.seen = std::move(evidence.seen);
  given.outlines = std::move(evidence.outlines);
  given.views = std::move(evidence.views);
  given.pose_covariance = std::move(evidence.pose_covariance);
  given.ambient_spread = evidence.ambient_spread;
}

// Says what registration and observation found, as `luxfit run` does.
Findings FindingsOf(const PhotoObservations& seen, const PhotoFiles& given,
                    const std::vector<std::string>& cameras, const StateTable& states) {
  Findings findings;
  const PhotoNames all{cameras, states.states, given.files};
  for (const PhotoOfWrongView& other : seen.misplaced) {
    const RoomPhoto& photo = given.photos.photos[other.photo];
    WarnOfOtherView(given.files[other.photo], photo.view, states.states[static_cast<size_t>(photo.state)],
                    other.as_if_view, other.tags, findings);
  }
  WarnOfNotes(seen.registration, findings);
  RecordRegistration(seen.registration, seen.cameras, cameras, true, findings);
  RecordFurniture(seen.furniture, findings);
  PhotoNames used = all;
  used.photos.clear();
  for (const size_t photo : seen.used) used.photos.push_back(all.photos[photo]);
  RecordObserved(seen.observed, PhotosAt(given.photos, seen.used), seen.registration.views, used, findings);
  return findings;
}

bool FindsFurniture(const std::string& furniture) {
  const std::vector<std::string> known{"find", "given"};
  return IndexOf(known, furniture, "fit_room: furniture") == 0;
}

// Returns the known reflectances of the room as it was given, by the materials of the room with other furniture.
std::vector<std::optional<double>> AlbedoIn(const Room& changed, const Room& room,
                                            const std::vector<std::optional<double>>& albedo) {
  std::vector<std::optional<double>> in_changed(changed.scene.materials.size());
  for (size_t m = 0; m < in_changed.size(); ++m) {
    const auto& names = room.scene.materials;
    const auto at = std::find(names.begin(), names.end(), changed.scene.materials[m]);
    if (at != names.end()) in_changed[m] = albedo[static_cast<size_t>(at - names.begin())];
  }
  return in_changed;
}

FoundLight FitWithoutSession(const MeshRoom& room, const py::dict& states,
                             const std::vector<py::dict>& photos,
                             const std::vector<std::filesystem::path>& cameras,
                             const std::optional<std::filesystem::path>& tags,
                             const std::vector<py::dict>& readings,
                             const std::map<std::string, double>& albedo, const std::string& tag_family,
                             const std::string& furniture, int threads) {
  const StateTable names = StateTableOf(states);
  const PhotoFiles given_photos = PhotoFilesOf(photos, cameras.size(), names);
  if (!photos.empty() && !tags)
    throw std::runtime_error("fit_room: tags: expected a survey of the photos' tags");
  RoomObservations given;
  for (const std::string& id : names.luminaires) {
    given.luminaires.emplace_back();
    given.luminaires.back().luminaire.id = id;
  }
  given.dimming = names.dimming;
  given.meter.readings = ReadingsOf(readings, names);
  given.albedo = KnownAlbedo(room, albedo);
  given.luminance_weights_are_assumed = true;
  ObservePhotosOptions options;
  options.tag_family = tag_family;
  if (FindsFurniture(furniture)) {
    options.furniture = FurnitureSearch{room.mesh, room.options, {}};
    for (const MeterReading& reading : given.meter.readings)
      options.furniture->free_places.push_back(reading.sensor.position);
  }

  const py::gil_scoped_release release;
  const ThreadLimit limit(threads);
  Findings before;
  std::shared_ptr<const Room> changed;  // with the furniture that photos show
  if (!photos.empty()) {
    std::vector<Camera> lenses;
    std::vector<std::string> ids;
    for (const std::filesystem::path& camera : cameras) {
      lenses.push_back(ReadCamera(camera.string()));
      ids.push_back(camera.filename().string());
    }
    PhotoObservations seen =
        ObservePhotos(room, lenses, ReadTagMap(tags->string()), given_photos.photos, names, options);
    before = FindingsOf(seen, given_photos, ids, names);
    TakeEvidence(std::move(seen.observed.evidence), given);
    changed = seen.changed_room;
    if (changed) given.albedo = AlbedoIn(*changed, room, given.albedo);
  }
  FoundLight fitted;
  const Room& fitted_room = changed ? *changed : room;
  fitted.fit = FitRoom(fitted_room, given);
  PutFirst(std::move(before), fitted.fit.findings);
  PutCausesFirst(fitted.fit.findings.warnings);
  fitted.materials = fitted_room.scene.materials;
  fitted.luminaires = EstimatedLuminaires(fitted.fit);
  fitted.readings = PredictedReadings(fitted.fit);
  fitted.room = &fitted_room;
  fitted.changed = std::move(changed);
  return fitted;
}

Eigen::VectorXd PredictedLx(const FoundLight& fitted, double PredictedReading::*member) {
  Eigen::VectorXd numbers(static_cast<Eigen::Index>(fitted.readings.size()));
  for (Eigen::Index r = 0; r < numbers.size(); ++r) {
    const PredictedReading& reading = fitted.readings[static_cast<size_t>(r)];
    numbers[r] = reading.is_known ? reading.*member : std::numeric_limits<double>::quiet_NaN();
  }
  return numbers;
}

Eigen::VectorXd LightOfFoundRoom(const FoundLight& fitted, const RowMajorXd& position_m,
                                 const RowMajorXd& normal, const StateDimming& dimming) {
  const std::vector<Sensor> places = SensorsFrom(position_m, normal);
  const FittedScene scene = FittedSceneOf(fitted.fit.fit, fitted.fit.data);
  const Eigen::VectorXd by_luminaire = DimmingFrom(scene.luminaires, dimming);
  const py::gil_scoped_release release;
  return FittedLight(*fitted.room, scene).LightAt(places).Under(by_luminaire);
}

std::map<std::string, double> AlbedoByMaterial(const FoundLight& fitted) {
  std::map<std::string, double> albedo;
  const Eigen::VectorXd& values = fitted.fit.fit.state.albedo;
  for (Eigen::Index m = 0; m < values.size(); ++m)
    albedo[fitted.materials[static_cast<size_t>(m)]] = values[m];
  return albedo;
}

py::list WarningList(const FoundLight& fitted) {
  py::list list;
  for (const Warning& w : fitted.fit.findings.warnings)
    list.append(
        py::dict(py::arg("code") = w.code, py::arg("message") = w.message, py::arg("remedy") = w.remedy));
  return list;
}

py::list ChoiceList(const FoundLight& fitted) {
  py::list list;
  for (const Choice& c : fitted.fit.findings.choices)
    list.append(py::dict(py::arg("what") = c.what, py::arg("chosen") = c.chosen, py::arg("among") = c.among,
                         py::arg("because") = c.because));
  return list;
}

}  // namespace

void BindFit(py::module_& module) {
  py::class_<FoundLight>(
      module, "RoomFit",
      "Result of fit_room. Luminaires are those that were found, in the order of luminaire_ids; NaN "
      "where the data determine nothing.")
      .def_property_readonly(
          "luminaire_ids",
          [](const FoundLight& f) {
            std::vector<std::string> ids;
            ids.reserve(f.luminaires.size());
            for (const EstimatedLuminaire& l : f.luminaires) ids.push_back(l.id);
            return ids;
          },
          "list of K")
      .def_property_readonly(
          "position_m",
          [](const FoundLight& f) { return MemberRows(f.luminaires, &EstimatedLuminaire::position); },
          "(K, 3), world frame.")
      .def_property_readonly(
          "position_sigma_m",
          [](const FoundLight& f) { return MemberRows(f.luminaires, &EstimatedLuminaire::position_sigma_m); },
          "(K, 3)")
      .def_property_readonly(
          "flux_lm",
          [](const FoundLight& f) { return MemberColumn(f.luminaires, &EstimatedLuminaire::flux); },
          "(K,); relative where is_absolute is False.")
      .def_property_readonly(
          "flux_sigma_lm",
          [](const FoundLight& f) { return MemberColumn(f.luminaires, &EstimatedLuminaire::flux_sigma); },
          "(K,)")
      .def_property_readonly(
          "is_absolute", [](const FoundLight& f) { return f.fit.absolute; },
          "Whether a reading gives the scale, so that fluxes are in lm.")
      .def_property_readonly("albedo", &AlbedoByMaterial, "dict: reflectance of each material.")
      .def_property_readonly(
          "predicted_lx",
          [](const FoundLight& f) { return PredictedLx(f, &PredictedReading::illuminance_lx); },
          "(n,), one for each reading.")
      .def_property_readonly(
          "prediction_sigma_lx",
          [](const FoundLight& f) { return PredictedLx(f, &PredictedReading::sigma_lx); },
          "(n,): of the prediction, model error included.")
      .def("illuminance", &LightOfFoundRoom, py::arg("position_m"), py::arg("normal"), py::arg("dimming"),
           "(S,): illuminance in lx at places, as predicted_lx: with bodies and colours. position_m, normal "
           "(S, 3). "
           "dimming: {luminaire: 0 to 1}; the others are off.")
      .def_property_readonly(
          "status",
          [](const FoundLight& f) {
            return f.fit.IsUsable() && !f.fit.findings.IsUndetermined() ? "done" : "undetermined";
          },
          "done, or undetermined (see warnings).")
      .def_property_readonly("warnings", &WarningList, "dicts of code, message, remedy.")
      .def_property_readonly("choices", &ChoiceList, "dicts of what, chosen, among, because.");
  module.def("fit_room", &FitWithoutSession, py::arg("room"), py::arg("states"), py::kw_only(),
             py::arg("photos") = std::vector<py::dict>{},
             py::arg("cameras") = std::vector<std::filesystem::path>{}, py::arg("tags") = py::none(),
             py::arg("readings") = std::vector<py::dict>{},
             py::arg("albedo") = std::map<std::string, double>{}, py::arg("tag_family") = "tag36h11",
             py::arg("furniture") = "find", py::arg("threads") = 0, py::keep_alive<0, 1>(),
             "Fits luminaires and reflectances to photos and luxmeter readings, without a session file.\n\n"
             "states: {state: {luminaire: dimming 0 to 1}}. photos: dicts of file, view, state, exposure_s "
             "and camera "
             "(index of cameras, default 0); photos of one view share one pose. cameras: calibration files. "
             "tags: the "
             "survey (JSON). readings: dicts of position_m, normal, state, illuminance_lx and used (default "
             "True; False: "
             "only predicted). albedo: known reflectances by material. furniture: find (what photos show and "
             "the room lacks, or has elsewhere, takes part in the fit) or given (not looked for). Photos "
             "must be linear. Raises "
             "InputError for bad "
             "input; what the data do not determine is no exception: see status and warnings.");
}

}  // namespace luxfit
