// The truth of fixtures/office as forward's types. LUXFIT_FIXTURES: the folder of the fixtures.
#ifndef LUXFIT_TESTS_SUPPORT_OFFICE_TRUTH_H_
#define LUXFIT_TESTS_SUPPORT_OFFICE_TRUTH_H_

#include <Eigen/Core>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "forward/light/room.h"
#include "forward/luminaire/luminaire.h"
#include "tests/paths.h"

namespace luxfit::support {

inline const std::string kOfficeFolder = std::string(LUXFIT_FIXTURES) + "/office/";

inline nlohmann::json OfficeTruth() {
  return nlohmann::json::parse(std::ifstream(kOfficeFolder + "truth.json"));
}

inline Eigen::Vector3d VectorOf(const nlohmann::json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

inline std::vector<std::vector<std::string>> OfficeTable(const std::string& name) {
  std::ifstream file(kOfficeFolder + name);
  if (!file) throw std::runtime_error(kOfficeFolder + name + ": expected a table, found none");
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(file, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

// Panels: flat, Lambertian, half sides u and v. Downlights: points with the intensity of cos^3.
inline Luminaire OfficeLuminaire(const nlohmann::json& json) {
  Luminaire lamp;
  lamp.id = json.at("id");
  lamp.position = VectorOf(json.at("position"));
  lamp.flux_lm = json.at("flux_lm");
  if (json.at("kind") == "panel") {
    const Eigen::Vector3d u = VectorOf(json.at("u")), v = VectorOf(json.at("v"));
    lamp.shape = LuminaireShape::kRectangle;
    lamp.heading = u.normalized();
    lamp.size_m = {2 * u.norm(), 2 * v.norm()};
  } else {
    lamp.distribution = Distribution::kCosinePower;
    lamp.cosine_exponent = 3;
  }
  return lamp;
}

// The eight points, in the order of their first readings.
inline std::vector<Sensor> OfficeSensors(const std::vector<std::vector<std::string>>& readings,
                                         size_t count) {
  std::vector<Sensor> sensors;
  for (size_t i = 1; i <= count; ++i) {
    const auto at = [&](size_t column) { return std::stod(readings.at(i).at(column)); };
    sensors.push_back({{at(1), at(2), at(3)}, {at(4), at(5), at(6)}});
  }
  return sensors;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_OFFICE_TRUTH_H_
