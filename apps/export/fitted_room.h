// Reads a room with the light that an earlier run found in it, for report, exports, luxmap, commission and
// dim.
//
// The room is read from OUT (result.json, stages/register.json) and from the session of the run. Geometry,
// patches and reflectances are those of the fit, and luminaires those it found, so that predictions agree
// with the result. All light is FittedLight's (inverse/model/fitted_light.h).
//
// Where the fit has no absolute scale (`is_absolute` false), fluxes and illuminances are relative, in the
// unit of result.json's flux_relative.
//
// Throws std::runtime_error naming the file: no result of luxfit, one without luminaires, or a session that
// has been removed or has changed since the run.
#ifndef LUXFIT_APPS_EXPORT_FITTED_ROOM_H_
#define LUXFIT_APPS_EXPORT_FITTED_ROOM_H_

#include <Eigen/Core>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "apps/session/earlier_result.h"
#include "apps/session/session.h"
#include "apps/stages/stages.h"
#include "forward/light/room.h"
#include "inverse/model/fitted_light.h"

namespace luxfit {

struct FittedRoom {
  std::string out;                               // absolute path of the folder
  std::shared_ptr<const nlohmann::json> result;  // result.json
  Session session;                               // as written, with the luminaires that the fit found
  RegisteredSession registered;                  // empty: a fit to readings alone
  bool is_absolute = true;                       // lm and lx
  double camera_scale = 0;                       // relative luminance per cd/m2; 0: not known
  std::shared_ptr<const Room> held_room;
  std::shared_ptr<const FittedLight> light;  // in that room
  const Room& room = *held_room;
  const std::vector<Luminaire>& luminaires = light->scene().luminaires;
  const Eigen::VectorXd& albedo = light->scene().albedo;  // by material of the room, as the fit took it
};

// `session_path` replaces the one that result.json names; empty: that one. `fluxes`: which the caller can use.
FittedRoom ReadFittedRoom(const std::string& out, const std::string& session_path = "",
                          FluxUnit fluxes = FluxUnit::kAny);

// Holds the photos of a run, for callers that need neither room nor light.
struct FittedPhotos {
  std::string out;  // absolute path of the folder
  Session session;
  RegisteredSession registered;  // empty: a fit to readings alone
  double camera_scale = 0;       // as above
};
FittedPhotos ReadFittedPhotos(const std::string& out, const std::string& session_path = "");

// Makes the room of a run that still holds it and has written its result into `out`, an absolute path.
FittedRoom FittedRoomOf(const std::string& out, RegisteredSession registered, Room room);

// Returns the dimming of the luminaires in a state of the session. Throws std::runtime_error naming the known
// states.
Eigen::VectorXd DimmingOf(const FittedRoom& fitted, const std::string& state);

// Returns the state with the most light; empty without states.
std::string BrightestState(const FittedRoom& fitted);

}  // namespace luxfit

#endif  // LUXFIT_APPS_EXPORT_FITTED_ROOM_H_
