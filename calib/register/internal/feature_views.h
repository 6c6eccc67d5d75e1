// Joins features to the views that the tags have started.
//
// The reconstruction is put into the survey's frame, its views get poses, and its points enter the
// adjustment.
//
// Notes that the tags' start made about a view that now has a pose (no_tags, pose_ambiguous, view_disagrees)
// are withdrawn. `notes` names a reconstruction that cannot be placed (features_unaligned), and views whose
// tags give another pose than it does (features_disagree). At least two tags that agree with each other
// prevail.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_FEATURE_VIEWS_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_FEATURE_VIEWS_H_

#include <vector>

#include "calib/register/feature_model.h"
#include "calib/register/internal/bundle/bundle_adjustment.h"

namespace luxfit {

// Returns, for each view of the model, its index in `views`; drops from the model those that are not there.
std::vector<std::size_t> MatchViews(const std::vector<BundleView>& views, FeatureModel& features);

void JoinFeatures(const BundleContext& context, FeatureModel features, BundleAdjustment& adjustment,
                  std::vector<RegistrationNote>& notes);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_FEATURE_VIEWS_H_
