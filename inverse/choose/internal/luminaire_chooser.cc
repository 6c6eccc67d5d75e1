#include "inverse/choose/internal/luminaire_chooser.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "forward/luminaire/distribution_ops.h"
#include "inverse/choose/internal/two_sides.h"

namespace luxfit {

Selection SelectAmong(const SubProblem& problem, const std::vector<const FittedModel*>& models,
                      const std::vector<int>& parameters, const SelectionOptions& options) {
  std::vector<const LeftOutPrediction*> left_out;
  left_out.reserve(models.size());
  for (const FittedModel* model : models) left_out.push_back(&model->left_out);
  const std::vector<GroupScores> scores = ScoreTogether(problem, left_out);
  const std::vector<bool> is_eligible = LeaveMostRowsSmooth(problem, left_out);
  std::vector<SelectionCandidate> candidates;
  candidates.reserve(models.size());
  for (size_t m = 0; m < models.size(); ++m)
    candidates.push_back({scores[m], static_cast<double>(parameters[m]), is_eligible[m]});
  return SimplestWithinOneStandardError(candidates, options);
}

namespace {

// Returns the candidates shape by shape, with one parameter for every length, one for an exponent or a share up and
// one for a heading. A disc or rectangle has an aim; it cannot be isotropic. Turned rectangles come last.
std::vector<ModelCandidate> MakeCandidates() {
  const std::array<LuminaireShape, 3> shapes{LuminaireShape::kPoint, LuminaireShape::kDisc,
                                             LuminaireShape::kRectangle};
  std::vector<ModelCandidate> candidates;
  for (size_t lengths = 0; lengths < shapes.size(); ++lengths) {
    for (const DistributionOps& ops : Distributions()) {
      if (!ops.is_tried || (lengths > 0 && !ops.has_aim)) continue;
      candidates.push_back({ops.distribution, shapes[lengths], false,
                            static_cast<int>(lengths) + (ops.has_exponent ? 1 : 0),
                            std::string(ops.name) + " " + ToString(shapes[lengths])});
    }
    candidates.push_back({Distribution::kMeasured, shapes[lengths], false, static_cast<int>(lengths) + 1,
                          "two_sided " + ToString(shapes[lengths]), true});
  }
  for (const ModelCandidate& straight : std::vector<ModelCandidate>(candidates)) {
    if (straight.shape != LuminaireShape::kRectangle) continue;
    candidates.push_back({straight.distribution, straight.shape, true, straight.parameters + 1,
                          straight.name + ", turned", straight.is_two_sided});
  }
  return candidates;
}

const std::vector<ModelCandidate>& AllCandidates() {
  static const std::vector<ModelCandidate> candidates = MakeCandidates();
  return candidates;
}

bool Allowed(const ModelCandidate& candidate, const Luminaire& luminaire, const OpenChoice& open) {
  const bool is_given = candidate.distribution == luminaire.distribution && !candidate.is_two_sided;
  return (open.distribution || is_given) && (open.shape || candidate.shape == luminaire.shape) &&
         (open.heading || !candidate.is_turned);
}

// Returns whether turning the candidate changes its light. An isotropic point has no aim.
bool HasAim(const ModelCandidate& candidate) {
  return OpsOf(candidate.distribution).has_aim || candidate.shape != LuminaireShape::kPoint;
}

void Apply(const ModelCandidate& candidate, bool aim_is_free, Luminaire& luminaire, FreeQuantities& free) {
  const bool grows = candidate.shape != LuminaireShape::kPoint && luminaire.shape == LuminaireShape::kPoint;
  if (candidate.is_two_sided && luminaire.distribution != candidate.distribution)
    luminaire = LitOnBothSides(std::move(luminaire));
  luminaire.distribution = candidate.distribution;
  luminaire.shape = candidate.shape;
  if (grows) luminaire.size_m.setConstant(kStartSizeM);
  if (candidate.shape == LuminaireShape::kDisc) luminaire.size_m[1] = luminaire.size_m[0];
  free.exponent = OpsOf(candidate.distribution).has_exponent;
  free.size = candidate.shape != LuminaireShape::kPoint;
  free.tilt = aim_is_free && HasAim(candidate);
  free.heading = candidate.is_turned;
  free.sides = candidate.is_two_sided;
}

// `start`: where the fit starts from; of a turned candidate, the straight one as fitted.
FittedCandidate FitCandidate(const Room& room, const SubProblem& problem, int index, bool aim_is_free,
                             const Luminaire& start) {
  const ModelCandidate& candidate = AllCandidates()[static_cast<size_t>(index)];
  const size_t k = static_cast<size_t>(problem.luminaire);
  Luminaire luminaire = start;
  FreeQuantities free = problem.state.free[k];
  Apply(candidate, aim_is_free, luminaire, free);
  if (!candidate.is_turned) return {index, aim_is_free, FitModel(room, problem, luminaire, free)};
  // Both sides are free, so headings repeat after a quarter turn. Two starts a third of it from either end
  // leave no heading further than an eighth of a turn away. A square of the same area favours neither side.
  luminaire.size_m.setConstant(std::sqrt(luminaire.size_m.prod()));
  const LuminaireAxes axes = AxesOf(luminaire);
  std::optional<FittedModel> best;
  for (const double start_deg : {30.0, 60.0}) {
    const double angle = start_deg * M_PI / 180;
    luminaire.heading = std::cos(angle) * axes.along + std::sin(angle) * axes.across;
    FittedModel fitted = FitModel(room, problem, luminaire, free);
    if (!best || fitted.left_out.relative_sigma < best->left_out.relative_sigma) best = std::move(fitted);
  }
  return {index, aim_is_free, std::move(*best)};
}

constexpr double kGoodPoint =
    0.01;  // model error of a point that a size hardly improves; luxmeters read to 3 %

// Returns whether rectangles need no trial: a point explains the light that well, and discs bring no gain
// over points. Discs alone do not tell: a long panel fits a disc no better than a point.
bool SizeDoesNotMatter(const SubProblem& problem, const std::vector<FittedCandidate>& fitted,
                       const ModelCandidate& next) {
  if (next.shape != LuminaireShape::kRectangle) return false;
  const FittedCandidate *point = nullptr, *disc = nullptr;
  for (const FittedCandidate& f : fitted) {
    const ModelCandidate& c = AllCandidates()[static_cast<size_t>(f.candidate)];
    if (c.is_two_sided != next.is_two_sided) continue;
    if (!c.is_two_sided && !OpsOf(c.distribution).has_exponent) continue;
    (c.shape == LuminaireShape::kPoint ? point : disc) = &f;
  }
  if (point == nullptr || point->model.left_out.relative_sigma > kGoodPoint) return false;
  if (disc == nullptr) return true;  // the disc vanished
  return SelectAmong(problem, {&point->model, &disc->model}, {0, 1}).chosen == 0;
}

// Returns whether a candidate that lights both sides is worth its trial: the point, where a point that lights one
// side leaves more than luxmeters would; other shapes, where that point explained the light best of all points.
bool MayLightBothSides(const std::vector<FittedCandidate>& fitted, const ModelCandidate& next) {
  const FittedCandidate* best = nullptr;
  for (const FittedCandidate& f : fitted) {
    if (AllCandidates()[static_cast<size_t>(f.candidate)].shape != LuminaireShape::kPoint) continue;
    if (best == nullptr || f.model.left_out.relative_sigma < best->model.left_out.relative_sigma) best = &f;
  }
  if (best == nullptr) return true;  // the shape is given
  if (next.shape == LuminaireShape::kPoint) return best->model.left_out.relative_sigma > kGoodPoint;
  return AllCandidates()[static_cast<size_t>(best->candidate)].is_two_sided;
}

AimChoice CompareAims(const SubProblem& problem, int luminaire, const FittedModel& held,
                      const FittedModel& free) {
  const Selection selection = SelectAmong(problem, {&held, &free}, {0, 1});
  const size_t worse = 1 - selection.best;
  return {luminaire, selection.chosen == 1, selection.score[0], selection.score[1],
          selection.standard_error[worse]};
}

// Chooses among the models and aims that are open for one luminaire.
class LuminaireChooser {
 public:
  LuminaireChooser(const Room& room, const SubProblem& problem, int luminaire, const OpenChoice& open)
      : room_(room), problem_(problem), luminaire_(luminaire), open_(open) {
    const auto k = static_cast<size_t>(problem.luminaire);
    is_aimed_ = open.aim && problem.state.free[k].tilt;
    const bool both_sides = SeesBothSides(room, problem, problem.state.luminaires[k]);
    for (size_t c = 0; c < AllCandidates().size(); ++c) {
      const ModelCandidate& candidate = AllCandidates()[c];
      if (candidate.is_two_sided
              ? !both_sides
              : is_aimed_ && open.distribution && !OpsOf(candidate.distribution).has_exponent)
        continue;
      if (Allowed(candidate, problem.state.luminaires[k], open)) allowed_.push_back(static_cast<int>(c));
    }
  }

