#include "inverse/choose/internal/refine_luminaire.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "forward/luminaire/distribution_ops.h"
#include "forward/luminaire/luminaire_parts.h"
#include "inverse/choose/internal/two_sides.h"
#include "inverse/select/one_standard_error.h"

namespace luxfit {
namespace {

struct RefinedCandidate {
  std::string name;
  FittedModel fitted;
};

constexpr double kGoodEnough = 0.01;  // model error below which table and emission are not tried
constexpr double kNodeStepDeg = 7.5;

std::vector<double> NodesTo(double last_deg) {
  std::vector<double> gamma_rad;
  const int steps = static_cast<int>(std::lround(last_deg / kNodeStepDeg));
  gamma_rad.reserve(static_cast<size_t>(steps) + 1);
  for (int j = 0; j <= steps; ++j) gamma_rad.push_back(j * last_deg / steps * M_PI / 180);
  return gamma_rad;
}

Luminaire WithTable(Luminaire luminaire, const std::vector<double>& gamma_rad) {
  const LuminaireAxes axes = AxesOf(luminaire);
  std::vector<double> intensity;
  intensity.reserve(gamma_rad.size());
  for (const double gamma : gamma_rad) {
    const Eigen::Vector3d direction = std::cos(gamma) * luminaire.aim + std::sin(gamma) * axes.along;
    intensity.push_back(IntensityPerLumen(luminaire, axes, direction).cd_per_lm);
  }
  // A node at 0 would start at its bound, where a first step may leave it.
  const double floor = 1e-3 * *std::max_element(intensity.begin(), intensity.end());
  for (double& i : intensity) i = std::max(i, floor);
  luminaire.distribution = Distribution::kMeasured;
  luminaire.table = std::make_shared<IntensityTable>(RotationalTable(gamma_rad, intensity));
  return luminaire;
}

class Refiner {
 public:
  Refiner(const Room& room, const SubProblem& problem, OpenRefinements open)
      : room_(room), problem_(problem), open_(open) {}

  RefinedLuminaire Run() {
    const size_t k = static_cast<size_t>(problem_.luminaire);
    luminaire_ = problem_.state.luminaires[k];
    for (const int m : problem_.members)
      result_.members.push_back(problem_.state.luminaires[static_cast<size_t>(m)]);
    result_.free = problem_.state.free[k];
    if (!problem_.CanJudge() || !(open_.heading || open_.aim || open_.table || open_.emission))
      return result_;
    if (open_.heading) ChooseHeading();
    held_ = Fit(luminaire_, result_.free);
    if (open_.aim) TakeBest({AimStep()});
    while (open_.table || open_.emission) {
      if (held_.left_out.relative_sigma <= kGoodEnough && !open_.table_asked_for) break;
      std::vector<Step> steps;
      if (open_.table) steps.push_back(TableStep());
      if (open_.emission && !open_.table_asked_for) steps.push_back(EmissionStep());
      if (!TakeBest(steps)) break;
    }
    return result_;
  }

 private:
  struct Step {
    RefinementKind kind = RefinementKind::kTable;
    std::vector<RefinedCandidate> candidates;  // the first is the luminaire as it was
    std::vector<double> score = {};            // one for each
    int chosen = 0;
    double gain = 0, standard_error = 0;  // the best against the first
  };

  FittedModel Fit(const Luminaire& luminaire, const FreeQuantities& free) const {
    return FitModel(room_, problem_, luminaire, free, {3, 10});
  }

  // Fits from four headings. All have as many parameters, so the lowest score wins.
  void ChooseHeading() {
    Refinement record;
    record.kind = RefinementKind::kHeading;
    FreeQuantities free = result_.free;
    free.heading = true;
    std::vector<RefinedCandidate> candidates;
    for (const int degrees : {0, 90, 180, 270}) {
      Luminaire start = luminaire_;
      const LuminaireAxes axes = AxesOf(start);
      const double angle = degrees * M_PI / 180;
      start.heading = std::cos(angle) * axes.along - std::sin(angle) * axes.across;
      candidates.push_back({"from " + std::to_string(degrees) + " deg", Fit(start, free)});
    }
    std::vector<SelectionCandidate> selectable;
    for (GroupScores& scores : Scores(candidates)) selectable.push_back({std::move(scores), 1, true});
    for (const RefinedCandidate& c : candidates) {
      record.among.push_back(c.name);
      record.effective_parameters.push_back(1);
    }
    const Selection selection = SimplestWithinOneStandardError(selectable);
    record.score = selection.score;
    record.chosen = static_cast<int>(selection.chosen);
    record.standard_error = selection.standard_error[0];
    Keep(candidates[selection.chosen].fitted);
    result_.steps.push_back(std::move(record));
  }

