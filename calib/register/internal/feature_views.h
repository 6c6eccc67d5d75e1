// Features joined to the views that the tags have started: the reconstruction put into the survey's frame,
// its views given poses and its points handed to the adjustment.
//
// What the tags' start said of a view that now has a pose (no_tags, pose_ambiguous, view_disagrees) is taken
// back. Named in `notes`: a reconstruction that cannot be placed (features_unaligned), views whose tags say
// another pose than it (features_disagree; two tags and more that agree with each other are believed).
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_FEATURE_VIEWS_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_FEATURE_VIEWS_H_

#include <vector>

#include "calib/register/feature_model.h"
#include "calib/register/internal/bundle_adjustment.h"

namespace luxfit {

// Of each view of the model the index in `views`; those that are not there are dropped from the model.
std::vector<std::size_t> MatchViews(const std::vector<BundleView>& views, FeatureModel& features);

void JoinFeatures(const BundleContext& context, FeatureModel features, BundleAdjustment& adjustment,
                  std::vector<RegistrationNote>& notes);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_FEATURE_VIEWS_H_
