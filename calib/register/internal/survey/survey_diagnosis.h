// Diagnoses a tag survey that the photos contradict as a whole.
//
// The survey is changed in the ways in which surveys go wrong; the change under which the views' tags agree
// is the diagnosis:
//   mirrored (a left-handed frame, two axes swapped), normals into the wall,
//   every tag turned in its plane (another library's convention of "up"),
//   all sizes wrong by one factor (another printout, another unit).
// A tag agrees if it agrees with the pose that its view's tags give (calib/register/internal/bundle/pose_start.h).
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_SURVEY_SURVEY_DIAGNOSIS_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_SURVEY_SURVEY_DIAGNOSIS_H_

#include <map>
#include <optional>
#include <vector>

#include "calib/register/internal/bundle/bundle_adjustment.h"

namespace luxfit {

// Returns the diagnosis. Returns nothing where most tags agree with the survey as it is, or no change makes
// most of them agree.
std::optional<RegistrationNote> DiagnoseSurvey(const BundleContext& context,
                                               const std::map<int, SurveyedTag>& survey,
                                               const std::vector<BundleView>& views);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_SURVEY_SURVEY_DIAGNOSIS_H_
