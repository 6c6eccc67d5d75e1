#include "inverse/choose/internal/choose_count.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "forward/luminaire/distribution_ops.h"
#include "inverse/choose/internal/left_out.h"
#include "inverse/choose/internal/two_sides.h"
#include "inverse/model/fit_luminaires.h"
#include "inverse/model/internal/light_model.h"
#include "inverse/model/internal/search/alike_places.h"
#include "inverse/model/internal/search/first_guess.h"
#include "inverse/model/internal/search/places_inside.h"
#include "inverse/model/internal/search/sparse_luminaires.h"
#include "inverse/model/internal/search/watched_places.h"
#include "inverse/select/one_standard_error.h"

namespace luxfit {
namespace {

using KnownPositions = std::vector<std::optional<Eigen::Vector3d>>;

struct Trial {
  int count = 0;
  LeftOutPrediction left_out;
};

LightData WithCount(LightData data, int count) {
  for (Eigen::VectorXd& dimming : data.dimming) dimming = Eigen::VectorXd::Ones(count);
  return data;
}

// Gives a luminaire the shape that photos show at its place: a disc as large, or a rectangle where it is long. Returns false where they
// do not tell.
bool TakeSeenShape(const SeenPlace* place, Luminaire& luminaire) {
  constexpr double kLong = 1.5;  // sides
  if (!place || !(place->area_m2 > 0)) return false;
  luminaire.shape = LuminaireShape::kDisc;
  luminaire.size_m.setConstant(2 * std::sqrt(place->area_m2 / M_PI));
  if (!(place->size_m[0] > kLong * place->size_m[1])) return true;
  luminaire.shape = LuminaireShape::kRectangle;
  luminaire.size_m = place->size_m;
  luminaire.heading = place->heading;
  return true;
}

// Returns what photos tell of the places of the sources.
std::vector<ParameterPrior> PriorsOf(const SparseLuminaires& found, const std::vector<SeenPlace>& places) {
  constexpr LuminaireQuantity kAxes[] = {LuminaireQuantity::kPositionX, LuminaireQuantity::kPositionY,
                                         LuminaireQuantity::kPositionZ};
  std::vector<ParameterPrior> priors;
  for (size_t i = 0; i < found.sources.size(); ++i) {
    const SeenPlace* place = PlaceOf(found.sources[i], places);
    for (int axis = 0; place && axis < 3; ++axis)
      priors.push_back({ParameterKind::kLuminaire, static_cast<int>(i), kAxes[axis], place->position[axis],
                        place->sigma_m});
  }
  return priors;
}

// Returns a state with the luminaires as discs about their places. Those that photos show have the shape and size that
// they show, and stay near their places (PriorsOf): many that are free at once get lost.
LightState StartOf(const SparseLuminaires& found, const LightState& given, double flux_per_strength,
                   double size_m, const std::vector<SeenPlace>& places) {
  LightState state = given;
  state.camera_scale = 1;
  state.camera_scale_free = state.meter_scale_free = false;
  for (const auto& [material, albedo] : found.albedo) {
    if (state.albedo_free[static_cast<size_t>(material)])
      state.albedo[material] = std::clamp(albedo, 0.05, 0.9);
  }
  state.luminaires.clear();
  state.free.clear();
  for (const SparseSource& source : found.sources) {
    Luminaire luminaire = source.luminaire;
    luminaire.flux_lm = flux_per_strength * source.strength;
    FreeQuantities free;
    free.position = !source.is_held;
    // A shape has an aim; it cannot be isotropic.
    if (OpsOf(luminaire.distribution).has_aim) {
      const bool is_shown = TakeSeenShape(PlaceOf(source, places), luminaire);
      if (!is_shown) {
        luminaire.shape = LuminaireShape::kDisc;
        luminaire.size_m.setConstant(size_m);
      }
      free.size = !is_shown;
      free.sides = source.lobe.share_back > 0;
      free.exponent = !free.sides;
      if (free.sides) luminaire = LitOnBothSides(std::move(luminaire), source.lobe.share_back);
    }
    state.luminaires.push_back(std::move(luminaire));
    state.free.push_back(free);
  }
  return state;
}

// One fold judges all numbers, every fifth patch or reading. The search for places sees the others alone: a place
// that follows the errors of the rows that judge it would seem to be supported. Whole blocks in its place leave
// too few blocks to judge by, and five folds in turn take five searches.
constexpr int kJudgingFold = 1;

SubProblem CutEveryFifth(const Room& room, SubProblem problem) {
  const size_t observations = problem.data.observations.size();
  for (size_t i = 0; i < problem.fold_of_row.size(); ++i) {
    const int place =
        i < observations
            ? room.patches.elements[static_cast<size_t>(problem.data.observations[i].element)].patch
            : static_cast<int>(i - observations);
    problem.fold_of_row[i] = IsLeftOut(place) ? kJudgingFold : 0;
  }
  return problem;
}

LightData WithoutJudgingFold(const SubProblem& problem) {
  LightData data = problem.data;
  data.observations.clear();
  data.readings.clear();
  const size_t observations = problem.data.observations.size();
  for (size_t i = 0; i < problem.fold_of_row.size(); ++i) {
    if (problem.fold_of_row[i] == kJudgingFold) continue;
    if (i < observations) data.observations.push_back(problem.data.observations[i]);
    if (i >= observations) data.readings.push_back(problem.data.readings[i - observations]);
  }
  return data;
}

// Refines the luminaires of `found` together on `seen`, and predicts all rows of the problem.
std::optional<Trial> Refined(const Room& room, const SubProblem& problem, const LightData& seen,
                             const LightState& given, const SparseLuminaires& found,
                             const std::vector<SeenPlace>& places, const ChooseCountOptions& options) {
  const auto count = static_cast<int>(found.sources.size());
  const LightData data = WithCount(seen, count), all = WithCount(problem.data, count);
  FitLuminairesOptions fit_options;
  fit_options.covariance = false;
  fit_options.max_outer_iterations = 4;
  fit_options.visibility_order = 2;
  const double flux_per_strength = data.observations.empty() ? 1 : M_PI;  // readings: 1, photos: pi
  const LuminaireFit fit =
      FitLuminaires(room, data, StartOf(found, given, flux_per_strength, options.start_size_m, places),
                    PriorsOf(found, places), fit_options);
  if (fit.status == FitStatus::kNoData) return {};
  LightModel model(room, all);
  model.FreezeVisibility(fit.state, fit_options.visibility_order);
  LeftOutPrediction left_out{model.Predict(fit.state, {}, false).value, model.InPenumbra(),
                             fit.relative_sigma, fit.material_texture_sigma};
  if (!left_out.value.allFinite()) return {};
  left_out.is_smooth.flip();
  for (size_t i = 0; i < left_out.is_smooth.size(); ++i)
    left_out.is_smooth[i] = left_out.is_smooth[i] && problem.fold_of_row[i] == kJudgingFold;
  return Trial{count, std::move(left_out)};
}

bool GivesLight(const SparseSource& source, double all, double least_share) {
  return source.strength > least_share * all;
}

double StrengthOf(const std::vector<SparseSource>& sources) {
  return std::accumulate(sources.begin(), sources.end(), 0.0,
                         [](double sum, const SparseSource& source) { return sum + source.strength; });
}

bool AllGiveLight(const std::vector<SparseSource>& sources, double least_share) {
  const double all = StrengthOf(sources);
  return std::all_of(sources.begin(), sources.end(),
                     [&](const SparseSource& source) { return GivesLight(source, all, least_share); });
}

// Tries numbers of luminaires.
class Count {
 public:
  Count(const Room& room, const LightData& data, const LightState& given,
        const KnownPositions& known_positions, const std::vector<SeenPlace>& places,
        const std::vector<Watcher>& views, const ChooseCountOptions& options)
      : room_(room),
        given_(given),
        places_(PlacesInside(room.scene.Bounds(), places)),
        views_(WatchingViews(places, views)),
        options_(options),
        problem_(CutEveryFifth(room, CutAll(room, data, options.max_elements))),
        seen_(WithoutJudgingFold(problem_)),
        known_(std::max<size_t>(1, known_positions.size())) {
    for (const std::optional<Eigen::Vector3d>& place : known_positions) {
      if (!place) continue;
      found_.sources.emplace_back();
      found_.sources.back().luminaire.position = *place;
      found_.sources.back().is_held = true;
    }
    SortPlaces();
    constexpr size_t kMost = 12, kBeyondSure = 2;
    most_ = options.max_count > 0
                ? static_cast<size_t>(options.max_count)
                : std::max(kMost, std::max(known_, found_.sources.size()) + doubtful_.size() + kBeyondSure);
  }

