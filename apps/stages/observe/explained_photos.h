// Says where the session describes its photos wrongly, before anything is corrected or fitted.
//
//   photos_as_if   a photo shows the light of another state, or is encoded (inverse/observe/as_if/photos_as_if.h)
//   states_as_if   [states] says something else than the photos add up to (inverse/observe/as_if/states_as_if.h)
//
// Both are warnings, `photos_as_if` and `states_as_if` in result.json. Where the table of states is explained, the result is
// undetermined: nothing in it was changed.
#ifndef LUXFIT_APPS_STAGES_OBSERVE_EXPLAINED_PHOTOS_H_
#define LUXFIT_APPS_STAGES_OBSERVE_EXPLAINED_PHOTOS_H_

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "apps/stages/observe/photo_names.h"
#include "apps/stages/stages.h"

namespace luxfit {

// Warns of the photos that were left out. `views`: those that `found` numbers.
void WarnOfPhotos(const std::vector<PhotoAsIf>& found, const RoomPhotos& photos,
                  const std::vector<RegisteredView>& views, const PhotoNames& names, Findings& findings);

// Warns where the table of states is explained otherwise.
void WarnOfStates(const std::vector<StateExplanation>& explanations, Findings& findings);

nlohmann::json PhotosAsIfJson(const Session& session, const Registration& registration,
                              const std::vector<PhotoAsIf>& photos);
nlohmann::json StatesAsIfJson(const std::vector<StateExplanation>& explanations);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_OBSERVE_EXPLAINED_PHOTOS_H_
