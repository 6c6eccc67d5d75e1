// Converts Eigen's vectors and matrices to JSON arrays and back; a matrix is a list of its rows.
//
// NaN and infinity become null; null is read as NaN. Reading throws nlohmann::json::exception where the JSON
// has another form.
#ifndef LUXFIT_APPS_TEXT_FORMATS_JSON_VECTORS_H_
#define LUXFIT_APPS_TEXT_FORMATS_JSON_VECTORS_H_

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

namespace luxfit {

nlohmann::json NumberOrNull(double value);
nlohmann::json VectorJson(const Eigen::VectorXd& vector);
nlohmann::json MatrixJson(const Eigen::MatrixXd& matrix);
Eigen::VectorXd VectorFromJson(const nlohmann::json& json);
// Reads a vector of `size` numbers; NaN throughout where the JSON is null.
Eigen::VectorXd VectorOrUnknown(const nlohmann::json& json, Eigen::Index size);
Eigen::MatrixXd MatrixFromJson(const nlohmann::json& json);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_FORMATS_JSON_VECTORS_H_