  Step AimStep() const {
    FreeQuantities free = held_.free;
    free.tilt = true;
    Step step{RefinementKind::kAim, {{"as given", held_}, {"estimated", Fit(held_.luminaire, free)}}};
    return Judged(std::move(step));
  }

  // Returns what a step must gain, as a share of the best score. Errors of the mesh that repeat from surface to surface
  // look like uneven emission. A table is one for all directions, and views of what the mesh lacks are left out.
  static double WorthHaving(RefinementKind kind) { return kind == RefinementKind::kTable ? 0 : kWorthHaving; }

  // Returns whether a few steps towards the refinement gain half of what it must gain to be taken: shares of light are
  // nearly linear, so these steps bring most of it.
  bool MayGain(RefinementKind kind, const FittedModel& screened) const {
    const std::vector<GroupScores> scores = ScoreTogether(problem_, {&held_.left_out, &screened.left_out});
    const double needed =
        std::max(Difference(scores[0], scores[1]).standard_error, WorthHaving(kind) * Mean(scores[1]));
    return Mean(scores[0]) - Mean(scores[1]) > needed / 2;
  }

  FittedModel Screened(const Luminaire& luminaire, const FreeQuantities& free) const {
    return FitModel(room_, problem_, luminaire, free, {1, 3});
  }

  Step TableStep() const {
    Step step{RefinementKind::kTable, {{ToString(held_.luminaire.distribution), held_}}};
    const bool sees_above = SeesBothSides(room_, problem_, held_.luminaire);
    const bool is_lobe = held_.luminaire.distribution != Distribution::kMeasured;
    const double lobe_deg = OpsOf(held_.luminaire.distribution).last_gamma_deg;
    const double last_deg = sees_above ? 180 : lobe_deg;
    const double own_deg = is_lobe ? lobe_deg : last_deg;
    const std::vector<double> nodes = NodesTo(own_deg);
    if (!open_.table_asked_for) {
      FreeQuantities free = held_.free;
      free.exponent = free.sides = false;
      bool may_gain = false;
      for (const double sigma : {0.03, 0.3}) {
        free.table_sigma = sigma;
        FittedModel screened = Screened(WithTable(held_.luminaire, NodesTo(last_deg)), free);
        may_gain = may_gain || MayGain(RefinementKind::kTable, screened);
        step.candidates.push_back(
            {fmt::format("table, smoothness {:g}, a few steps", sigma), std::move(screened)});
      }
      if (!may_gain) return Judged(std::move(step));
      step.candidates.resize(1);
    }
    AddTables(held_.luminaire.shape, nodes, step.candidates);
    const bool may_be_point = held_.free.size && held_.luminaire.emission.size() == 0;
    if (may_be_point && !open_.table_asked_for) AddTables(LuminaireShape::kPoint, nodes, step.candidates);
    if (last_deg > own_deg) AddTableAllRound(step.candidates);
    return Judged(std::move(step));
  }

  // Adds tables from the stiffest to the softest, until a softer one is no better, or the first has less than the lobe
  // by more than a standard error: the shape is wrong then, and no table makes up for it.
  void AddTables(LuminaireShape shape, const std::vector<double>& nodes,
                 std::vector<RefinedCandidate>& candidates) const {
    Luminaire start = WithTable(held_.luminaire, nodes);
    FreeQuantities free = held_.free;
    start.shape = shape;
    free.size = free.size && shape != LuminaireShape::kPoint;
    free.exponent = free.sides = false;
    const size_t first = candidates.size();
    for (const double sigma : {0.01, 0.03, 0.1, 0.3}) {
      free.table_sigma = sigma;
      FittedModel fitted = Fit(start, free);
      start = fitted.luminaire;  // the next, freer candidate starts from here
      candidates.push_back(
          {fmt::format("table {}, smoothness {:g}", ToString(shape), sigma), std::move(fitted)});
      const std::vector<GroupScores> scores = Scores(candidates);
      const bool is_first = candidates.size() == first + 1;
      if (is_first && open_.table_asked_for) continue;
      const GroupScores& before = is_first ? scores.front() : scores[scores.size() - 2];
      const PairedDifference worse = Difference(scores.back(), before);
      if (worse.mean > (is_first ? worse.standard_error : 0)) break;
    }
  }

  // Adds the best of the tables with nodes up to 180 degrees.
  void AddTableAllRound(std::vector<RefinedCandidate>& candidates) const {
    const std::vector<GroupScores> scores = Scores(candidates);
    size_t best = 1;
    for (size_t c = 2; c < candidates.size(); ++c)
      if (Mean(scores[c]) < Mean(scores[best])) best = c;
    const FittedModel& half = candidates[best].fitted;
    FittedModel whole = Fit(WithTable(half.luminaire, NodesTo(180)), half.free);
    candidates.push_back({candidates[best].name + ", all round", std::move(whole)});
  }

