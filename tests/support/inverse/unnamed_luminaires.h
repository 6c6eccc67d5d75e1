// Luminaires that nobody names: all are on in every state, and their number is told by photos and readings alone.
#ifndef LUXFIT_TESTS_SUPPORT_INVERSE_UNNAMED_LUMINAIRES_H_
#define LUXFIT_TESTS_SUPPORT_INVERSE_UNNAMED_LUMINAIRES_H_

#include <Eigen/Core>
#include <string>
#include <utility>

#include "inverse/fit/fit_room.h"

namespace luxfit::support {

// Returns the observations with `count` luminaires lamp1, lamp2, ... in place of those given.
inline RoomObservations WithUnnamed(RoomObservations given, int count) {
  given.luminaires.clear();
  for (int k = 0; k < count; ++k) {
    given.luminaires.emplace_back();
    given.luminaires.back().luminaire.id = "lamp" + std::to_string(k + 1);
  }
  given.luminaires_are_named = false;
  for (Eigen::VectorXd& dimming : given.dimming) dimming = Eigen::VectorXd::Ones(count);
  return given;
}

// Returns the observations with as many as they tell.
inline RoomObservations WithCounted(const Room& model, RoomObservations given, Findings& findings) {
  given = WithUnnamed(std::move(given), 0);
  const int count = CountLuminaires(model, given, {}, findings);
  return WithUnnamed(std::move(given), count);
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_INVERSE_UNNAMED_LUMINAIRES_H_
