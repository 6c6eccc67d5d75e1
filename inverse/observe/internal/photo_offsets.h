// Estimates by how much all of a photo is brighter than other photos say: its exposure's error, a camera's gain.
//
//   g_vs = median_e (ln Y_evs - m_es),   m_es = median_v (ln Y_evs - g_vs)      until g is still
//
// Medians: fewer than half of a photo's elements may show something else. Their mean is 0 in each state, for the light
// itself may differ from state to state.
#ifndef LUXFIT_INVERSE_OBSERVE_INTERNAL_PHOTO_OFFSETS_H_
#define LUXFIT_INVERSE_OBSERVE_INTERNAL_PHOTO_OFFSETS_H_

#include <Eigen/Core>

#include "inverse/observe/internal/view_table.h"

namespace luxfit {

// Returns g, states x views; 0 for photos of which other views share fewer than 30 elements.
Eigen::ArrayXXd PhotoOffsets(const ViewTable& table);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_INTERNAL_PHOTO_OFFSETS_H_
