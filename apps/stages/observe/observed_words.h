// Says in words what photos show beside the light: ambient light, photos and states described wrongly, and how exposures,
// vignetting, response and cameras' gains were corrected.
#ifndef LUXFIT_APPS_STAGES_OBSERVE_OBSERVED_WORDS_H_
#define LUXFIT_APPS_STAGES_OBSERVE_OBSERVED_WORDS_H_

#include <vector>

#include "apps/stages/observe/photo_names.h"
#include "inverse/fit/fit_room.h"
#include "inverse/observe/evidence.h"

namespace luxfit {

// `photos`, `names`: those that were observed. `views`: those of the registration.
void RecordObserved(const ObservedPhotos& observed, const RoomPhotos& photos,
                    const std::vector<RegisteredView>& views, const PhotoNames& names, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_OBSERVE_OBSERVED_WORDS_H_
