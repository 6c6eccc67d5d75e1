// Finds where views see something that the mesh lacks (inverse/observe/surface_labels.h), or lack what the mesh has.
//
// Furniture that the mesh lacks stands before a part of a surface. Where views show something else on more than half of what they
// show of a piece's faces, they look through it: the room lacks it.
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_UNMODELLED_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_UNMODELLED_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/fit/fit_room.h"
#include "inverse/observe/surface_labels.h"

namespace luxfit {

// Holds adjacent elements before each of which at least two views show something else.
struct UnmodelledPlace {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // of the mesh's surface behind it, m, world frame
  double area_m2 = 0;                                // of that surface
  int material = 0;                                  // that it mostly has
  int views = 0;                                     // that show something else there
  bool is_of_lacking_piece = false;                  // the mesh has furniture there that the room lacks
};

// Returns them from large to small. Fewer than four elements are left out: an edge is a pixel off in two views.
std::vector<UnmodelledPlace> FindUnmodelled(const Room& room, const SurfaceLabels& labels);

// Records in `choices` how many views of elements are left out, and warns ("unmodelled_surface") of the places.
void RecordLabels(const Room& room, const SurfaceLabels& labels, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_UNMODELLED_H_