  bool CanJudge() const { return problem_.CanJudge(); }

  // Goes on until nothing helps, or `data`.checkpoint ends it by FitStopped.
  void Run(const LightData& data) {
    constexpr size_t kPatience = 2;  // numbers in a row without gain that end the search
    const FirstGuessOptions guess;
    const GroupedLight light = GroupLight(room_, WithCount(seen_, 1), guess.max_elements);
    const SparseSearch search(room_, light, views_, guess.grid_m, guess.refinements);
    if (SurePlacesAreAll(search)) return;
    AddDoubtfulPlaces(search);
    for (size_t count = std::max(known_, found_.sources.size()); count <= most_; ++count) {
      if (data.checkpoint) data.checkpoint(data.is_part);
      if (found_.sources.size() < count) found_ = search.Find(0, static_cast<int>(count), found_.sources);
      if (found_.sources.size() < count || !AllGiveLight(found_.sources, options_.least_share) ||
          !Try(found_, trials_.size()))
        return;
      if (count > known_ && trials_.size() == 1) {
        TryFewer(data);
        count = found_.sources.size();
        first_is_shown_ =
            std::all_of(found_.sources.begin(), found_.sources.end(),
                        [&](const SparseSource& source) { return source.is_held || IsAtSurePlace(source); });
      }
      if (trials_.size() - 1 - Select().best >= kPatience) return;
    }
  }

