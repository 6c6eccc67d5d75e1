// Fits the office from its photos without a session file, and compares with the truth.
#ifndef LUXFIT_TESTS_SUPPORT_OFFICE_FIT_H_
#define LUXFIT_TESTS_SUPPORT_OFFICE_FIT_H_

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "forward/light/room.h"
#include "inverse/fit/fit_room.h"
#include "inverse/observe/evidence.h"
#include "tests/support/office_photos.h"
#include "tests/support/office_truth.h"

namespace luxfit::support {

// Returns L3 with everything on: what the office's own session takes for its scale.
inline MeterReading OfficeScaleReading() {
  for (const std::vector<std::string>& row : OfficeTable("luxmeter.csv")) {
    if (row[0] != "L3" || row[7] != "all") continue;
    const auto at = [&](size_t i) { return std::stod(row[i]); };
    return {{{at(1), at(2), at(3)}, {at(4), at(5), at(6)}, {}}, OfficeStateIndex("all"), at(8), 0, true, -1};
  }
  throw std::runtime_error("luxmeter.csv: expected L3 in state all");
}

inline std::vector<EstimatedLuminaire> FitOffice(const Room& room, const Evidence& evidence) {
  RoomObservations given;
  for (const char* id : {"A", "B", "C", "D"}) {
    given.luminaires.emplace_back();
    given.luminaires.back().luminaire.id = id;
  }
  given.dimming = OfficeStates().dimming;
  given.observations = evidence.observations;
  given.seen = evidence.seen;
  given.outlines = evidence.outlines;
  given.meter.readings = {OfficeScaleReading()};
  return EstimatedLuminaires(FitRoom(room, given));
}

struct OfficeError {
  double position_m = 0, flux_share = 0;  // of the worst luminaire
};

inline OfficeError WorstOfOffice(const std::vector<EstimatedLuminaire>& found) {
  OfficeError worst;
  const nlohmann::json office = OfficeTruth();
  for (const nlohmann::json& truth : office.at("lamps")) {
    const auto at = std::find_if(found.begin(), found.end(), [&](const EstimatedLuminaire& l) {
      return l.id == truth.at("id").get<std::string>();
    });
    if (at == found.end()) throw std::runtime_error("expected every luminaire of the office");
    worst.position_m = std::max(worst.position_m, (at->position - VectorOf(truth.at("position"))).norm());
    worst.flux_share = std::max(worst.flux_share, std::abs(at->flux / truth.at("flux_lm").get<double>() - 1));
  }
  return worst;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_OFFICE_FIT_H_
