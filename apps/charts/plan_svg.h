// A plan of the room as SVG: what was found where, at a glance.
//
// Seen from above, x to the right, y up, metres: outlines of the mesh, cameras with their viewing direction,
// luminaires with size and flux, luxmeter points coloured by the worst error of their readings. `result` is
// that of ResultJson.
#ifndef LUXFIT_APPS_CHARTS_PLAN_SVG_H_
#define LUXFIT_APPS_CHARTS_PLAN_SVG_H_

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/session/session.h"
#include "forward/room/scene.h"

namespace luxfit {

// Empty where the scene has no facet.
std::string PlanSvg(const Session& session, const Scene& scene, const nlohmann::json& result);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CHARTS_PLAN_SVG_H_
