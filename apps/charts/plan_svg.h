// Draws a plan of the room as SVG, with everything that was found in its place.
//
// The plan is seen from above, x to the right, y up, in metres. It shows the outlines of the mesh and the
// cameras with their viewing directions. Luminaires carry size and flux, and luxmeter points the colour of
// their worst error. `result` is that of ResultJson.
#ifndef LUXFIT_APPS_CHARTS_PLAN_SVG_H_
#define LUXFIT_APPS_CHARTS_PLAN_SVG_H_

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/session/session.h"
#include "forward/room/scene.h"

namespace luxfit {

// Returns an empty text where the scene has no facet.
std::string PlanSvg(const Session& session, const Scene& scene, const nlohmann::json& result);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CHARTS_PLAN_SVG_H_
