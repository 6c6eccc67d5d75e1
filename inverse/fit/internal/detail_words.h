// Records in words how much detail a fit needs: reflections, sizes, number of elements, ambient light (inverse/fit/fit_room.h).
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_DETAIL_WORDS_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_DETAIL_WORDS_H_

#include "inverse/choose/internal/detail/ambient_left.h"
#include "inverse/choose/internal/detail/enough_rows.h"
#include "inverse/choose/internal/detail/scene_detail.h"
#include "inverse/fit/fit_room.h"

namespace luxfit {

// Records reflections, patches, elements and the number of elements fitted, with what coarser ones would move.
// Warns ("elements_too_coarse") where the elements' size causes more error than the rest of the model.
void RecordDetail(const SceneDetail& detail, const TakenRows& taken, Findings& findings);

// Records whether photos of a state hold more or less ambient light than was subtracted, where there is some. Warns
// ("ambient_changed") where that or what views show of it (`spread`, AmbientLight::spread) is noticeable.
void RecordAmbientLeft(const AmbientLeft& left, double spread, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_DETAIL_WORDS_H_
