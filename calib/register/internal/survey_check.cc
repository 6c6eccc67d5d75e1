#include "calib/register/internal/survey_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "calib/register/internal/bundle/survey_scale.h"
#include "calib/register/internal/leave_out.h"

namespace luxfit {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

// Holds what an attempt says of the survey's accuracy.
struct Accuracy {
  SurveyScale scale;
  std::ptrdiff_t left_out = 0, seen = 0;               // tags
  std::ptrdiff_t registered = 0, views_with_tags = 0;  // views
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

// Returns the tags that may be the one that was moved: those left out, then those furthest off their places.
std::vector<int> Suspects(const SurveyEvidence& evidence, const SurveyAttempt& attempt) {
  std::vector<std::pair<double, int>> by_distance;
  for (const int id : SeenTags(evidence)) {
    const bool is_left_out =
        std::any_of(attempt.notes.begin(), attempt.notes.end(), [id](const RegistrationNote& note) {
          return note.tag_id == id && note.code == TagDisagrees(id).code;
        });
    const auto hung = attempt.adjustment.tags.find(id);
    const double off_m = hung == attempt.adjustment.tags.end() ? 0 : hung->second.displacement_m.norm();
    by_distance.emplace_back(is_left_out ? -kFar : -off_m, id);
  }
  std::sort(by_distance.begin(), by_distance.end());
  constexpr std::size_t kMost = 16;  // the moved one is among the first few
  if (by_distance.size() > kMost) by_distance.resize(kMost);
  std::vector<int> suspects;
  suspects.reserve(by_distance.size());
  for (const auto& [distance, id] : by_distance) suspects.push_back(id);
  return suspects;
}

// Tells whether the survey without one tag explains the photos: all others agree with it, and the tag was as
// far off as one must be to be left out. (A chance of one in a hundred is no reason to accuse the worst tag.)
bool IsExplained(const Accuracy& with_all, const Accuracy& without, double max_sigmas) {
  constexpr double kEnough = 3;  // determined displacements; fewer agree with anything
  if (without.left_out > 0 || without.IsContradicted() || without.scale.determined < kEnough) return false;
  return with_all.left_out > 0 || with_all.scale.chi2 - without.scale.chi2 > max_sigmas * max_sigmas;
}

// Leaves out the tag without which all others agree with the survey best, if there is one.
bool LeaveOutMovedTag(const Accuracy& with_all, SurveyVerdict& verdict) {
  const SurveyEvidence all = verdict.evidence;
  const std::vector<int> suspects = Suspects(all, verdict.attempt);
  double least = kFar;
  int moved = -1;
  for (const int id : suspects) {
    const SurveyEvidence others = Without(all, id);
    SurveyAttempt attempt = RegisterBySurvey(others, verdict.options, {});
    const Accuracy accuracy = AccuracyOf(others, verdict.options, attempt);
    if (!IsExplained(with_all, accuracy, verdict.options.max_view_rms_sigmas)) continue;
    const double ratio = accuracy.scale.chi2 / accuracy.scale.determined;
    if (ratio >= least) continue;
    least = ratio;
    moved = id;
    verdict.attempt = std::move(attempt);
    verdict.evidence = others;
  }
  if (moved < 0) return false;
  verdict.notes.push_back(TagDisagrees(moved));
  return true;
}

}  // namespace

SurveyVerdict CheckSurvey(const SurveyEvidence& evidence, const RegisterViewsOptions& options) {
  SurveyVerdict verdict{options, evidence, {}, RegisterBySurvey(evidence, options, {})};
  if (!(options.survey_sigma_m > 0)) return verdict;
  const Accuracy accuracy = AccuracyOf(evidence, options, verdict.attempt);
  if (!accuracy.IsContradicted()) return verdict;
  if (!accuracy.is_refused && LeaveOutMovedTag(accuracy, verdict)) return verdict;
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