  CountChoice Choice() const {
    CountChoice choice;
    if (trials_.empty()) return choice;
    Selection selection = Select(kWorthHaving);
    for (const Trial& trial : trials_) choice.among.push_back(trial.count);
    choice.are_enough = ShownAreEnough(selection);
    choice.chosen = trials_[choice.are_enough ? 0 : selection.chosen].count;
    choice.score = std::move(selection.score);
    choice.standard_error = std::move(selection.standard_error);
    choice.are_shown = AreShown();
    choice.most = static_cast<int>(most_);
    choice.reached_max = !choice.are_enough && trials_[selection.best].count == choice.most;
    return choice;
  }

 private:
  // Returns whether photos show all luminaires of the first number beyond doubt, and no other number leaves a tenth less of the squares:
  // any that is added makes up for a little of what the mesh and the shapes lack.
  bool ShownAreEnough(const Selection& selection) const {
    constexpr double kWorthAdding = 1.1;
    return first_is_shown_ && selection.score[0] < kWorthAdding * selection.score[selection.best];
  }

  // Returns whether photos show all luminaires tried, three or more that are alike, and these explain the light to 5 %:
  // then their light, which is alike, too, decides nothing.
  bool AreShown() const {
    constexpr double kExplained = 0.05;
    return trials_.size() == 1 && trials_[0].left_out.relative_sigma < kExplained &&
           std::all_of(found_.sources.begin(), found_.sources.end(),
                       [](const SparseSource& source) { return source.is_seen; }) &&
           !SourcesAtAlike(places_, found_.sources.size()).empty();
  }

