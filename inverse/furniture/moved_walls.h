// Finds walls, floors and ceilings that stand elsewhere than the mesh has them, by 1 to 20 cm.
//
//   o = argmin over offsets along the normal of the loss of views' differences on the plane     internal/offset_sweep.h
//   sigma^2 = jackknife over blocks of places + jackknife over views + of poses + (2 mm)^2
//
// Light falls off across a wall, and its corners, boards and tags stand out: the signatures of its places agree between
// views at its true depth only. A plane moves where
//   - |o| is 1 cm or more, and more than three sigmas, and no end of the sweep;
//   - the offset of other blocks lowers the loss of blocks left out by more than two standard errors and by a twentieth;
//   - two views or more differ less at o than at the mesh; sigma holds what their poses leave open;
//   - no surveyed tag that faces as it does lies on the mesh's plane.
// The plane with the largest gain moves first. The others are swept again in the mesh that it leaves.
//
// Metres, world frame. Only planes of the hull with flat facets are looked at (internal/hull_planes.h): not those of scans,
// nor walls with parts of the room behind them. Fewer than three views find nothing. Source: own.
#ifndef LUXFIT_INVERSE_FURNITURE_MOVED_WALLS_H_
#define LUXFIT_INVERSE_FURNITURE_MOVED_WALLS_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/targets/tags.h"
#include "forward/changes/plane_moves.h"
#include "forward/room/scene.h"
#include "inverse/furniture/signature_view.h"

namespace luxfit {

struct MovedWallsOptions {
  double tolerance = 0.015;  // of signatures: as FurnitureOptions has it
  std::vector<SurveyedTag> survey;
};

struct MovedWall {
  PlaneMove move;
  double sigma_m = 0;    // of move.by_m
  std::string material;  // of its largest facet
  double area_m2 = 0;
  int views = 0;  // that differ less there than at the mesh
  int tags = 0;   // surveyed, facing as it does, within 2 cm of where it stands
};

// Views have the same states. Returns the walls in the order in which WithPlanesMoved has to move them.
std::vector<MovedWall> FindMovedWalls(const Scene& mesh, const std::vector<SignatureView>& views,
                                      const MovedWallsOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_MOVED_WALLS_H_
