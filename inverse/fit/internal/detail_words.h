// Records in words how much detail a fit needs: reflections, sizes, number of elements (inverse/fit/fit_room.h).
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_DETAIL_WORDS_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_DETAIL_WORDS_H_

#include "inverse/choose/internal/detail/enough_rows.h"
#include "inverse/choose/internal/detail/scene_detail.h"
#include "inverse/fit/fit_room.h"

namespace luxfit {

// Records reflections, patches, elements and the number of elements fitted, with what coarser ones would move.
// Warns ("elements_too_coarse") where the elements' size causes more error than the rest of the model.
void RecordDetail(const SceneDetail& detail, const TakenRows& taken, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_DETAIL_WORDS_H_
