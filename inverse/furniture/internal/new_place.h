// Finds where a piece of furniture that is missing in one place stands instead, near a box that views show.
//
//   d = mean of the shifts along the floor whose sum of votes (cell_judge.h) is 97 % of the largest sum and more
//
// Shifts of 2 cm are tried about those that lay the piece's side, or its middle, onto the box's, then of 1 cm.
#ifndef LUXFIT_INVERSE_FURNITURE_INTERNAL_NEW_PLACE_H_
#define LUXFIT_INVERSE_FURNITURE_INTERNAL_NEW_PLACE_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "forward/room/scene.h"
#include "inverse/furniture/furniture.h"
#include "inverse/furniture/internal/cell_judge.h"
#include "inverse/furniture/internal/room_axes.h"

namespace luxfit {

// `piece`: facets of `mesh`; `swept`: views, and what the mesh without it explains of them. None where views do not agree
// on options.least_face_m2 of the piece and 70 % of what they see of it, or where it would bury a free place.
std::optional<Eigen::Vector3d> FindNewPlace(const Scene& mesh, const std::vector<int>& piece,
                                            const SweptViews& swept, const RoomAxes& axes,
                                            const std::vector<FoundBox>& found,
                                            const FurnitureOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_INTERNAL_NEW_PLACE_H_
