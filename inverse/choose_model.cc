#include "inverse/choose_model.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

namespace luxfit {
namespace {

constexpr int kFolds = 5;

const std::vector<ModelCandidate>& AllCandidates() {
  using D = Distribution;
  using S = LuminaireShape;
  static const std::vector<ModelCandidate> candidates = {
      {D::kIsotropic, S::kPoint, 0, "isotropic point"},
      {D::kLambertian, S::kPoint, 0, "lambertian point"},
      {D::kCosinePower, S::kPoint, 1, "cosine_power point"},
      {D::kLambertian, S::kDisc, 1, "lambertian disc"},
      {D::kCosinePower, S::kDisc, 2, "cosine_power disc"},
      {D::kLambertian, S::kRectangle, 2, "lambertian rectangle"},
      {D::kCosinePower, S::kRectangle, 3, "cosine_power rectangle"}};
  return candidates;
}

bool Allowed(const ModelCandidate& candidate, const Luminaire& luminaire, const OpenChoice& open) {
  return (open.distribution || candidate.distribution == luminaire.distribution) &&
         (open.shape || candidate.shape == luminaire.shape);
}

// Turning a point that shines alike everywhere changes nothing.
bool HasAim(const ModelCandidate& candidate) {
  return candidate.distribution != Distribution::kIsotropic || candidate.shape != LuminaireShape::kPoint;
}

void Apply(const ModelCandidate& candidate, bool aim_is_free, double start_size_m, Luminaire& luminaire,
           FreeQuantities& free) {
  const bool grows = candidate.shape != LuminaireShape::kPoint && luminaire.shape == LuminaireShape::kPoint;
  luminaire.distribution = candidate.distribution;
  luminaire.shape = candidate.shape;
  if (grows) luminaire.size_m.setConstant(start_size_m);
  if (candidate.shape == LuminaireShape::kDisc) luminaire.size_m[1] = luminaire.size_m[0];
  free.exponent = candidate.distribution == Distribution::kCosinePower;
  free.size = candidate.shape != LuminaireShape::kPoint;
  free.tilt = aim_is_free && HasAim(candidate);
}

// Spreads consecutive groups over the folds, so that every part of the room keeps most of its data.
bool LeftOut(int group) { return group % kFolds == 2; }

// One luminaire's own problem: the data that speak of it, cut into what is fitted and what is left out.
struct SubProblem {
  LightState state;
  int luminaire = 0;  // its index in `state`
  LightData all, fit;
  std::vector<int> group_of_row;  // of `all`: facet, or reading
  std::vector<bool> left_out;     // of `all`
  std::vector<ParameterPrior> priors;
};

bool OnAlone(const Eigen::VectorXd& dimming, int luminaire) {
  return dimming[luminaire] > 0 && dimming.sum() == dimming[luminaire];
}

LightState AloneOrOthersHeld(const LightState& start, int luminaire, bool alone) {
  LightState state = start;
  state.albedo_free.assign(state.albedo_free.size(), false);
  state.camera_scale_free = false;
  state.meter_scale_free = false;
  const size_t k = static_cast<size_t>(luminaire);
  if (alone) {
    state.luminaires = {start.luminaires[k]};
    state.free = {start.free[k]};
  } else {
    for (size_t j = 0; j < state.free.size(); ++j) {
      if (j != k) state.free[j] = {false, false, false, false, false};
    }
  }
  return state;
}

void AddObservations(const Room& room, const LightData& data, const std::vector<bool>& state_used,
                     int max_elements, SubProblem& problem) {
  std::vector<Observation> own;
  for (const Observation& o : data.observations) {
    if (state_used[static_cast<size_t>(o.state)]) own.push_back(o);
  }
  for (const Observation& o : ThinElements(own, max_elements)) {
    const int patch = room.patches.elements[static_cast<size_t>(o.element)].patch;
    problem.all.observations.push_back(o);
    problem.group_of_row.push_back(room.patches.patches[static_cast<size_t>(patch)].facet);
    problem.left_out.push_back(LeftOut(patch));
    if (!LeftOut(patch)) problem.fit.observations.push_back(o);
  }
}

void AddReadings(const LightData& data, const std::vector<bool>& state_used, SubProblem& problem) {
  for (size_t i = 0; i < data.readings.size(); ++i) {
    Reading reading = data.readings[i];
    if (!state_used[static_cast<size_t>(reading.state)] || !reading.used) continue;
    const int group = static_cast<int>(problem.all.readings.size());
    const bool out = LeftOut(group);
    problem.all.readings.push_back(reading);
    problem.group_of_row.push_back(group);
    problem.left_out.push_back(out);
    reading.used = !out;
    problem.fit.readings.push_back(reading);
  }
}

SubProblem MakeSubProblem(const Room& room, const LightData& data, const LightState& start, int luminaire,
                          const std::vector<ParameterPrior>& priors, int max_elements) {
  SubProblem problem;
  const auto is_alone = [&](int state) {
    return OnAlone(data.dimming[static_cast<size_t>(state)], luminaire);
  };
  const bool photos = !data.observations.empty();
  const bool alone = photos ? std::any_of(data.observations.begin(), data.observations.end(),
                                          [&](const Observation& o) { return is_alone(o.state); })
                            : std::any_of(data.readings.begin(), data.readings.end(),
                                          [&](const Reading& r) { return r.used && is_alone(r.state); });
  problem.state = AloneOrOthersHeld(start, luminaire, alone);
  problem.luminaire = alone ? 0 : luminaire;
  std::vector<bool> state_used;
  for (const Eigen::VectorXd& dimming : data.dimming) {
    state_used.push_back(alone ? OnAlone(dimming, luminaire) : dimming[luminaire] > 0);
    problem.all.dimming.push_back(alone ? Eigen::VectorXd::Constant(1, dimming[luminaire]).eval() : dimming);
  }
  problem.fit.dimming = problem.all.dimming;
  if (photos) {
    AddObservations(room, data, state_used, max_elements, problem);
  } else {
    AddReadings(data, state_used, problem);
  }
  for (ParameterPrior prior : priors) {
    if (prior.kind != ParameterKind::kLuminaire && prior.kind != ParameterKind::kLogFlux) continue;
    if (prior.index != luminaire) continue;
    prior.index = problem.luminaire;
    problem.priors.push_back(prior);
  }
  return problem;
}

double ValueOf(const LightData& data, size_t row) {
  return row < data.observations.size() ? data.observations[row].relative_luminance
                                        : data.readings[row - data.observations.size()].illuminance_lx;
}

struct GroupScore {
  double sum = 0;
  int count = 0;
};

// By group: sum of min(z^2, 9) over the rows left out.
std::map<int, GroupScore> ScoreGroups(const SubProblem& problem, const Eigen::VectorXd& predicted,
                                      double relative_sigma) {
  std::map<int, GroupScore> scores;
  for (size_t i = 0; i < problem.left_out.size(); ++i) {
    if (!problem.left_out[i]) continue;
    const double value = ValueOf(problem.all, i);
    double variance = std::pow(relative_sigma * value, 2);
    if (i < problem.all.observations.size()) variance += problem.all.observations[i].variance;
    const double z = (predicted[static_cast<Eigen::Index>(i)] - value) / std::sqrt(variance);
    GroupScore& score = scores[problem.group_of_row[i]];
    score.sum += std::min(z * z, 9.0);
    ++score.count;
  }
  return scores;
}

struct PairedDifference {
  double mean = 0, standard_error = 0;
};

// Mean over rows of a - b, with the standard error of a mean over groups weighted by their rows.
PairedDifference Difference(const std::map<int, GroupScore>& a, const std::map<int, GroupScore>& b) {
  double total = 0;
  PairedDifference result;
  for (const auto& [group, score] : a) {
    total += score.count;
    result.mean += score.sum - b.at(group).sum;
  }
  result.mean /= total;
  double squares = 0;
  for (const auto& [group, score] : a)
    squares += std::pow(score.sum - b.at(group).sum - score.count * result.mean, 2);
  const double groups = static_cast<double>(a.size());
  if (groups > 1) result.standard_error = std::sqrt(squares * groups / (groups - 1)) / total;
  return result;
}

double Mean(const std::map<int, GroupScore>& scores) {
  GroupScore all;
  for (const auto& [group, score] : scores) all = {all.sum + score.sum, all.count + score.count};
  return all.sum / all.count;
}

LuminaireChoice Choose(int luminaire, const std::vector<int>& candidates,
                       const std::vector<std::map<int, GroupScore>>& scores) {
  LuminaireChoice choice;
  choice.luminaire = luminaire;
  size_t best = 0;
  for (size_t c = 0; c < candidates.size(); ++c) {
    choice.among.push_back(AllCandidates()[static_cast<size_t>(candidates[c])].name);
    choice.score.push_back(Mean(scores[c]));
    if (choice.score[c] < choice.score[best]) best = c;
  }
  choice.chosen = static_cast<int>(best);
  for (size_t c = 0; c < candidates.size(); ++c) {
    const PairedDifference difference = Difference(scores[c], scores[best]);
    choice.standard_error.push_back(difference.standard_error);
    // Candidates stand in the order of their complexity; among equals the better.
    const auto parameters = [&](size_t i) {
      return AllCandidates()[static_cast<size_t>(candidates[i])].parameters;
    };
    const size_t held = static_cast<size_t>(choice.chosen);
    const bool simpler = parameters(c) < parameters(held) ||
                         (parameters(c) == parameters(held) && choice.score[c] < choice.score[held]);
    if (difference.mean <= difference.standard_error && simpler) choice.chosen = static_cast<int>(c);
  }
  return choice;
}

struct FittedCandidate {
  int candidate = 0;
  bool aim_is_free = false;
  Luminaire luminaire;
  Eigen::VectorXd predicted;  // rows of SubProblem::all
  double relative_sigma = 1;
};

FittedCandidate FitCandidate(const Room& room, const SubProblem& problem, int index, bool aim_is_free,
                             const ChooseModelOptions& options) {
  const ModelCandidate& candidate = AllCandidates()[static_cast<size_t>(index)];
  const size_t k = static_cast<size_t>(problem.luminaire);
  LightState state = problem.state;
  Apply(candidate, aim_is_free, options.start_size_m, state.luminaires[k], state.free[k]);
  FitLuminairesOptions fit_options;
  fit_options.covariance = false;
  fit_options.max_outer_iterations = options.max_outer_iterations;
  fit_options.max_inner_iterations = options.max_inner_iterations;
  fit_options.visibility_order = 2;
  const LuminaireFit fit = FitLuminaires(room, problem.fit, state, problem.priors, fit_options);
  LightModel model(room, problem.all);
  model.FreezeVisibility(fit.state, fit_options.visibility_order);
  return {index, aim_is_free, fit.state.luminaires[k], model.Predict(fit.state, {}, false).value,
          fit.relative_sigma};
}

bool HasVanished(const Luminaire& luminaire) {
  constexpr double kVanishedM = 0.01;
  if (luminaire.shape == LuminaireShape::kRectangle) return luminaire.size_m.minCoeff() < kVanishedM;
  return luminaire.shape == LuminaireShape::kDisc && luminaire.size_m[0] < kVanishedM;
}

constexpr double kGoodPoint =
    0.01;  // model error of a point that a size could hardly better; luxmeters read to 3 %

// Where a point explains the light that well and discs brought nothing over points, rectangles are not tried.
// Discs alone do not tell: a long panel is no better a disc than a point.
bool SizeDoesNotMatter(const SubProblem& problem, const std::vector<FittedCandidate>& fitted,
                       double relative_sigma, const ModelCandidate& next) {
  if (next.shape != LuminaireShape::kRectangle) return false;
  const FittedCandidate *point = nullptr, *disc = nullptr;
  for (const FittedCandidate& f : fitted) {
    const ModelCandidate& c = AllCandidates()[static_cast<size_t>(f.candidate)];
    if (c.distribution != Distribution::kCosinePower) continue;
    (c.shape == LuminaireShape::kPoint ? point : disc) = &f;
  }
  if (point == nullptr || point->relative_sigma > kGoodPoint) return false;
  if (disc == nullptr) return true;  // the disc vanished
  const PairedDifference gain = Difference(ScoreGroups(problem, point->predicted, relative_sigma),
                                           ScoreGroups(problem, disc->predicted, relative_sigma));
  return gain.mean <= gain.standard_error;
}

AimChoice CompareAims(const SubProblem& problem, int luminaire, const FittedCandidate& held,
                      const FittedCandidate& free) {
  const double relative_sigma = std::min(held.relative_sigma, free.relative_sigma);
  const std::map<int, GroupScore> score_held = ScoreGroups(problem, held.predicted, relative_sigma),
                                  score_free = ScoreGroups(problem, free.predicted, relative_sigma);
  const PairedDifference gain = Difference(score_held, score_free);
  constexpr size_t kFewestGroups = 4;  // fewer have no standard error to speak of
  const bool is_free = score_held.size() >= kFewestGroups && gain.mean > gain.standard_error;
  return {luminaire, is_free, Mean(score_held), Mean(score_free), gain.standard_error};
}

// What was open of one luminaire, and what came of it.
struct ChosenModel {
  std::optional<LuminaireChoice> choice;
  std::optional<AimChoice> aim;
  std::optional<FittedCandidate> fitted;  // nothing where nothing is open or nothing could be left out
};

// One luminaire's choice among the models and aims that are open.
class LuminaireChooser {
 public:
  LuminaireChooser(const Room& room, const SubProblem& problem, int luminaire, const OpenChoice& open,
                   const ChooseModelOptions& options)
      : room_(room), problem_(problem), luminaire_(luminaire), open_(open), options_(options) {
    const Luminaire& start = problem.state.luminaires[static_cast<size_t>(problem.luminaire)];
    for (size_t c = 0; c < AllCandidates().size(); ++c) {
      if (Allowed(AllCandidates()[c], start, open)) allowed_.push_back(static_cast<int>(c));
    }
  }

