#include "apps/python/arrays.h"

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/text/suggest.h"

namespace luxfit {

namespace py = pybind11;
using nlohmann::json;

py::object PythonFrom(const json& value) {
  switch (value.type()) {
    case json::value_t::boolean:
      return py::bool_(value.get<bool>());
    case json::value_t::number_integer:
    case json::value_t::number_unsigned:
      return py::int_(value.get<long long>());
    case json::value_t::number_float:
      return py::float_(value.get<double>());
    case json::value_t::string:
      return py::str(value.get<std::string>());
    case json::value_t::array: {
      py::list list;
      for (const json& entry : value) list.append(PythonFrom(entry));
      return list;
    }
    case json::value_t::object: {
      py::dict dict;
      for (const auto& [key, entry] : value.items()) dict[py::str(key)] = PythonFrom(entry);
      return dict;
    }
    default:
      return py::none();
  }
}

double NumberOrNan(const json& object, const std::string& key) {
  const auto found = object.find(key);
  const bool is_number = found != object.end() && found->is_number();
  return is_number ? found->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

RowMajorXd VectorRows(const json& list, const std::string& key) {
  RowMajorXd rows = RowMajorXd::Constant(static_cast<Eigen::Index>(list.size()), 3,
                                         std::numeric_limits<double>::quiet_NaN());
  for (size_t i = 0; i < list.size(); ++i) {
    const auto found = list[i].find(key);
    if (found == list[i].end() || !found->is_array() || found->size() != 3) continue;
    for (size_t axis = 0; axis < 3; ++axis) {
      if ((*found)[axis].is_number())
        rows(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(axis)) = (*found)[axis].get<double>();
    }
  }
  return rows;
}

std::vector<Sensor> SensorsFrom(const RowMajorXd& position_m, const RowMajorXd& normal) {
  if (position_m.cols() != 3 || normal.cols() != 3 || position_m.rows() != normal.rows())
    throw std::runtime_error("position_m, normal: expected two arrays of one shape (n, 3), got (" +
                             std::to_string(position_m.rows()) + ", " + std::to_string(position_m.cols()) +
                             ") and (" + std::to_string(normal.rows()) + ", " +
                             std::to_string(normal.cols()) + ")");
  std::vector<Sensor> sensors;
  sensors.reserve(static_cast<size_t>(position_m.rows()));
  for (Eigen::Index i = 0; i < position_m.rows(); ++i) {
    const Eigen::Vector3d direction = normal.row(i);
    if (!position_m.row(i).allFinite() || !direction.allFinite() || !(direction.norm() > 0))
      throw std::runtime_error(
          "position_m, normal: expected finite places and normals other than 0, got another "
          "in row " +
          std::to_string(i));
    sensors.push_back({position_m.row(i), direction.normalized()});
  }
  return sensors;
}

Eigen::VectorXd DimmingFrom(const std::vector<Luminaire>& luminaires,
                            const std::map<std::string, double>& dimming) {
  std::vector<std::string> ids;
  ids.reserve(luminaires.size());
  for (const Luminaire& luminaire : luminaires) ids.push_back(luminaire.id);
  Eigen::VectorXd by_luminaire = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(ids.size()));
  for (const auto& [id, value] : dimming) {
    const auto at = std::find(ids.begin(), ids.end(), id);
    if (at == ids.end()) throw std::runtime_error("dimming: " + ExpectedOneOf(ids, id));
    if (!(value >= 0 && value <= 1))
      throw std::runtime_error("dimming: " + id + ": expected a number from 0 to 1, got " +
                               std::to_string(value));
    by_luminaire[at - ids.begin()] = value;
  }
  return by_luminaire;
}

py::dict PatchArrays(const Patches& patches) {
  const auto n = static_cast<Eigen::Index>(patches.patches.size());
  RowMajorXd normal(n, 3);
  py::array_t<double> vertices({n, Eigen::Index{4}, Eigen::Index{3}});
  auto corner = vertices.mutable_unchecked<3>();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Patch& patch = patches.patches[static_cast<size_t>(i)];
    normal.row(i) = patch.edge_u.cross(patch.edge_v).normalized();
    const bool triangle = patches.IsTriangle(static_cast<int>(i));
    const Eigen::Vector3d last = patch.origin + patch.edge_v;
    const Eigen::Vector3d corners[] = {patch.origin, patch.origin + patch.edge_u,
                                       triangle ? last : Eigen::Vector3d(last + patch.edge_u), last};
    for (Eigen::Index c = 0; c < 4; ++c) {
      for (Eigen::Index axis = 0; axis < 3; ++axis) corner(i, c, axis) = corners[c][axis];
    }
  }
  py::dict arrays;
  arrays["center_m"] = MemberRows(patches.patches, &Patch::center);
  arrays["normal"] = normal;
  arrays["area_m2"] = MemberColumn(patches.patches, &Patch::area_m2);
  arrays["material"] = MemberColumn(patches.patches, &Patch::material);
  arrays["vertices_m"] = vertices;
  return arrays;
}

py::dict ElementArrays(const Patches& patches) {
  py::dict arrays;
  arrays["center_m"] = MemberRows(patches.elements, &Element::center);
  arrays["normal"] = MemberRows(patches.elements, &Element::normal);
  arrays["area_m2"] = MemberColumn(patches.elements, &Element::area_m2);
  arrays["patch"] = MemberColumn(patches.elements, &Element::patch);
  return arrays;
}

}  // namespace luxfit