  // Takes sure places as sources, and keeps the doubtful ones aside. Photos show known luminaires, too.
  void SortPlaces() {
    constexpr double kSame_m = 0.3;
    for (const SeenPlace& place : places_) {
      const auto is_there = [&](const SparseSource& source) {
        return source.is_held && (source.luminaire.position - place.position).norm() < kSame_m;
      };
      if (std::any_of(found_.sources.begin(), found_.sources.end(), is_there)) continue;
      if (!IsSure(place)) {
        doubtful_.push_back(place);
      } else if (options_.max_count == 0 || found_.sources.size() < static_cast<size_t>(options_.max_count)) {
        found_.sources.push_back(SourceAt(place));
      }
    }
  }

  // Tries the sure places alone, where they are alike. Returns whether they are all luminaires there are.
  bool SurePlacesAreAll(const SparseSearch& search) {
    const std::vector<SparseSource> sure = found_.sources;
    found_ = search.Find(0, static_cast<int>(sure.size()), sure);
    LeaveOutDark();
    const bool are_all = found_.sources.size() >= known_ &&
                         !SourcesAtAlike(places_, found_.sources.size()).empty() && Try(found_, 0) &&
                         AreShown();
    if (are_all) return true;
    trials_.clear();
    found_.sources = sure;
    return false;
  }

  // Adds doubtful places where they help to explain the light, and leaves out all that give none: beside a luminaire that is missing,
  // the true ones may seem dark.
  void AddDoubtfulPlaces(const SparseSearch& search) {
    const size_t places = std::min(most_, found_.sources.size() + doubtful_.size());
    found_ = search.Find(0, static_cast<int>(places), found_.sources, doubtful_, [] { return false; });
    for (SparseSource& source : found_.sources) {
      source.is_seen = !source.is_held;
      if (const SeenPlace* place = PlaceOf(source, places_)) source = SeenAt(std::move(source), *place);
    }
    LeaveOutDark();
  }

  // `worth_having`: by how much more luminaires must lower the best score, as a share of it.
  Selection Select(double worth_having = 0) const {
    std::vector<const LeftOutPrediction*> left_out;
    left_out.reserve(trials_.size());
    for (const Trial& trial : trials_) left_out.push_back(&trial.left_out);
    const std::vector<GroupScores> scores = ScoreTogether(problem_, left_out);
    std::vector<SelectionCandidate> candidates;
    candidates.reserve(trials_.size());
    for (size_t t = 0; t < trials_.size(); ++t)
      candidates.push_back({scores[t], static_cast<double>(trials_[t].count), true});
    SelectionOptions options;
    options.worth_having = worth_having;
    return SimplestWithinOneStandardError(candidates, options);
  }

  // Refines the luminaires of `found` together and keeps what they predict as the trial of that index. False: too
  // little light is seen.
  bool Try(const SparseLuminaires& found, size_t index) {
    std::optional<Trial> trial = Refined(room_, problem_, seen_, given_, found, places_, options_);
    if (!trial) return false;
    trials_.insert(trials_.begin() + static_cast<std::ptrdiff_t>(index), std::move(*trial));
    return true;
  }

  // Leaves out the places seen that give no light: mirror images, white things.
  void LeaveOutDark() {
    ShareAmongAlike(places_, found_.sources);
    const double all = StrengthOf(found_.sources);
    found_.sources.erase(std::remove_if(found_.sources.begin(), found_.sources.end(),
                                        [&](const SparseSource& source) {
                                          return source.is_seen &&
                                                 !GivesLight(source, all, options_.least_share);
                                        }),
                         found_.sources.end());
  }

  bool IsAtSurePlace(const SparseSource& source) const {
    const SeenPlace* place = source.is_seen ? PlaceOf(source, places_) : nullptr;
    return place && IsSure(*place);
  }

