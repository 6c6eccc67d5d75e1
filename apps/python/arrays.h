// What Python gets of the program's values: JSON as dicts and lists, lists of points as arrays.
#ifndef LUXFIT_APPS_PYTHON_ARRAYS_H_
#define LUXFIT_APPS_PYTHON_ARRAYS_H_

#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "forward/direct/sensor.h"
#include "forward/room/patches.h"

namespace luxfit {

using RowMajorXd = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

pybind11::object PythonFrom(const nlohmann::json& json);

// A number; NaN for null and for what is not there.
double NumberOrNan(const nlohmann::json& object, const std::string& key);
// n x 3, a row an entry of `list`; NaN likewise.
RowMajorXd VectorRows(const nlohmann::json& list, const std::string& key);

// Cosine-corrected sensors from two n x 3 arrays, the normals of any length but 0. Throws std::runtime_error
// for other shapes and for what is not finite.
std::vector<Sensor> SensorsFrom(const RowMajorXd& position_m, const RowMajorXd& normal);

// center_m, normal (n, 3), area_m2 (n,), material (n,), vertices_m (n, 4, 3): the corners in turn, the last
// one twice where the patch is a triangle.
pybind11::dict PatchArrays(const Patches& patches);
// center_m, normal, area_m2, patch (n,).
pybind11::dict ElementArrays(const Patches& patches);

}  // namespace luxfit

#endif  // LUXFIT_APPS_PYTHON_ARRAYS_H_
