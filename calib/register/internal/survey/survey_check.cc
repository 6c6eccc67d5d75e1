#include "calib/register/internal/survey/survey_check.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "calib/register/internal/bundle/survey_scale.h"
#include "calib/register/internal/leave_out.h"
#include "calib/register/internal/survey/tag_place.h"

namespace luxfit {
namespace {

// Holds what an attempt says of the survey's accuracy.
struct Accuracy {
  SurveyScale scale;
  std::ptrdiff_t left_out = 0, seen = 0;               // tags
  std::ptrdiff_t registered = 0, views_with_tags = 0;  // views
  int unused = 0;  // tags that a view with a pose shows elsewhere than that pose does, each view counted
  bool is_refused = false;

  bool MostAreLeftOut() const {
    return is_refused || 2 * left_out > seen || 2 * registered < views_with_tags;
  }
  bool IsContradicted() const { return scale.IsContradicted() || MostAreLeftOut(); }
};

std::set<int> SeenTags(const SurveyEvidence& evidence) {
  std::set<int> seen;
  for (const ViewDetections& view : evidence.detections) {
    for (const TagDetection& tag : view.tags) {
      if (evidence.survey.count(tag.id) > 0) seen.insert(tag.id);
    }
  }
  return seen;
}

Accuracy AccuracyOf(const SurveyEvidence& evidence, const RegisterViewsOptions& options,
                    const SurveyAttempt& attempt) {
  Accuracy accuracy;
  accuracy.is_refused = attempt.is_refused || !attempt.adjustment.converged;
  if (accuracy.is_refused) return accuracy;
  for (const BundleView& view : attempt.adjustment.views) {
    accuracy.views_with_tags += view.tags.empty() ? 0 : 1;
    accuracy.registered += view.active ? 1 : 0;
    if (view.active) accuracy.unused += static_cast<int>(view.tags.size()) - view.TagsUsed();
  }
  accuracy.scale = EstimateSurveyScale({attempt.cameras, options}, attempt.adjustment, attempt.covariance);
  accuracy.left_out =
      std::count_if(attempt.notes.begin(), attempt.notes.end(), [](const RegistrationNote& note) {
        return note.code == TagDisagrees(0).code || note.code == "tag_duplicated";
      });
  accuracy.seen = static_cast<std::ptrdiff_t>(SeenTags(evidence).size());
  return accuracy;
}

SurveyEvidence Without(SurveyEvidence evidence, int id) {
  for (ViewDetections& view : evidence.detections) {
    view.tags.erase(std::remove_if(view.tags.begin(), view.tags.end(),
                                   [id](const TagDetection& tag) { return tag.id == id; }),
                    view.tags.end());
  }
  return evidence;
}

// Tells whether one tag may hang elsewhere, where the displacements alone do not say so: Huber's loss bounds what such
// a tag does to them. Finding out costs a registration for each tag.
bool MayHideMovedTag(const Accuracy& accuracy, const SurveyVerdict& verdict) {
  if (accuracy.is_refused) return false;
  if (accuracy.unused > 0 || accuracy.left_out > 0) return true;
  constexpr double kSuspectSigmas = 3;  // of a corner or a displacement
  const BundleContext context{verdict.attempt.cameras, verdict.options};
  const BundleAdjustment& adjustment = verdict.attempt.adjustment;
  for (const auto& [id, tag] : adjustment.tags) {
    if (tag.displacement_m.norm() > kSuspectSigmas * verdict.options.survey_sigma_m) return true;
  }
  return std::any_of(adjustment.views.begin(), adjustment.views.end(), [&](const BundleView& view) {
    const std::vector<BundleCornerError> errors =
        view.active ? BundleViewErrors(context, adjustment, view) : std::vector<BundleCornerError>();
    return std::any_of(errors.begin(), errors.end(), [&](const BundleCornerError& error) {
      return error.sigmas > kSuspectSigmas * adjustment.scale;
    });
  });
}

// Holds what a registration without one tag says of it.
struct WithoutTag {
  SurveyEvidence others;
  SurveyAttempt attempt;
  Accuracy accuracy;
  double sigmas = 0;          // of the tag off its place, by the better of both tests
  bool is_one_place = false;  // whether all views that can tell show the tag in one place
};

WithoutTag RegisterWithout(int id, const Accuracy& with_all, const SurveyEvidence& all,
                           const RegisterViewsOptions& options) {
  WithoutTag without{Without(all, id), {}, {}};
  without.attempt = RegisterBySurvey(without.others, options, {});
  without.accuracy = AccuracyOf(without.others, options, without.attempt);
  without.sigmas = std::sqrt(std::max(0.0, with_all.scale.chi2 - without.accuracy.scale.chi2));
  const std::optional<TagPlace> place =
      FindTagPlace({without.attempt.cameras, options}, without.attempt.adjustment, without.attempt.covariance,
                   all.survey.at(id), all.detections);
  without.is_one_place = place && place->IsOnePlace();
  if (without.is_one_place) without.sigmas = std::max(without.sigmas, place->Sigmas(options.survey_sigma_m));
  return without;
}

// Tells whether the survey without one tag explains the photos: all others agree with it, and the tag was as
// far off as one must be to be left out. (A chance of one in a hundred is no reason to accuse the worst tag.)
bool IsExplained(const Accuracy& with_all, const WithoutTag& without, double max_sigmas) {
  constexpr double kEnough = 3;  // determined displacements; fewer agree with anything
  const Accuracy& its = without.accuracy;
  if (its.left_out > 0 || its.IsContradicted() || its.scale.determined < kEnough) return false;
  return with_all.left_out > 0 || without.sigmas > max_sigmas;
}

// Leaves out the tag without which all others agree best, and that is furthest off its place by them, if there is one.
// A survey that is not contradicted as a whole loses a tag only if all views show that one in another place, far off:
// each tag is tested, and a chance of one in a thousand for each would accuse a right one in every hundredth survey.
bool LeaveOutMovedTag(const Accuracy& with_all, SurveyVerdict& verdict) {
  constexpr double kMovedSigmas = 6;
  const bool is_contradicted = with_all.IsContradicted();
  const double max_sigmas = is_contradicted ? verdict.options.max_view_rms_sigmas : kMovedSigmas;
  const SurveyEvidence all = verdict.evidence;
  std::optional<WithoutTag> best;
  int moved = -1;
  for (const int id : SeenTags(all)) {
    WithoutTag without = RegisterWithout(id, with_all, all, verdict.options);
    if (!is_contradicted && !without.is_one_place) continue;
    if (!IsExplained(with_all, without, max_sigmas)) continue;
    const auto rank = [](const WithoutTag& w) { return std::pair(w.accuracy.unused, -w.sigmas); };
    if (best && !(rank(without) < rank(*best))) continue;
    best = std::move(without);
    moved = id;
  }
  if (moved < 0) return false;
  verdict.attempt = std::move(best->attempt);
  verdict.evidence = std::move(best->others);
  verdict.notes.push_back(TagDisagrees(moved));
  return true;
}

}  // namespace

SurveyVerdict CheckSurvey(const SurveyEvidence& evidence, const RegisterViewsOptions& options) {
  SurveyVerdict verdict{options, evidence, {}, RegisterBySurvey(evidence, options, {})};
  if (!(options.survey_sigma_m > 0)) return verdict;
  const Accuracy accuracy = AccuracyOf(evidence, options, verdict.attempt);
  const bool is_contradicted = accuracy.IsContradicted();
  if (!is_contradicted && !MayHideMovedTag(accuracy, verdict)) return verdict;
  if (!accuracy.is_refused && LeaveOutMovedTag(accuracy, verdict)) return verdict;
  if (!is_contradicted) return verdict;
  const SurveyVerdict as_given = verdict;
  SettleSurveySigma(options.survey_sigma_m, verdict);
  // A survey that no sigma makes consistent has another fault than its accuracy.
  const Accuracy settled = AccuracyOf(verdict.evidence, verdict.options, verdict.attempt);
  // A survey that was refused for another fault must be mended wholly, by a tape's error.
  constexpr double kTapeSigma_m = 0.03;
  const bool is_mended = settled.registered == settled.views_with_tags &&
                         verdict.options.survey_sigma_m <= std::max(kTapeSigma_m, options.survey_sigma_m);
  return settled.MostAreLeftOut() || (accuracy.is_refused && !is_mended) ? as_given : verdict;
}

void SettleSurveySigma(double given_sigma_m, SurveyVerdict& verdict) {
  constexpr double kMostSigma_m = 0.1;
  constexpr double kSame = 0.05;  // relative; the estimate's own scatter is larger up to 200 displacements
  constexpr double kLeastGrowth = 3;  // where most tags are left out, the rest are those that happen to agree
  constexpr int kMostRounds = 10;
  const double most_m = std::max(given_sigma_m, kMostSigma_m);
  Accuracy accuracy = AccuracyOf(verdict.evidence, verdict.options, verdict.attempt);
  for (int round = 0; round < kMostRounds; ++round) {
    double sigma_m = std::max(accuracy.scale.sigma_m, given_sigma_m);
    if (accuracy.MostAreLeftOut()) sigma_m = std::max(sigma_m, kLeastGrowth * verdict.options.survey_sigma_m);
    sigma_m = std::min(sigma_m, most_m);
    if (std::abs(sigma_m / verdict.options.survey_sigma_m - 1) < kSame) return;
    RegisterViewsOptions options = verdict.options;
    options.survey_sigma_m = sigma_m;
    SurveyAttempt attempt = RegisterBySurvey(verdict.evidence, options, {});
    accuracy = AccuracyOf(verdict.evidence, options, attempt);
    if (!accuracy.MostAreLeftOut() && !(accuracy.scale.determined > 0)) return;
    verdict.options = options;
    verdict.attempt = std::move(attempt);
  }
}

}  // namespace luxfit
