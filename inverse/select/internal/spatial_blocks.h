// Cuts places into compact blocks of neighbours, from which cross-validation takes its folds.
//
// Errors of neighbouring places are alike. A place left out alone would be predicted by its neighbours,
// errors included; a whole block is not.
//
// The distinct places are cut across the longest side of their box into parts of equal size, until there are
// `blocks` blocks or one for each distinct place. Blocks are numbered in the order of the cuts, so that consecutive numbers
// adjoin: block mod folds puts neighbours into different folds.
//
// Source: Roberts et al. (2017), "Cross-validation strategies for data with temporal, spatial, hierarchical,
// or phylogenetic structure", Ecography 40.
#ifndef LUXFIT_INVERSE_SELECT_INTERNAL_SPATIAL_BLOCKS_H_
#define LUXFIT_INVERSE_SELECT_INTERNAL_SPATIAL_BLOCKS_H_

#include <Eigen/Core>
#include <vector>

namespace luxfit {

// Returns the block of each place, from 0. Equal places share a block. `places`: m.
std::vector<int> SpatialBlocks(const std::vector<Eigen::Vector3d>& places, int blocks);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_SELECT_INTERNAL_SPATIAL_BLOCKS_H_
