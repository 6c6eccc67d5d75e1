// Finds what a session says that cannot be meant. `run` and `doctor` share these checks.
//
//   reading_outside      a meter place inside a solid, beyond a wall, or on the back of a surface
//                        (forward/room/in_room.h): the model gives it no direct light
//   luminaire_outside    the same of a given place of a luminaire: its light would reach nobody
//   luminaire_named_once a luminaire that one state names and nothing else, where others are named more often
//
// Readings are named with how far the nearest back of a surface before them is, or with the unit or the axis in which
// they would be inside. A luminaire counts as outside where neither its place nor 5 mm along its aim is inside: lamps
// are recessed.
#ifndef LUXFIT_APPS_STAGES_CHECK_SESSION_CHECK_H_
#define LUXFIT_APPS_STAGES_CHECK_SESSION_CHECK_H_

#include <set>
#include <vector>

#include "apps/session/session.h"
#include "forward/light/room.h"
#include "inverse/fit/fit_room.h"

namespace luxfit {

// Returns the session with places that lie up to three sigmas of a scan's surface behind it moved onto it: readings along
// their normal, given luminaires along their aim. Another room's session stays as it is.
Session OnSurfaceOf(const Room& room, Session session);

// `rays` are those of the session's mesh. Without a mesh, nothing is outside.

struct ReadingsOutside {
  std::set<int> lines;  // lines of the table of readings
  std::vector<Warning> warnings;
};
ReadingsOutside FindReadingsOutside(const Session& session, const RayScene& rays);

// Returns all of them.
struct SessionCheck {
  ReadingsOutside readings;
  std::vector<Warning> warnings;  // those of the readings included
};
SessionCheck CheckSession(const Session& session, const RayScene& rays);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_CHECK_SESSION_CHECK_H_
