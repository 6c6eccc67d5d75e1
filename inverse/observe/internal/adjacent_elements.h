// Finds neighbours: adjacent elements of the mesh, and what a photo shows side by side.
//
// Two elements are adjacent where their centres are no further apart than 1.25 times the larger one's edge: neighbours
// of a grid, also across an edge of the room.
#ifndef LUXFIT_INVERSE_OBSERVE_INTERNAL_ADJACENT_ELEMENTS_H_
#define LUXFIT_INVERSE_OBSERVE_INTERNAL_ADJACENT_ELEMENTS_H_

#include <utility>
#include <vector>

#include "forward/light/room.h"
#include "inverse/observe/internal/view_table.h"

namespace luxfit {

// Returns all pairs of adjacent elements of `elements` once, as places in that list.
std::vector<std::pair<int, int>> AdjacentElements(const Room& room, const std::vector<int>& elements);

// Returns by column its neighbours: columns of the same view and adjacent elements.
std::vector<std::vector<int>> AdjacentColumns(const Room& room, const ViewTable& table);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_INTERNAL_ADJACENT_ELEMENTS_H_
