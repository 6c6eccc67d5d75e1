// Finds walls of a session that stand elsewhere than its mesh has them, and furniture that the mesh lacks, or has where the
// room has none (inverse/observe/room_furniture.h), and words it.
//
// Where [scene] furniture is "find", found boxes become part of the room, and pieces that views see through stand where
// views show them, or are left out. Boxes are said in a warning ("furniture_found"), in the lines of a session that would
// give them, pieces and walls in others ("furniture_moved", "wall_moved"), parts of walls that are painted otherwise in
// "paint_found". Nothing is looked for where the session has no [scene], where fewer than three views are registered, or where
// furniture is "given".
#ifndef LUXFIT_APPS_STAGES_OBSERVE_FOUND_FURNITURE_H_
#define LUXFIT_APPS_STAGES_OBSERVE_FOUND_FURNITURE_H_

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "apps/stages/stage_inputs.h"
#include "apps/stages/stages.h"
#include "inverse/observe/room_furniture.h"

namespace luxfit {

// Words what was found.
void RecordFurniture(const RevisedRoom& revised, Findings& findings);

struct KeptFurniture {
  FurnitureChange change;
  std::vector<MeshExplanation> mesh_as_if;  // where there are some, nothing was looked for
};
// Returns what differs, and keeps it for the next run as the product "furniture".
KeptFurniture FurnitureKept(const Session& session, const LinearizedPhotos& photos,
                            const RegisteredSession& registered, const Room& room,
                            const SessionInputs& inputs, RunContext& context);

// Write boxes, moves, walls and painted parts as parts of an artifact, and read them back.
nlohmann::json BoxesJson(const std::vector<RoomBox>& boxes);
std::vector<RoomBox> BoxesFromJson(const nlohmann::json& json);
nlohmann::json MovesJson(const std::vector<PieceMove>& moves);
std::vector<PieceMove> MovesFromJson(const nlohmann::json& json);
nlohmann::json WallsJson(const std::vector<PlaneMove>& walls);
std::vector<PlaneMove> WallsFromJson(const nlohmann::json& json);
nlohmann::json PartsJson(const std::vector<PaintedRectangle>& parts);
std::vector<PaintedRectangle> PartsFromJson(const nlohmann::json& json);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_OBSERVE_FOUND_FURNITURE_H_