  ChosenModel Run() {
    if (std::none_of(problem_.left_out.begin(), problem_.left_out.end(), [](bool out) { return out; }))
      return {};
    ChosenModel chosen;
    if (open_.aim) chosen.aim = AimOfAPoint();
    const bool turns = chosen.aim && chosen.aim->is_free;
    const std::vector<FittedCandidate> fitted = FitAll(turns);
    if (fitted.empty() || (fitted.size() < 2 && !turns)) return chosen;
    if (fitted.size() > 1) chosen.choice = ChooseAmong(fitted);
    chosen.fitted = fitted[chosen.choice ? static_cast<size_t>(chosen.choice->chosen) : 0];
    if (!turns) return chosen;
    const FittedCandidate& held = Fitted(chosen.fitted->candidate, false);
    chosen.aim = CompareAims(problem_, luminaire_, held, *chosen.fitted);
    if (!chosen.aim->is_free) chosen.fitted = held;
    return chosen;
  }

 private:
  // Of the most telling point that is allowed.
  std::optional<AimChoice> AimOfAPoint() {
    int trial = -1;
    for (const int c : allowed_) {
      const ModelCandidate& candidate = AllCandidates()[static_cast<size_t>(c)];
      if (HasAim(candidate) && (trial < 0 || candidate.shape == LuminaireShape::kPoint)) trial = c;
    }
    if (trial < 0) return {};
    return CompareAims(problem_, luminaire_, Fitted(trial, false), Fitted(trial, true));
  }