  Step EmissionStep() const {
    Step step{RefinementKind::kEmission, {{"even", held_}}};
    FreeQuantities free = held_.free;
    free.emission_sigma = 1;
    FittedModel screened = Screened(WithCells(3), free);
    if (!MayGain(RefinementKind::kEmission, screened)) {
      step.candidates.push_back({"3 x 3 cells, a few steps", std::move(screened)});
      return Judged(std::move(step));
    }
    int without_gain = 0;
    double best = std::numeric_limits<double>::infinity();
    for (const int cells : {2, 3, 4, 6, 8}) {
      // The cost grows with the square of the cells: the search ends after two without gain.
      if (without_gain == 2) break;
      step.candidates.push_back({fmt::format("{0} x {0} cells", cells), Fit(WithCells(cells), free)});
      const std::vector<GroupScores> scores = Scores(step.candidates);
      best = std::min(best, Mean(scores.front()));
      const double score = Mean(scores.back());
      without_gain = score < best ? 0 : without_gain + 1;
      best = std::min(best, score);
    }
    return Judged(std::move(step));
  }

  // Returns the luminaire with cells that emit alike.
  Luminaire WithCells(int cells) const {
    Luminaire luminaire = held_.luminaire;
    luminaire.emission = Eigen::ArrayXXd::Constant(cells, cells, 1.0 / (cells * cells));
    return luminaire;
  }

  std::vector<GroupScores> Scores(const std::vector<RefinedCandidate>& candidates) const {
    std::vector<const LeftOutPrediction*> left_out;
    left_out.reserve(candidates.size());
    for (const RefinedCandidate& c : candidates) left_out.push_back(&c.fitted.left_out);
    return ScoreTogether(problem_, left_out);
  }

  // Chooses the fewest effective parameters within one standard error of the best.
  Step Judged(Step step) const {
    const std::vector<GroupScores> scores = Scores(step.candidates);
    std::vector<SelectionCandidate> selectable;
    for (size_t c = 0; c < scores.size(); ++c)
      selectable.push_back({scores[c], step.candidates[c].fitted.effective_parts, true});
    // A requested table is estimated even where a lobe fits as well.
    selectable[0].is_eligible = !(open_.table_asked_for && step.kind == RefinementKind::kTable);
    SelectionOptions options;
    options.keeps_first = true;
    options.worth_having = WorthHaving(step.kind);
    Selection selection = SimplestWithinOneStandardError(selectable, options);
    step.gain = selection.score[0] - selection.score[selection.best];
    step.standard_error = selection.standard_error[0];
    step.chosen = static_cast<int>(selection.chosen);
    step.score = std::move(selection.score);
    return step;
  }

  // Records all steps and takes the one that gains most. Returns false if none gains.
  bool TakeBest(const std::vector<Step>& steps) {
    const Step* best = nullptr;
    for (const Step& step : steps) {
      if (step.chosen > 0 && (best == nullptr || step.gain > best->gain)) best = &step;
    }
    for (const Step& step : steps) {
      const bool taken = &step == best;
      // A step that gave way to a better one is not recorded yet: it is tried again.
      if (taken || best == nullptr) Record(step);
      if (!taken && best != nullptr) continue;
      if (step.kind == RefinementKind::kTable) open_.table = open_.table_asked_for = false;
      if (step.kind == RefinementKind::kEmission) open_.emission = false;
    }
    if (best == nullptr) return false;
    held_ = best->candidates[static_cast<size_t>(best->chosen)].fitted;
    Keep(held_);
    // Only a rectangle has cells.
    if (held_.luminaire.shape != LuminaireShape::kRectangle) open_.emission = false;
    return true;
  }

  void Record(const Step& step) {
    Refinement record;
    record.kind = step.kind;
    record.chosen = step.chosen;
    record.standard_error = step.standard_error;
    record.score = step.score;
    for (const RefinedCandidate& c : step.candidates) {
      record.among.push_back(c.name);
      record.effective_parameters.push_back(c.fitted.effective_parts);
    }
    result_.steps.push_back(std::move(record));
  }

  void Keep(const FittedModel& fitted) {
    luminaire_ = fitted.luminaire;
    result_.members = fitted.members;
    result_.free = fitted.free;
    result_.changed = true;
  }

  const Room& room_;
  const SubProblem& problem_;
  OpenRefinements open_;
  RefinedLuminaire result_;
  Luminaire luminaire_;  // the first of the type
  FittedModel held_;
};

}  // namespace

RefinedLuminaire RefineLuminaire(const Room& room, const SubProblem& problem, const OpenRefinements& open) {
  return Refiner(room, problem, open).Run();
}

}  // namespace luxfit