  ChosenModel Run() {
    // One model with its aim given leaves nothing to choose: a fit of it would not be used.
    if (!problem_.CanJudge() || (allowed_.size() < 2 && !open_.aim)) return {};
    ChosenModel chosen;
    if (open_.aim && !is_aimed_) chosen.aim = AimOfAPoint();
    const bool turns = is_aimed_ || (chosen.aim && chosen.aim->is_free);
    const std::vector<FittedCandidate> fitted = FitAll(turns);
    if (fitted.empty() || (fitted.size() < 2 && !turns)) return chosen;
    if (fitted.size() > 1) chosen.choice = ChooseAmong(fitted);
    chosen.fitted = fitted[chosen.choice ? static_cast<size_t>(chosen.choice->chosen) : 0];
    if (!turns || is_aimed_) return chosen;
    const FittedCandidate& held = Fitted(chosen.fitted->candidate, false);
    chosen.aim = CompareAims(problem_, luminaire_, held.model, chosen.fitted->model);
    if (!chosen.aim->is_free) chosen.fitted = held;
    return chosen;
  }

 private:
  // Compares aims by a point, where one is allowed, else by another candidate with an aim.
  std::optional<AimChoice> AimOfAPoint() {
    int trial = -1;
    for (const int c : allowed_) {
      const ModelCandidate& candidate = AllCandidates()[static_cast<size_t>(c)];
      if (HasAim(candidate) && !candidate.is_two_sided &&
          (trial < 0 || candidate.shape == LuminaireShape::kPoint))
        trial = c;
    }
    if (trial < 0) return {};
    return CompareAims(problem_, luminaire_, Fitted(trial, false).model, Fitted(trial, true).model);
  }

