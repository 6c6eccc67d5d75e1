// Says in words what registration found: choices, and warnings of what it contradicts.
//
//   focal_length_off       tags that show another focal length than the camera's
//   photo_of_other_view    a photo whose tags are those of another view
//   and the codes of RegistrationNote
#ifndef LUXFIT_APPS_STAGES_REGISTER_REGISTRATION_WORDS_H_
#define LUXFIT_APPS_STAGES_REGISTER_REGISTRATION_WORDS_H_

#include <string>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/register/registration.h"
#include "inverse/fit/fit_room.h"

namespace luxfit {

void WarnOfNotes(const Registration& registration, Findings& findings);

// Records the survey's sigma, tags that lie on surfaces, and focal lengths that the tags contradict. `cameras`: with
// those; `camera_ids`: their names.
void RecordRegistration(const Registration& registration, const std::vector<Camera>& cameras,
                        const std::vector<std::string>& camera_ids, bool has_survey, Findings& findings);

// `name`: of the photo, as given in `view` and `state`. `tags`: number of its tags that lie in `as_if_view`.
void WarnOfOtherView(const std::string& name, const std::string& view, const std::string& state,
                     const std::string& as_if_view, int tags, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_REGISTER_REGISTRATION_WORDS_H_
