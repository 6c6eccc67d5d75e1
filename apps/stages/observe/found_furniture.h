// Finds furniture of a session that its mesh lacks (inverse/furniture/furniture.h), and words it.
//
// The boxes become part of the room where [scene] furniture is "find". Each is said in a warning
// ("furniture_found"), in the lines of a session that would give it. Boxes are not found where the session has no
// [scene], where fewer than three views are registered, or where furniture is "given".
#ifndef LUXFIT_APPS_STAGES_OBSERVE_FOUND_FURNITURE_H_
#define LUXFIT_APPS_STAGES_OBSERVE_FOUND_FURNITURE_H_

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "apps/stages/stage_inputs.h"
#include "apps/stages/stages.h"
#include "forward/room/outline.h"

namespace luxfit {

// Returns the boxes, and keeps them for the next run as the product "furniture".
std::vector<RoomBox> FurnitureKept(const Session& session, const LinearizedPhotos& photos,
                                   const RegisteredSession& registered, const Room& room,
                                   const SessionInputs& inputs, RunContext& context);

// Write boxes as a part of an artifact, and read them back.
nlohmann::json BoxesJson(const std::vector<RoomBox>& boxes);
std::vector<RoomBox> BoxesFromJson(const nlohmann::json& json);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_OBSERVE_FOUND_FURNITURE_H_