  // Returns the fitted candidate. Each is fitted once.
  const FittedCandidate& Fitted(int candidate, bool aim_is_free) {
    const auto known = fitted_.find({candidate, aim_is_free});
    if (known != fitted_.end()) return known->second;
    return fitted_
        .emplace(std::make_pair(candidate, aim_is_free),
                 FitCandidate(room_, problem_, candidate, aim_is_free, StartOf(candidate, aim_is_free)))
        .first->second;
  }

  Luminaire StartOf(int candidate, bool aim_is_free) {
    const ModelCandidate& turned = AllCandidates()[static_cast<size_t>(candidate)];
    for (const int c : allowed_) {
      const ModelCandidate& straight = AllCandidates()[static_cast<size_t>(c)];
      if (turned.is_turned && !straight.is_turned && straight.shape == turned.shape &&
          straight.distribution == turned.distribution)
        return Fitted(c, aim_is_free).model.luminaire;
    }
    return problem_.state.luminaires[static_cast<size_t>(problem_.luminaire)];
  }

  std::vector<FittedCandidate> FitAll(bool turns) {
    std::vector<FittedCandidate> fitted;
    for (const int c : allowed_) {
      const ModelCandidate& next = AllCandidates()[static_cast<size_t>(c)];
      if (SizeDoesNotMatter(problem_, fitted, next)) continue;
      if (next.is_two_sided && !MayLightBothSides(fitted, next)) continue;
      if (next.is_turned && !IsBestStraightRectangle(fitted, next)) continue;
      const FittedCandidate& candidate = Fitted(c, turns);
      // A size that shrank to nothing repeats the point, with one more parameter.
      if (open_.shape && HasVanished(candidate.model.luminaire)) continue;
      if (next.is_two_sided && !SeesBothSides(room_, problem_, candidate.model.luminaire)) continue;
      fitted.push_back(candidate);
    }
    return fitted;
  }

