#include "apps/text/formats/json_vectors.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace luxfit {

using nlohmann::json;

json NumberOrNull(double value) { return std::isfinite(value) ? json(value) : json(); }

json VectorJson(const Eigen::VectorXd& vector) {
  json list = json::array();
  for (const double value : vector) list.push_back(NumberOrNull(value));
  return list;
}

json MatrixJson(const Eigen::MatrixXd& matrix) {
  json rows = json::array();
  for (const auto row : matrix.rowwise()) rows.push_back(VectorJson(row.transpose()));
  return rows;
}

Eigen::VectorXd VectorFromJson(const json& list) {
  Eigen::VectorXd vector(static_cast<Eigen::Index>(list.size()));
  for (size_t i = 0; i < list.size(); ++i) {
    const json& value = list.at(i);
    vector[static_cast<Eigen::Index>(i)] =
        value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
  }
  return vector;
}

Eigen::VectorXd VectorOrUnknown(const json& list, Eigen::Index size) {
  if (list.is_null()) return Eigen::VectorXd::Constant(size, std::numeric_limits<double>::quiet_NaN());
  return VectorFromJson(list);
}

Eigen::MatrixXd MatrixFromJson(const json& rows) {
  if (rows.empty()) return {};
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows.size()),
                         static_cast<Eigen::Index>(rows.at(0).size()));
  for (size_t r = 0; r < rows.size(); ++r)
    matrix.row(static_cast<Eigen::Index>(r)) = VectorFromJson(rows.at(r)).transpose();
  return matrix;
}

}  // namespace luxfit