  // Returns what is left out with a luminaire at a sure place: those like it, which share their light, where they are three and more.
  std::vector<size_t> TogetherWith(size_t index) const {
    std::vector<size_t> like = SourcesLike(places_, found_.sources, index);
    like.erase(
        std::remove_if(like.begin(), like.end(), [&](size_t k) { return !IsAtSurePlace(found_.sources[k]); }),
        like.end());
    return like.size() < kFewestAlike ? std::vector<size_t>{index} : like;
  }

  // Leaves out one seen luminaire after the other, the weakest first. One at a sure place stays, with those like it, unless the others
  // alone predict better by more than a standard error: that photos show it is evidence, too. One at a doubtful place stays only where
  // it helps by more than that.
  void TryFewer(const LightData& data) {
    std::sort(found_.sources.begin(), found_.sources.end(),
              [](const SparseSource& a, const SparseSource& b) { return a.strength < b.strength; });
    for (size_t i = 0; i < found_.sources.size() && found_.sources.size() > known_;) {
      const SparseSource& source = found_.sources[i];
      if (!source.is_seen || IsAtSurePlace(source) || !TryWithout({i}, data)) ++i;
    }
    for (;;) {
      const auto weakest = std::find_if(found_.sources.begin(), found_.sources.end(),
                                        [&](const SparseSource& source) { return IsAtSurePlace(source); });
      if (weakest == found_.sources.end()) return;
      const std::vector<size_t> out = TogetherWith(static_cast<size_t>(weakest - found_.sources.begin()));
      if (found_.sources.size() < known_ + out.size() || !TryWithout(out, data)) return;
    }
  }

  // Returns whether the luminaires, in the order of their indices, are left out from now on.
  bool TryWithout(const std::vector<size_t>& indices, const LightData& data) {
    if (data.checkpoint) data.checkpoint(data.is_part);
    const bool is_sure = IsAtSurePlace(found_.sources[indices.front()]);
    SparseLuminaires fewer = found_;
    for (auto index = indices.rbegin(); index != indices.rend(); ++index)
      fewer.sources.erase(fewer.sources.begin() + static_cast<std::ptrdiff_t>(*index));
    if (!Try(fewer, 0)) return false;
    const Selection selection = Select();
    const bool is_better =
        selection.best == 0 && selection.score[1] - selection.score[0] >= selection.standard_error[1];
    const bool is_out = is_sure ? is_better : selection.chosen == 0;
    trials_.erase(is_out ? trials_.end() - 1 : trials_.begin());
    if (is_out) found_ = std::move(fewer);
    return is_out;
  }

  const Room& room_;
  const LightState& given_;
  const std::vector<SeenPlace> places_;  // inside the room
  std::vector<Watcher> views_;
  const ChooseCountOptions& options_;
  const SubProblem problem_;
  const LightData seen_;  // without the judging fold
  const size_t known_;
  std::vector<SeenPlace> doubtful_;  // not sure
  size_t most_ = 1;
  SparseLuminaires found_;
  bool first_is_shown_ = false;  // photos show the luminaires of the first number beyond doubt
  std::vector<Trial> trials_;    // by number
};

}  // namespace

CountChoice ChooseLuminaireCount(const Room& room, const LightData& data, const LightState& state,
                                 const KnownPositions& known_positions, const std::vector<SeenPlace>& places,
                                 const std::vector<Watcher>& views, const ChooseCountOptions& options) {
  const int least = std::max(1, static_cast<int>(known_positions.size()));
  if (options.max_count < 0 || (options.max_count > 0 && options.max_count < least))
    throw std::invalid_argument(
        "ChooseLuminaireCount: expected max_count of at least 1 and of the known places");
  Count count(room, data, state, known_positions, places, views, options);
  if (!count.CanJudge()) return {};
  std::string stopped;
  try {
    count.Run(data);
  } catch (const FitStopped& stop) {
    stopped = stop.what();
  }
  CountChoice choice = count.Choice();
  choice.stopped = std::move(stopped);
  return choice;
}

}  // namespace luxfit
