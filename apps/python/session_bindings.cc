#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <limits>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "apps/session/earlier_result.h"
#include "apps/session/session.h"
#include "apps/stages/session_light.h"

namespace luxfit {
namespace {

namespace py = pybind11;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

template <typename T>
py::object OrNone(const std::optional<T>& value) {
  return value ? py::cast(*value) : py::object(py::none());
}

py::object OrNone(const std::string& text) {
  return text.empty() ? py::object(py::none()) : py::object(py::str(text));
}

py::object SceneDict(const Session& session) {
  if (!session.scene) return py::none();
  py::dict dict;
  dict["mesh"] = OrNone(session.scene->mesh);
  dict["unit"] = session.scene->unit;
  dict["metres_per_unit"] = session.scene->metres_per_unit;
  dict["albedo_rgb"] = session.scene->known_albedo_rgb;
  dict["neutral"] = session.scene->neutral;
  dict["corners_m"] = py::none();
  dict["heights_m"] = py::none();
  if (!session.scene->outline) return dict;
  const RoomOutline& outline = *session.scene->outline;
  RowMajorXd corners_m(static_cast<Eigen::Index>(outline.corners_m.size()), 2);
  Eigen::VectorXd heights_m(corners_m.rows());
  for (Eigen::Index i = 0; i < corners_m.rows(); ++i) {
    corners_m.row(i) = outline.corners_m[static_cast<size_t>(i)].transpose();
    heights_m[i] = outline.heights_m[outline.heights_m.size() == 1 ? 0 : static_cast<size_t>(i)];
  }
  dict["corners_m"] = corners_m;
  dict["heights_m"] = heights_m;
  return dict;
}

py::list TagList(const Session& session) {
  py::list list;
  for (const SurveyedTag& tag : session.tags.survey) {
    py::dict dict;
    dict["id"] = tag.id;
    dict["size_m"] = tag.size_m;
    dict["center_m"] = tag.center_in_world;
    dict["normal"] = tag.normal_in_world;
    dict["up"] = tag.up_in_world;
    list.append(dict);
  }
  return list;
}

py::list CameraList(const Session& session) {
  py::list list;
  for (const SessionCamera& camera : session.cameras) {
    py::dict dict;
    dict["id"] = camera.id;
    dict["intrinsics"] = OrNone(camera.intrinsics);
    dict["response"] = camera.response_path.empty() ? camera.response : camera.response_path;
    dict["vignetting"] = camera.vignetting_path.empty() ? camera.vignetting : camera.vignetting_path;
    dict["black_level"] = camera.black_level_counts;
    dict["cdm2_per_count_s"] = camera.cdm2_per_count_s > 0 ? camera.cdm2_per_count_s : kNan;
    dict["luminance_weights"] = camera.luminance_weights;
    dict["xyz_from_rgb"] = OrNone(camera.xyz_from_rgb);
    list.append(dict);
  }
  return list;
}

py::dict PhotoColumns(const Session& session) {
  py::list file, camera, view, state;
  Eigen::VectorXd exposure_s(static_cast<Eigen::Index>(session.photos.size()));
  for (size_t i = 0; i < session.photos.size(); ++i) {
    const SessionPhoto& photo = session.photos[i];
    file.append(photo.file);
    camera.append(session.cameras[static_cast<size_t>(photo.camera)].id);
    view.append(photo.view);
    state.append(photo.state);
    exposure_s[static_cast<Eigen::Index>(i)] = photo.exposure_s > 0 ? photo.exposure_s : kNan;
  }
  py::dict dict;
  dict["file"] = file;
  dict["camera"] = camera;
  dict["view"] = view;
  dict["state"] = state;
  dict["exposure_s"] = exposure_s;
  return dict;
}

py::list LuminaireList(const Session& session) {
  py::list list;
  for (const SessionLuminaire& luminaire : session.luminaires) {
    py::dict dict;
    dict["id"] = luminaire.id;
    dict["photometry"] = luminaire.photometry_path.empty() ? luminaire.photometry : luminaire.photometry_path;
    dict["cosine_exponent"] = OrNone(luminaire.cosine_exponent);
    dict["shape"] = OrNone(luminaire.shape);
    dict["size_m"] = luminaire.size_m;
    dict["position_m"] = OrNone(luminaire.position_m);
    dict["position_sigma_m"] = OrNone(luminaire.position_sigma_m);
    dict["aim"] = OrNone(luminaire.aim);
    dict["heading"] = OrNone(luminaire.heading);
    dict["flux_lm"] = OrNone(luminaire.flux_lm);
    dict["flux_sigma_lm"] = OrNone(luminaire.flux_sigma_lm);
    list.append(dict);
  }
  return list;
}

py::dict ReadingColumns(const Session& session) {
  const auto n = static_cast<Eigen::Index>(session.luxmeter.readings.size());
  py::list id, state, role;
  RowMajorXd position(n, 3), normal(n, 3);
  Eigen::VectorXd lux(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const SessionReading& reading = session.luxmeter.readings[static_cast<size_t>(i)];
    id.append(reading.id);
    state.append(reading.state);
    role.append(ToString(reading.role));
    position.row(i) = reading.position_m;
    normal.row(i) = reading.normal;
    lux[i] = reading.is_measured ? reading.illuminance_lx : kNan;
  }
  py::dict dict;
  dict["id"] = id;
  dict["state"] = state;
  dict["role"] = role;
  dict["position_m"] = position;
  dict["normal"] = normal;
  dict["illuminance_lx"] = lux;
  return dict;
}

py::dict States(const Session& session) {
  py::dict states;
  for (const SessionState& state : session.states) states[py::str(state.id)] = py::cast(state.dimming);
  return states;
}

py::dict Groups(const Session& session) {
  py::dict groups;
  for (const SessionGroup& group : session.groups) groups[py::str(group.name)] = py::cast(group.luminaires);
  return groups;
}

RowMajorXd Dimming(const Session& session) {
  const std::vector<Eigen::VectorXd> by_state = DimmingOf(session);
  RowMajorXd dimming(static_cast<Eigen::Index>(by_state.size()),
                     static_cast<Eigen::Index>(session.luminaires.size()));
  for (size_t s = 0; s < by_state.size(); ++s) dimming.row(static_cast<Eigen::Index>(s)) = by_state[s];
  return dimming;
}

Session WithResultOf(const Session& session, const std::filesystem::path& out) {
  return WithResult(session, ResultFileOf(out.string()));
}

}  // namespace

void BindSession(py::module_& module) {
  py::class_<Session>(module, "Session",
                      "A session file and the tables it names, read and checked (read_session).")
      .def_readonly("name", &Session::name)
      .def_readonly("path", &Session::path)
      .def_property_readonly(
          "scene", &SceneDict,
          "dict: mesh (None: a size or an outline), corners_m (n, 2) and heights_m (n,) of the outline (None "
          "for a mesh), unit, metres_per_unit, albedo_rgb {material: (3,)}, neutral; None without [scene].")
      .def_property_readonly("tags", &TagList, "list of dicts: id, size_m, center_m, normal, up (3,).")
      .def_property_readonly(
          "cameras", &CameraList,
          "list of dicts: id, intrinsics, response, vignetting, black_level, cdm2_per_count_s, "
          "luminance_weights, xyz_from_rgb.")
      .def_property_readonly(
          "photos", &PhotoColumns,
          "dict of columns: file, camera, view, state (lists), exposure_s (n,), NaN where the "
          "table leaves it to the file.")
      .def_property_readonly("groups", &Groups, "{group: [luminaires]}, those that are switched together.")
      .def_property_readonly("states", &States, "{state: {luminaire: dimming 0..1}}, those that are on.")
      .def_property_readonly("dimming", &Dimming,
                             "(states, luminaires), 0..1, in the order of states and luminaires.")
      .def_property_readonly("luminaires", &LuminaireList,
                             "list of dicts: what is given of each; None for what is not.")
      .def_property_readonly(
          "readings", &ReadingColumns,
          "dict of columns: id, state, role (lists), position_m, normal (n, 3), illuminance_lx "
          "(n,), NaN where nothing was measured.")
      .def(
          "with_result", &WithResultOf, py::arg("out"),
          "The session with the luminaires and reflectances of a result (its folder or result.json), so that "
          "simulate() can take it.")
      .def("__repr__", [](const Session& s) { return "<luxfit.Session " + s.name + " " + s.path + ">"; });
  module.def(
      "read_session", [](const std::filesystem::path& path) { return ReadSession(path.string()); },
      py::arg("path"),
      "Reads a session file with all its tables. Raises InputError naming file, line and key.");
}

}  // namespace luxfit