  // Returns whether the straight rectangle of the candidate's distribution explains the light best of all
  // straight rectangles that light as many sides. The others' headings need no trial.
  static bool IsBestStraightRectangle(const std::vector<FittedCandidate>& fitted,
                                      const ModelCandidate& next) {
    const FittedCandidate* best = nullptr;
    for (const FittedCandidate& f : fitted) {
      const ModelCandidate& c = AllCandidates()[static_cast<size_t>(f.candidate)];
      if (c.shape != LuminaireShape::kRectangle || c.is_turned || c.is_two_sided != next.is_two_sided)
        continue;
      if (best == nullptr || f.model.left_out.relative_sigma < best->model.left_out.relative_sigma) best = &f;
    }
    return best != nullptr &&
           AllCandidates()[static_cast<size_t>(best->candidate)].distribution == next.distribution;
  }

  LuminaireChoice ChooseAmong(const std::vector<FittedCandidate>& fitted) const {
    LuminaireChoice choice;
    choice.luminaire = luminaire_;
    std::vector<const FittedModel*> models;
    std::vector<int> parameters;
    for (const FittedCandidate& f : fitted) {
      const ModelCandidate& candidate = AllCandidates()[static_cast<size_t>(f.candidate)];
      choice.among.push_back(candidate.name);
      models.push_back(&f.model);
      parameters.push_back(candidate.parameters);
    }
    SelectionOptions options;
    // A beam falls on few blocks of places, whose errors are its own.
    if (is_aimed_) options.worth_having = kWorthHaving;
    Selection selection = SelectAmong(problem_, models, parameters, options);
    choice.score = std::move(selection.score);
    choice.standard_error = std::move(selection.standard_error);
    choice.chosen = static_cast<int>(selection.chosen);
    return choice;
  }

  const Room& room_;
  const SubProblem& problem_;
  int luminaire_;
  OpenChoice open_;
  bool is_aimed_ = false;  // the search for places told the aim
  std::vector<int> allowed_;
  std::map<std::pair<int, bool>, FittedCandidate> fitted_;
};

}  // namespace

bool HasVanished(const Luminaire& luminaire) {
  constexpr double kVanishedM = 0.01;
  // A rectangle with one short side is a strip, not a point.
  if (luminaire.shape == LuminaireShape::kRectangle) return luminaire.size_m.maxCoeff() < kVanishedM;
  return luminaire.shape == LuminaireShape::kDisc && luminaire.size_m[0] < kVanishedM;
}

ChosenModel ChooseLuminaire(const Room& room, const SubProblem& problem, int luminaire,
                            const OpenChoice& open) {
  return LuminaireChooser(room, problem, luminaire, open).Run();
}

void TakeOver(const FittedCandidate& fitted, LightState& state, const std::vector<int>& luminaires) {
  for (size_t m = 0; m < luminaires.size(); ++m) {
    const auto k = static_cast<size_t>(luminaires[m]);
    state.luminaires[k] = fitted.model.members[m];
    Apply(AllCandidates()[static_cast<size_t>(fitted.candidate)], fitted.aim_is_free, state.luminaires[k],
          state.free[k]);
  }
}

}  // namespace luxfit
