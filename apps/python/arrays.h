// Converts the program's values for Python: JSON to dicts and lists, lists of points to arrays.
#ifndef LUXFIT_APPS_PYTHON_ARRAYS_H_
#define LUXFIT_APPS_PYTHON_ARRAYS_H_

#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "forward/direct/sensor.h"
#include "forward/luminaire/luminaire.h"
#include "forward/room/patches.h"

namespace luxfit {

using RowMajorXd = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

pybind11::object PythonFrom(const nlohmann::json& json);

// Returns a number; NaN for null and for a missing key.
double NumberOrNan(const nlohmann::json& object, const std::string& key);
// Returns n x 3, one row for each entry of `list`; NaN as above.
RowMajorXd VectorRows(const nlohmann::json& list, const std::string& key);

// Return a member of every entry: n x 3 of vectors, (n,) of numbers.
template <typename T>
RowMajorXd MemberRows(const std::vector<T>& list, Eigen::Vector3d T::*member) {
  RowMajorXd rows(static_cast<Eigen::Index>(list.size()), 3);
  for (size_t i = 0; i < list.size(); ++i) rows.row(static_cast<Eigen::Index>(i)) = list[i].*member;
  return rows;
}
template <typename T, typename Number>
Eigen::Matrix<Number, Eigen::Dynamic, 1> MemberColumn(const std::vector<T>& list, Number T::*member) {
  Eigen::Matrix<Number, Eigen::Dynamic, 1> column(static_cast<Eigen::Index>(list.size()));
  for (size_t i = 0; i < list.size(); ++i) column[static_cast<Eigen::Index>(i)] = list[i].*member;
  return column;
}

// Makes cosine-corrected sensors from two n x 3 arrays; normals may have any length except 0. Throws
// std::runtime_error for other shapes and for values that are not finite.
std::vector<Sensor> SensorsFrom(const RowMajorXd& position_m, const RowMajorXd& normal);

// Returns the dimming of each luminaire from that of those that are on. Throws std::runtime_error for a luminaire that is
// none of these and for a dimming that is not a number from 0 to 1.
Eigen::VectorXd DimmingFrom(const std::vector<Luminaire>& luminaires,
                            const std::map<std::string, double>& dimming);

// Returns center_m, normal (n, 3), area_m2 (n,), material (n,) and vertices_m (n, 4, 3). Vertices are the
// corners in order; a triangle repeats its last one.
pybind11::dict PatchArrays(const Patches& patches);
// Returns center_m, normal, area_m2, patch (n,).
pybind11::dict ElementArrays(const Patches& patches);

}  // namespace luxfit

#endif  // LUXFIT_APPS_PYTHON_ARRAYS_H_
