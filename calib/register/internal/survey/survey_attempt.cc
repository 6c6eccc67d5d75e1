#include "calib/register/internal/survey/survey_attempt.h"

#include <cmath>

#include "calib/register/internal/bundle/free_frame.h"
#include "calib/register/internal/feature_views.h"
#include "calib/register/internal/leave_out.h"
#include "calib/register/internal/survey/survey_diagnosis.h"
#include "calib/register/internal/tag_views.h"

namespace luxfit {
namespace {

// Registers with the attempt's cameras as they are.
void RegisterOnce(const SurveyEvidence& evidence, const RegisterViewsOptions& options,
                  const FeatureModel& features, SurveyAttempt& attempt) {
  const BundleContext context{attempt.cameras, options};
  attempt.adjustment = BundleAdjustment();
  for (const auto& [id, plane] : evidence.surfaces) attempt.adjustment.tags[id].surface = plane;
  attempt.notes.clear();
  attempt.adjustment.views = ViewsOf(context, evidence.survey, evidence.detections, attempt.notes);
  if (const std::optional<RegistrationNote> diagnosis =
          DiagnoseSurvey(context, evidence.survey, attempt.adjustment.views)) {
    attempt.notes.push_back(*diagnosis);
    attempt.is_refused = true;
    return;
  }
  StartViews(context, attempt.adjustment.views, attempt.notes);
  AdjustViews(context, features, attempt.adjustment, attempt.notes);
}

// Corrects the focal lengths that the attempt's tags contradict, or that earlier ones did. Returns whether
// any changed.
bool Refocus(const RegisterViewsOptions& options, SurveyAttempt& attempt) {
  const BundleContext context{attempt.cameras, options};
  bool is_changed = false;
  for (std::size_t c = 0; c < attempt.cameras.size(); ++c) {
    std::optional<FocalScale>& focal = attempt.focal[c];
    std::optional<FocalScale> its = EstimateFocalScale(context, attempt.adjustment, static_cast<int>(c));
    if (!its || (!its->IsOff() && !focal)) continue;
    if (std::abs(its->scale - 1) < its->sigma / 2) its->scale = 1;
    is_changed = is_changed || its->scale != 1;
    attempt.cameras[c] = WithFocalScale(attempt.cameras[c], its->scale);
    if (focal) its->scale *= focal->scale;
    focal = its;
  }
  return is_changed;
}

// Corrects focal lengths so far off that the survey's tags do not agree at all.
void RefocusRoughly(const SurveyEvidence& evidence, const RegisterViewsOptions& options,
                    SurveyAttempt& attempt) {
  const BundleContext context{attempt.cameras, options};
  std::vector<RegistrationNote> said_later;
  const std::vector<BundleView> views = ViewsOf(context, evidence.survey, evidence.detections, said_later);
  for (std::size_t c = 0; c < attempt.cameras.size(); ++c) {
    const double scale = FindFocalScale(context, views, static_cast<int>(c));
    if (scale == 1) continue;
    attempt.cameras[c] = WithFocalScale(attempt.cameras[c], scale);
    constexpr double kGridSigma = 0.05;
    attempt.focal[c] = FocalScale{scale, kGridSigma, {}};
  }
}

}  // namespace

SurveyAttempt RegisterBySurvey(const SurveyEvidence& evidence, const RegisterViewsOptions& options,
                               const FeatureModel& features) {
  SurveyAttempt attempt;
  attempt.cameras = evidence.cameras;
  attempt.focal.resize(evidence.cameras.size());
  RefocusRoughly(evidence, options, attempt);
  RegisterOnce(evidence, options, features, attempt);
  constexpr int kMostRounds = 4;
  for (int round = 0; round < kMostRounds; ++round) {
    if (attempt.is_refused || !Refocus(options, attempt)) break;
    RegisterOnce(evidence, options, features, attempt);
  }
  attempt.covariance = ComputeBundleCovariance({attempt.cameras, options}, attempt.adjustment);
  return attempt;
}

void AdjustViews(const BundleContext& context, const FeatureModel& features, BundleAdjustment& adjustment,
                 std::vector<RegistrationNote>& notes) {
  if (!features.views.empty()) JoinFeatures(context, features, adjustment, notes);
  SolveLeavingOut(context, adjustment, notes);
  if (adjustment.fixed_tag >= 0) SettleFrame(adjustment);
}

}  // namespace luxfit
