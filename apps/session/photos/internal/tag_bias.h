// Takes out what a view makes of a tag in every state alike: its pixels cut the print at other places, and it is seen from
// another side.
//
//   b(view, tag) = n / (n + 1) median over the n groups of the view of (l_g - mean of l over groups of other views in its
//                  state),   |b| <= 0.25;   l = LightGroup::log_light; 0 for n < 3
//
// The median leaves a bias of all states, and not what a wrong state makes of one or two of them.
#ifndef LUXFIT_APPS_SESSION_PHOTOS_INTERNAL_TAG_BIAS_H_
#define LUXFIT_APPS_SESSION_PHOTOS_INTERNAL_TAG_BIAS_H_

#include <vector>

#include "apps/session/photos/internal/tag_light.h"

namespace luxfit {

// Returns the groups with l - b. `state` is that of each group. Views are corrected one after the other, each to those
// before it as they are then.
std::vector<LightGroup> WithoutTagBias(std::vector<LightGroup> groups, const std::vector<int>& state);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_PHOTOS_INTERNAL_TAG_BIAS_H_
