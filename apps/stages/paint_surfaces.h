// Writes the surfaces of like paint of a room whose mesh has no materials, `surfaces` of result.json.
#ifndef LUXFIT_APPS_STAGES_PAINT_SURFACES_H_
#define LUXFIT_APPS_STAGES_PAINT_SURFACES_H_

#include <nlohmann/json_fwd.hpp>

#include "apps/stages/stages.h"
#include "inverse/fit/fit_room.h"

namespace luxfit {

// Cuts the surfaces into segments (inverse/albedo/paint_segments.h) and records their number in `context`. Returns an empty
// list, and does nothing, where the mesh has materials, photos show nothing, or the fit ended early.
nlohmann::json PaintSurfacesJson(const Room& room, const RoomFit& fit, RunContext& context);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_PAINT_SURFACES_H_
