// Corrects what a session says by what its data show: `luxfit run --apply`. The file stays as the user wrote it.
//
// `corrections` of result.json holds them, so that whoever reads the session of a run again reads what was fitted.
// Metres, lx, world frame. Source: docs/session-format.md, "corrections".
#ifndef LUXFIT_APPS_SESSION_SESSION_CORRECTIONS_H_
#define LUXFIT_APPS_SESSION_SESSION_CORRECTIONS_H_

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/session/session.h"

namespace luxfit {

// Says which state the photos of a camera, a view and a state show.
struct CorrectedPhoto {
  std::string camera, view, state;  // as given
  std::string as_state;
};

struct SessionCorrections {
  std::map<std::string, std::map<std::string, double>> dimming;  // of whole states: luminaire -> 0..1
  std::vector<CorrectedPhoto> photos;
  std::vector<SessionReading> readings;  // whole rows, told by their lines
  std::optional<MeshMove> mesh;

  bool IsEmpty() const { return dimming.empty() && photos.empty() && readings.empty() && !mesh; }
};

// Throws std::invalid_argument for states and lines that the session does not have.
Session Corrected(Session session, const SessionCorrections& corrections);

nlohmann::json CorrectionsJson(const SessionCorrections& corrections);
// Throws nlohmann::json::exception where the JSON has another form. Of readings, what corrections may change.
SessionCorrections CorrectionsFromJson(const nlohmann::json& in);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_SESSION_CORRECTIONS_H_
