// Reads what ChooseLuminaireModels chose.
#ifndef LUXFIT_TESTS_SUPPORT_INVERSE_MODEL_CHOICE_H_
#define LUXFIT_TESTS_SUPPORT_INVERSE_MODEL_CHOICE_H_

#include <Eigen/Core>
#include <cmath>
#include <string>

#include "inverse/choose/internal/choose_model.h"
#include "tests/support/closed_forms.h"

namespace luxfit::support {

// Returns all scores, a line each, for messages.
inline std::string TableOf(const ModelChoice& choice) {
  std::string table;
  for (const LuminaireChoice& c : choice.choices) {
    for (size_t i = 0; i < c.among.size(); ++i) {
      table += c.among[i] + ": " + std::to_string(c.score[i]) + " +- " + std::to_string(c.standard_error[i]) +
               "\n";
    }
  }
  return table;
}

// Returns the panel's longer side, its shorter side, and the heading of the longer one in degrees from
// -90 to 90: half a turn more is the same panel.
inline Eigen::Vector3d LongShortHeading(const Luminaire& lamp) {
  const LuminaireAxes axes = AxesOf(lamp);
  const Eigen::Vector3d& along = lamp.size_m[0] > lamp.size_m[1] ? axes.along : axes.across;
  const double sign = along.x() < 0 ? -1 : 1;
  return {lamp.size_m.maxCoeff(), lamp.size_m.minCoeff(),
          std::atan2(sign * along.y(), sign * along.x()) * 180 / kPi};
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_INVERSE_MODEL_CHOICE_H_
