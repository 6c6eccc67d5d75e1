#include "apps/stages/degrade/degradation_rows.h"
#include "forward/changes/pieces.h"
#include "inverse/study/degrade.h"

namespace luxfit {
namespace {

std::optional<std::string> NeedsFurniture(const UndegradedSession& whole) {
  if (whole.observed.observations.empty() || LoosePieces(whole.prepared.room.scene).empty())
    return "the session has no photos, or its mesh no furniture";
  return std::nullopt;
}

// Observes the views again: what hid a surface no longer does.
void RemoveFaces(UndegradedSession& whole, double percent, std::mt19937_64& rng, DegradedCase& c) {
  const Scene scene = LoadMesh(whole.prepared.session).scene;
  const int pieces = static_cast<int>(LoosePieces(scene).size());
  c.own_room = MakeRoom(WithoutPieces(scene, ShareOf(percent, pieces, 0), rng));
  c.room = &*c.own_room;
  c.observed =
      Thinned(ObserveSession(c.session, c.linearized.photos, whole.prepared.registered, *c.room, c.context),
              whole.max_elements);
}

}  // namespace

Degradation FacesRemoved() {
  return {"faces_removed", "%",        "furniture missing from the mesh, %", {25, 50, 75, 100}, false,
          NeedsFurniture,  RemoveFaces};
}

}  // namespace luxfit
