// Makes the views of the adjustment, started from the tags that they show.
//
// `notes` names tags seen twice in a view, tags that the survey does not have, and tags that more views
// contradict than confirm. It also names views whose tags give no pose.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_TAG_VIEWS_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_TAG_VIEWS_H_

#include <map>
#include <string>
#include <vector>

#include "calib/register/internal/bundle/bundle_adjustment.h"

namespace luxfit {

// Returns the survey by id. Throws std::invalid_argument for ids that appear twice and sizes that are not
// positive.
std::map<int, SurveyedTag> IndexSurvey(const std::vector<SurveyedTag>& survey);

// Returns one inactive view for each entry of `detections`, with the surveyed tags it shows.
std::vector<BundleView> ViewsOf(const BundleContext& context, const std::map<int, SurveyedTag>& survey,
                                const std::vector<ViewDetections>& detections,
                                std::vector<RegistrationNote>& notes);

// Gives a pose to every view whose tags determine one; `used` marks those that agree with it. A tag that
// hangs in two places (an id used twice) is used where it agrees with the survey.
void StartViews(const BundleContext& context, std::vector<BundleView>& views,
                std::vector<RegistrationNote>& notes);

// Withdraws the notes of StartViews about a view that has a pose after all.
void DropStartNotes(const std::string& view, std::vector<RegistrationNote>& notes);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_TAG_VIEWS_H_
