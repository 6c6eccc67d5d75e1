// Checks the accuracy that a tag survey is given against the one that its tags show in the photos.
//
// Three explanations are tried, the simplest first:
//   the survey is as accurate as given, but for tags that are left out one by one;
//   one tag was moved: without it, and with all others, the survey is as accurate as given;
//   the survey is less accurate: its sigma is the variance component at which all agree.
// A survey is contradicted where its displacements are (calib/register/internal/bundle/survey_scale.h), or
// where more of its tags or views are left out than remain. The sigma is found by repeating the whole
// registration, since more tags take part under a larger one. It is never below the given sigma and at most
// 0.1 m: tags that are further off do not tell a pose.
//
// Tags alone are registered here, without features: they determine the survey's sigma, and cost little.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_SURVEY_SURVEY_CHECK_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_SURVEY_SURVEY_CHECK_H_

#include "calib/register/internal/survey/survey_attempt.h"

namespace luxfit {

struct SurveyVerdict {
  RegisterViewsOptions options;         // as given, with the sigma under which the tags agree
  SurveyEvidence evidence;              // as given, without the tag that was moved
  std::vector<RegistrationNote> notes;  // names that tag
  SurveyAttempt attempt;                // by these tags alone
};

SurveyVerdict CheckSurvey(const SurveyEvidence& evidence, const RegisterViewsOptions& options);

// Repeats the verdict's attempt until the survey's sigma is the one that its displacements show, within those
// bounds.
void SettleSurveySigma(double given_sigma_m, SurveyVerdict& verdict);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_SURVEY_SURVEY_CHECK_H_
