// Draws a plan of the room as SVG, alone or with everything that was found in its place.
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

// All return an empty text where the scene has no facet.
//
// Draws walls and what is drawn on them as lines in a colour for each material, floor and furniture as areas,
// all with the names of their materials.
std::string RoomPlanSvg(const std::string& name, const Scene& scene);

std::string PlanSvg(const Session& session, const Scene& scene, const nlohmann::json& result);

// Draws advice of `luxfit advise` (docs/schema/advise.schema.json) in the room: cameras to come and places of the meter, with
// their ranks, beside the views that there are.
std::string AdvicePlanSvg(const std::string& name, const Scene& scene, const nlohmann::json& result,
                          const nlohmann::json& advice);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CHARTS_PLAN_SVG_H_