  // Each is fitted once.
  const FittedCandidate& Fitted(int candidate, bool aim_is_free) {
    const auto known = fitted_.find({candidate, aim_is_free});
    if (known != fitted_.end()) return known->second;
    return fitted_
        .emplace(std::make_pair(candidate, aim_is_free),
                 FitCandidate(room_, problem_, candidate, aim_is_free, options_))
        .first->second;
  }

  std::vector<FittedCandidate> FitAll(bool turns) {
    std::vector<FittedCandidate> fitted;
    double relative_sigma = 1;
    for (const int c : allowed_) {
      if (SizeDoesNotMatter(problem_, fitted, relative_sigma, AllCandidates()[static_cast<size_t>(c)]))
        continue;
      const FittedCandidate& candidate = Fitted(c, turns);
      // A size that shrank to nothing is the point over again, with a parameter more.
      if (open_.shape && HasVanished(candidate.luminaire)) continue;
      fitted.push_back(candidate);
      relative_sigma = std::min(relative_sigma, fitted.back().relative_sigma);
    }
    return fitted;
  }

  LuminaireChoice ChooseAmong(const std::vector<FittedCandidate>& fitted) const {
    double relative_sigma = 1;
    for (const FittedCandidate& f : fitted) relative_sigma = std::min(relative_sigma, f.relative_sigma);
    std::vector<int> candidates;
    std::vector<std::map<int, GroupScore>> scores;
    for (const FittedCandidate& f : fitted) {
      candidates.push_back(f.candidate);
      scores.push_back(ScoreGroups(problem_, f.predicted, relative_sigma));
    }
    return Choose(luminaire_, candidates, scores);
  }

