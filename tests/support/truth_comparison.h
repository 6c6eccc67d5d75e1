// A result.json against the truth of a rendered room.
//
// Luminaires are matched by id; reflectance by the luminance weights 0.265, 0.670, 0.065. Millimetres,
// percent. Throws nlohmann::json exceptions for files of another form.
#ifndef LUXFIT_TESTS_SUPPORT_TRUTH_COMPARISON_H_
#define LUXFIT_TESTS_SUPPORT_TRUTH_COMPARISON_H_

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace luxfit {

struct LuminaireError {
  double position_mm = 0;
  double flux_percent = 0;
};

struct TruthComparison {
  std::map<std::string, LuminaireError> luminaires;
  std::map<std::string, double> albedo_error;  // estimated materials
  std::map<std::string, double> camera_mm;     // by view
  double worst_position_mm = 0, worst_flux_percent = 0, worst_albedo = 0;
  double median_camera_mm = 0, worst_camera_mm = 0;
  int luminaires_missing = 0;  // in the truth, not in the result
};

TruthComparison CompareWithTruth(const nlohmann::json& result, const nlohmann::json& truth);

// True beside fitted values, as text.
std::string TruthTable(const nlohmann::json& result, const nlohmann::json& truth);

}  // namespace luxfit

#endif  // LUXFIT_TESTS_SUPPORT_TRUTH_COMPARISON_H_
