// Registers views by a survey under given options: diagnosis, starts, adjustment, and focal lengths that the
// tags contradict corrected.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_SURVEY_SURVEY_ATTEMPT_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_SURVEY_SURVEY_ATTEMPT_H_

#include <map>
#include <optional>
#include <vector>

#include "calib/register/feature_model.h"
#include "calib/register/internal/bundle/bundle_adjustment.h"
#include "calib/register/internal/bundle/bundle_covariance.h"
#include "calib/register/internal/focal_check.h"

namespace luxfit {

// Holds the focal length of each camera as the tags show it; nothing: as given.
using FocalScales = std::vector<std::optional<FocalScale>>;

struct SurveyEvidence {
  std::vector<Camera> cameras;  // as given
  std::map<int, SurveyedTag> survey;
  std::vector<ViewDetections> detections;
  std::map<int, SurfacePlane> surfaces;  // of the tags that are on one, by id
};

struct SurveyAttempt {
  std::vector<Camera> cameras;  // with the focal lengths that were used
  FocalScales focal;            // relative to the cameras as given
  BundleAdjustment adjustment;
  BundleCovariance covariance;  // of the adjustment
  std::vector<RegistrationNote> notes;
  bool is_refused = false;  // the survey is contradicted as a whole; the last note says how
};

SurveyAttempt RegisterBySurvey(const SurveyEvidence& evidence, const RegisterViewsOptions& options,
                               const FeatureModel& features);

// Adjusts all views, from views that have been started. Without surveyed tags it also settles the frame.
void AdjustViews(const BundleContext& context, const FeatureModel& features, BundleAdjustment& adjustment,
                 std::vector<RegistrationNote>& notes);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_SURVEY_SURVEY_ATTEMPT_H_