  const Room& room_;
  const SubProblem& problem_;
  int luminaire_;
  OpenChoice open_;
  const ChooseModelOptions& options_;
  std::vector<int> allowed_;
  std::map<std::pair<int, bool>, FittedCandidate> fitted_;
};

}  // namespace

ModelChoice ChooseLuminaireModels(const Room& room, const LightData& data, const LightState& start,
                                  const std::vector<OpenChoice>& open,
                                  const std::vector<ParameterPrior>& priors,
                                  const ChooseModelOptions& options) {
  if (open.size() != start.luminaires.size()) {
    throw std::invalid_argument("ChooseLuminaireModels: expected one OpenChoice a luminaire");
  }
  std::vector<ChosenModel> chosen(open.size());
  tbb::parallel_for(size_t{0}, open.size(), [&](size_t k) {
    const auto luminaire = static_cast<int>(k);
    const SubProblem problem = MakeSubProblem(room, data, start, luminaire, priors, options.max_elements);
    chosen[k] = LuminaireChooser(room, problem, luminaire, open[k], options).Run();
  });
  ModelChoice result;
  result.state = start;
  for (size_t k = 0; k < open.size(); ++k) {
    if (chosen[k].choice) result.choices.push_back(*chosen[k].choice);
    if (chosen[k].aim) result.aims.push_back(*chosen[k].aim);
    if (!chosen[k].fitted) continue;
    const FittedCandidate& fitted = *chosen[k].fitted;
    result.state.luminaires[k] = fitted.luminaire;
    Apply(AllCandidates()[static_cast<size_t>(fitted.candidate)], fitted.aim_is_free, options.start_size_m,
          result.state.luminaires[k], result.state.free[k]);
  }
  return result;
}

}  // namespace luxfit
