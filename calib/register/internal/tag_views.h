// Views as the adjustment takes them, started from the tags they show.
//
// Tags seen twice in a view, tags that the survey has not, tags that more views contradict than confirm and
// views whose tags give no pose are named in `notes`.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_TAG_VIEWS_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_TAG_VIEWS_H_

#include <map>
#include <string>
#include <vector>

#include "calib/register/internal/bundle_adjustment.h"

namespace luxfit {

// By id. Throws std::invalid_argument for ids that appear twice and sizes that are not positive.
std::map<int, SurveyedTag> IndexSurvey(const std::vector<SurveyedTag>& survey);

// One inactive view per entry of `detections`, with the surveyed tags it shows.
std::vector<BundleView> ViewsOf(const BundleContext& context, const std::map<int, SurveyedTag>& survey,
                                const std::vector<ViewDetections>& detections,
                                std::vector<RegistrationNote>& notes);

// A pose for every view whose tags give one; `used` says which agree with it. A tag that hangs in two places
// (an id used twice) is used where it agrees with the survey.
void StartViews(const BundleContext& context, std::vector<BundleView>& views,
                std::vector<RegistrationNote>& notes);

// Takes back what StartViews said of a view that has a pose after all.
void DropStartNotes(const std::string& view, std::vector<RegistrationNote>& notes);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_TAG_VIEWS_H_
