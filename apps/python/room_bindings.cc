#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "apps/python/mesh_room.h"
#include "apps/python/patch_light.h"
#include "apps/session/session_scene.h"
#include "apps/text/suggest.h"
#include "forward/factors/form_factors.h"
#include "forward/light/room.h"
#include "forward/room/scene.h"
#include "inverse/model/fitted_light.h"

namespace luxfit {
namespace {

namespace py = pybind11;
using Albedo = std::map<std::string, double>;

std::vector<std::string> MethodNames() {
  std::vector<std::string> names;
  for (const FormFactorOps& ops : FormFactorMethods()) names.emplace_back(ops.name);
  return names;
}

std::unique_ptr<MeshRoom> ReadRoom(const std::filesystem::path& mesh, const std::string& unit,
                                   double patch_size_m, std::optional<double> element_size_m,
                                   const std::string& method, int rays) {
  const double metres_per_unit = MetresPerUnit(unit, "Room: unit");
  RoomOptions options;
  options.patches.patch_size_m = patch_size_m;
  options.patches.element_size_m = element_size_m.value_or(patch_size_m / 4);
  const auto known = FormFactorMethodFrom(method);
  if (!known) throw std::runtime_error("Room: method: " + ExpectedOneOf(MethodNames(), method));
  options.form_factors = {rays, *known};
  options.planes.emplace();
  options.planes->named_material = kDefaultMaterial;
  const py::gil_scoped_release release;
  Scene scene = SceneOfFile(mesh.string(), metres_per_unit);
  Room made = MakeRoom(scene, options);
  auto room = std::make_unique<MeshRoom>(MeshRoom{std::move(made), std::move(scene), options});
  if (room->sparse)
    throw std::runtime_error(mesh.string() + ": expected patches whose form factors fit into memory, got " +
                             std::to_string(room->patches.patches.size()) + "; raise patch_size_m");
  return room;
}

Eigen::VectorXd AlbedoOf(const Room& room, const Albedo& given) {
  const std::vector<std::string>& materials = room.scene.materials;
  Eigen::VectorXd albedo(static_cast<Eigen::Index>(materials.size()));
  for (size_t m = 0; m < materials.size(); ++m) {
    const auto known = given.find(materials[m]);
    if (known == given.end())
      throw std::runtime_error(
          "albedo: expected a reflectance for every material of the mesh, got none for " +
          Quoted(materials[m]));
    if (!(known->second >= 0 && known->second < 1))
      throw std::runtime_error("albedo: " + materials[m] + ": expected a number in [0, 1), got " +
                               std::to_string(known->second));
    albedo[static_cast<Eigen::Index>(m)] = known->second;
  }
  for (const auto& [name, value] : given) {
    if (std::count(materials.begin(), materials.end(), name) == 0)
      throw std::runtime_error("albedo: " + ExpectedOneOf(materials, name));
  }
  return albedo;
}

py::dict SensorLight(const MeshRoom& room, const std::vector<Luminaire>& luminaires,
                     const RowMajorXd& position_m, const RowMajorXd& normal, const Albedo& given) {
  const std::vector<Sensor> sensors = SensorsFrom(position_m, normal);
  const Eigen::VectorXd albedo = AlbedoOf(room, given);
  PlaceLight light;
  {
    const py::gil_scoped_release release;
    light = FittedLight(room, {luminaires, albedo}).LightAt(sensors);
  }
  py::dict result;
  result["illuminance_lx"] = light.total_lx;
  result["direct_lx"] = light.direct_lx;
  return result;
}

py::dict RoomPatchLight(const MeshRoom& room, const std::vector<Luminaire>& luminaires, const Albedo& given) {
  const Eigen::VectorXd albedo = AlbedoOf(room, given);
  PatchLight light;
  {
    const py::gil_scoped_release release;
    light =
        ComputePatchLight(room, luminaires, albedo.transpose().replicate<3, 1>(), Eigen::Vector3d::Ones());
  }
  py::dict result;
  result["illuminance_lx"] = light.illuminance_lx;
  result["exitance_lm_m2"] = light.exitance_lm_m2;
  return result;
}

}  // namespace

void BindRoom(py::module_& module) {
  // pybind11 copies it.
  const std::string about =
      "A mesh (OBJ, PLY: z up; glTF: y up, turned), or the room of a session file (.toml), cut into patches "
      "and elements, with its form factors: "
      "all that light needs of geometry.\n\n"
      "unit: of the mesh (m, cm, mm, in, ft). Elements (patch_size_m / 4 by default) receive light, "
      "patches send it. method: " +
      ListNames(MethodNames()) + ", with so many rays over the hemisphere of an element.";
  py::class_<MeshRoom>(module, "Room", about.c_str())
      .def(py::init(&ReadRoom), py::arg("mesh"), py::arg("unit") = "m", py::kw_only(),
           py::arg("patch_size_m") = 0.4, py::arg("element_size_m") = py::none(),
           py::arg("method") = "hybrid", py::arg("rays") = 64)
      .def_property_readonly("materials", [](const MeshRoom& r) { return r.scene.materials; })
      .def_property_readonly(
          "patches", [](const MeshRoom& r) { return PatchArrays(r.patches); },
          "dict: center_m, normal (P, 3), area_m2, material (P,) as index of materials, vertices_m (P, 4, "
          "3).")
      .def_property_readonly(
          "elements", [](const MeshRoom& r) { return ElementArrays(r.patches); },
          "dict: center_m, normal (N, 3), area_m2, patch (N,).")
      .def_property_readonly(
          "form_factors",
          [](const MeshRoom& r) -> const FormFactorMatrix& { return r.form_factors.element_to_patch; },
          py::return_value_policy::reference_internal,
          "F (N, P), float32, read-only: share of what leaves element i that reaches patch j, equally "
          "illuminance "
          "of i per exitance of j. Rows add up to 1 in a closed room.")
      .def_property_readonly(
          "closure_error", [](const MeshRoom& r) { return r.form_factors.closure_error; },
          "Root mean square of 1 - row sum before it is enforced.")
      .def("illuminance", &SensorLight, py::arg("luminaires"), py::arg("position_m"), py::arg("normal"),
           py::arg("albedo"),
           "Illuminance in lx at sensors, without bodies of luminaires (of a fit: RoomFit.illuminance): dict "
           "of illuminance_lx and direct_lx (S, K), by luminaire at its "
           "flux; "
           "light adds, so E(dimming) = illuminance_lx @ dimming. position_m, normal (S, 3); albedo: a "
           "reflectance "
           "in [0, 1) for every material.")
      .def("patch_light", &RoomPatchLight, py::arg("luminaires"), py::arg("albedo"),
           "dict of illuminance_lx and exitance_lm_m2 (P, K) of the patches; luminance in cd/m2 is exitance "
           "/ pi.");
}

}  // namespace luxfit
