#include "inverse/advise/advise.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "inverse/advise/information.h"
#include "inverse/advise/internal/asked_quantities.h"
#include "inverse/advise/internal/candidate_information.h"
#include "inverse/advise/internal/placed_luminaires.h"
#include "inverse/advise/internal/prior_knowledge.h"

namespace luxfit {
namespace {

// Returns the largest relative reduction of the rms of a kind's sigmas.
double GainOf(const std::vector<SigmaChange>& changes) {
  double gain = 0;
  for (const AdviceKind kind : {AdviceKind::kFlux, AdviceKind::kPosition, AdviceKind::kReading}) {
    double before = 0, after = 0;
    for (const SigmaChange& change : changes) {
      if (change.of.kind != kind) continue;
      before += change.before * change.before;
      after += change.after * change.after;
    }
    if (before > 0) gain = std::max(gain, 1 - std::sqrt(after / before));
  }
  return gain;
}

bool IsNewlyDetermined(const SigmaChange& change) { return change.is_determined && !change.was_determined; }

// Returns how many quantities become determined.
int NewlyDetermined(const AdviceStep& step) {
  return static_cast<int>(std::count_if(step.changes.begin(), step.changes.end(), IsNewlyDetermined));
}

// Takes candidates one by one, the best first.
class Adviser {
 public:
  Adviser(const Room& room, const AdviceGiven& given, const AdviceOptions& options)
      : given_(given),
        options_(options),
        known_(KnowledgeOf(room, given)),
        information_(room, given, known_),
        asked_(known_, given.is_absolute, options),
        root_(CovarianceRoot(known_.covariance)),
        placed_(given, known_) {
    placed_.Update(root_);
    for (size_t r = 0; r < given.predicted.size(); ++r)
      asked_.AddReading(known_, given.predicted[r].id, information_.DerivativeOfPredicted(r));
    const std::vector<double> sigmas =
        asked_.Sigmas(root_, Eigen::MatrixXd::Zero(root_.rows(), root_.rows()));
    for (size_t q = 0; q < asked_.size(); ++q)
      now_.push_back({asked_.Of(q), sigmas[q], sigmas[q], asked_.IsDetermined(q), asked_.IsDetermined(q)});
  }

  AdvicePlan Plan() {
    AdvicePlan plan;
    plan.now = now_;
    plan.ignored = known_.ignored;
    while (static_cast<int>(plan.steps.size()) < options_.count) {
      const std::optional<AdviceStep> step = BestStep();
      plan.is_enough = !step;
      if (!step) break;
      Accept(*step);
      plan.steps.push_back(*step);
    }
    return plan;
  }

 private:
  Eigen::MatrixXd InformationOf(const AdviceStep& step) const {
    return step.is_photo ? information_.OfPhoto(given_.photos[step.candidate])
                         : information_.OfReading(step.candidate);
  }

  AdviceStep StepOf(bool is_photo, size_t candidate) const {
    AdviceStep step;
    step.is_photo = is_photo;
    step.candidate = candidate;
    const std::vector<double> sigmas = asked_.Sigmas(root_, InformationOf(step));
    std::pair<bool, double> best{false, -1};
    for (size_t q = 0; q < now_.size(); ++q) {
      SigmaChange change = now_[q];
      change.before = now_[q].after;
      change.after = sigmas[q];
      change.was_determined = now_[q].is_determined;
      const bool is_place = change.of.kind == AdviceKind::kPosition;
      change.is_determined =
          change.was_determined ||
          (IsKnownSigma(change.after) && (!is_place || placed_.HasStands(change.of.owner, PhotoOf(step))));
      const double reduction = change.before > 0 ? 1 - change.after / change.before : 0;
      const std::pair help(IsNewlyDetermined(change), reduction);
      if (help > best) step.helped = change;
      best = std::max(best, help);
      step.changes.push_back(change);
    }
    step.gain = GainOf(step.changes);
    return step;
  }

  // Returns the photo of a step; null: it is a reading.
  const PhotoCandidate* PhotoOf(const AdviceStep& step) const {
    return step.is_photo ? &given_.photos[step.candidate] : nullptr;
  }

  // Returns whether a luminaire without a place has its light photographed from a first or second stand.
  bool PlacesMore(const AdviceStep& step) const {
    const PhotoCandidate* const photo = PhotoOf(step);
    return photo != nullptr && placed_.StandsGained(*photo) > 0 && step.gain > 0;
  }

  // Ranks a step, the greatest first.
  std::tuple<int, int, double> RankOf(const AdviceStep& step) const {
    const PhotoCandidate* const photo = PhotoOf(step);
    return {photo == nullptr ? 0 : placed_.StandsGained(*photo), NewlyDetermined(step), step.gain};
  }

  // Returns nothing where no candidate helps. Photos that do not name luminaires are tried last.
  std::optional<AdviceStep> BestStep() const {
    std::vector<AdviceStep> named, unnamed;
    for (size_t i = 0; i < given_.photos.size() + given_.readings.size(); ++i) {
      AdviceStep step;
      step.is_photo = i < given_.photos.size();
      step.candidate = step.is_photo ? i : i - given_.photos.size();
      const bool is_unnamed = step.is_photo && placed_.IsUnnamedIn(given_.photos[i].state);
      (is_unnamed ? unnamed : named).push_back(step);
    }
    const std::optional<AdviceStep> best = BestOf(std::move(named));
    return best ? best : BestOf(std::move(unnamed));
  }

  std::optional<AdviceStep> BestOf(std::vector<AdviceStep> steps) const {
    tbb::parallel_for(size_t{0}, steps.size(),
                      [&](size_t i) { steps[i] = StepOf(steps[i].is_photo, steps[i].candidate); });
    const AdviceStep* best = nullptr;
    for (const AdviceStep& step : steps) {
      const bool helps = IsNewlyDetermined(step.helped) ||
                         step.helped.after < (1 - options_.least_gain) * step.helped.before;
      if ((helps || PlacesMore(step)) && (best == nullptr || RankOf(step) > RankOf(*best))) best = &step;
    }
    return best == nullptr ? std::nullopt : std::optional(*best);
  }

  void Accept(const AdviceStep& step) {
    root_ = CovarianceRoot(CovarianceWith(root_, InformationOf(step)));
    if (step.is_photo) information_.TakePhoto(given_.photos[step.candidate]);
    if (step.is_photo) placed_.Take(given_.photos[step.candidate]);
    placed_.Update(root_);
    if (!step.is_photo) information_.TakeReading(step.candidate);
    now_ = step.changes;
  }

  const AdviceGiven& given_;
  const AdviceOptions& options_;
  const PriorKnowledge known_;
  CandidateInformation information_;
  AskedQuantities asked_;
  Eigen::MatrixXd root_;  // of the covariance as of now
  PlacedLuminaires placed_;
  std::vector<SigmaChange> now_;
};

}  // namespace

std::vector<AdviceQuantity> AdvicePlan::Undetermined() const {
  std::vector<AdviceQuantity> undetermined;
  for (const SigmaChange& change : steps.empty() ? now : steps.back().changes)
    if (!change.is_determined) undetermined.push_back(change.of);
  return undetermined;
}

AdvicePlan Advise(const Room& room, const AdviceGiven& given, const AdviceOptions& options) {
  return Adviser(room, given, options).Plan();
}

}  // namespace luxfit
