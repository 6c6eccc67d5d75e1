// Describes one way to make a session worse, level by level: a row of the table in
// apps/stages/degrade/degradations.cc.
//
// A new degradation is one file that makes its row (such as apps/stages/degrade/degrade_survey.cc) and the
// row's line in the table.
#ifndef LUXFIT_APPS_STAGES_DEGRADE_DEGRADATION_H_
#define LUXFIT_APPS_STAGES_DEGRADE_DEGRADATION_H_

#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "apps/stages/prepared_session.h"
#include "apps/stages/register/view_tags.h"
#include "inverse/study/simulated_light.h"

namespace luxfit {

// The session that is made worse, its fit, and what several trials share.
struct UndegradedSession {
  const PreparedSession& prepared;
  int max_elements = 0;  // used by every fit
  Evidence observed;     // of that many elements
  Refit refit;
  std::vector<EstimatedLuminaire> truth;
  std::optional<std::vector<ViewDetections>> detections;         // of tags, once
  std::map<std::pair<std::string, double>, TracedLight> traced;  // by degradation and level
};

// One trial: starts as a copy of the undegraded session.
struct DegradedCase {
  Session session;
  LinearizedSession linearized;
  const Room* room = nullptr;
  std::optional<Room> own_room;  // where the mesh itself is degraded; `room` points to it
  Evidence observed;
  std::vector<EstimatedLuminaire> truth;
  RunContext context;  // warnings of observing again
};

struct Degradation {
  std::string name, unit, axis;  // `axis` labels a picture and contains the unit
  std::vector<double> levels;    // from harmless to bad
  bool is_log = true;            // how the levels are spaced
  // Says why the session does not allow it; nothing where it does.
  std::optional<std::string> (*why_not)(const UndegradedSession& whole) = nullptr;
  void (*apply)(UndegradedSession& whole, double level, std::mt19937_64& rng, DegradedCase& c) = nullptr;
};

// `percent` of `count`, rounded, at least one, and never so many that fewer than `left` remain.
int ShareOf(double percent, int count, int left);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_DEGRADE_DEGRADATION_H_
