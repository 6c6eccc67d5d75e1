#include "inverse/fit/fit_room.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>
#include <utility>

#include "forward/luminaire/photometry.h"
#include "inverse/albedo/internal/albedo_rgb.h"
#include "inverse/choose/internal/choose_model.h"
#include "inverse/choose/internal/contradiction.h"
#include "inverse/choose/internal/detail/scene_detail.h"
#include "inverse/choose/internal/luminaire_types.h"
#include "inverse/choose/internal/profile_direct_share.h"
#include "inverse/choose/internal/several_starts.h"
#include "inverse/choose/internal/two_sides.h"
#include "inverse/fit/internal/detail_words.h"
#include "inverse/fit/internal/fit_as_given.h"
#include "inverse/fit/internal/fit_whole.h"
#include "inverse/fit/internal/indirect_albedo.h"
#include "inverse/fit/internal/judge/compare_starts_again.h"
#include "inverse/fit/internal/judge/early_stop.h"
#include "inverse/fit/internal/judge/misfit.h"
#include "inverse/fit/internal/judge/odd_luminaires.h"
#include "inverse/fit/internal/judge/predict_readings.h"
#include "inverse/fit/internal/judge/type_fluxes.h"
#include "inverse/fit/internal/judge/unmodelled.h"
#include "inverse/fit/internal/light_colours.h"
#include "inverse/fit/internal/match_scale.h"
#include "inverse/fit/internal/name_in_order.h"
#include "inverse/fit/internal/outlines.h"
#include "inverse/fit/internal/room_light.h"
#include "inverse/fit/internal/start.h"
#include "inverse/fit/internal/start_at_outlines.h"
#include "inverse/fit/internal/surface_texture.h"
#include "inverse/fit/internal/words.h"
#include "inverse/model/internal/measured_indirect.h"

namespace luxfit {
namespace {

// Runs the steps in order. It is a class because each step adds to the same result.
class RoomFitter {
 public:
  RoomFitter(const Room& room, const RoomObservations& given, const FitRoomOptions& options)
      : room_(room), given_(given), options_(options), light_(LightOf(room, given)) {
    RecordLabels(room, light_.labels, result_.findings);
    RecordBetweenViews(light_, result_.findings);
    RecordReadings(given.meter, light_, result_.findings);
    result_.data = light_.data;
  }

  RoomFit Run() {
    const auto step = Begin(
        "fit", fmt::format("{} observations, {} readings to fit or scale, {} luminaires",
                           result_.data.observations.size(), light_.used_readings, given_.luminaires.size()));
    LuminaireFit fit = FitInTime();
    const bool is_whole = !result_.stopped;
    if (is_whole && fit.IsUsable()) CompareStartsAgain(room_, result_.data, fit, Priors(), is_seen_, starts_);
    RecordAmbiguity();
    if (is_whole && fit.IsUsable() && AsksForDirectShare()) {
      result_.direct_share = ProfileDirectShare(room_, result_.data, fit, open_, Priors());
      RecordDirectShare(*result_.direct_share, result_.findings);
    }
    if (is_whole) {
      CompareDetails(fit);
    } else {
      result_.albedo_rgb = EstimateAlbedoRgb(room_, result_.data, fit);
    }
    RecordTexture(room_, fit, result_.findings);
    result_.types = CompareTypeFluxes(fit);
    WarnOfDeviatingFluxes(fit.state, result_.types, result_.findings);
    WarnOfOddLuminaires(fit.state, FindOddLuminaires(fit, result_.data), result_.findings);
    WarnOfOversizedLuminaires(fit.state, FindOversizedLuminaires(fit, shown_), result_.findings);
    result_.fit = WithPredictedReadings(room_, result_.data, std::move(fit));
    WarnOfAssumedWeights(given_, result_, result_.findings);
    WarnOfMisfit(room_, result_, result_.findings);
    WarnOfIndirectAlbedo(room_, result_, result_.findings);
    RecordOutcome(given_, result_, result_.findings);
    return std::move(result_);
  }

 private:
  // Fits until it is done, or until it is stopped: then to the best state so far.
  LuminaireFit FitInTime() {
    LuminaireFit fit;
    try {
      LightState state = StartByParts();
      SettleScale(state);
      best_ = state;
      fit = Refine(state);
    } catch (const FitStopped& stop) {
      result_.stopped = EarlyStop{stop.what(), step_};
      WarnOfStop(*result_.stopped, result_.findings);
      fit = FitOfBest();
    }
    result_.data.checkpoint = nullptr;  // what follows is short
    result_.rounds = rounds_;
    return fit;
  }

  // Returns the best state so far with its covariance, as a fit that moves nothing.
  LuminaireFit FitOfBest() {
    if (!is_scale_settled_) {
      best_.camera_scale_free = start_.state.camera_scale_free;
      best_.meter_scale_free = start_.state.meter_scale_free;
      SettleScale(best_);
    }
    result_.data.checkpoint = nullptr;
    result_.data.observations = ThinElements(result_.data.observations, options_.max_elements_to_choose);
    FitLuminairesOptions options;
    options.on_round = KeepBest();
    options.subtracts_discretisation = false;
    options.steps_by_direct_light = !result_.data.observations.empty();
    options.has_texture = is_textured_;
    options.max_outer_iterations = 0;
    options.start_is_near = true;
    return FitLuminaires(room_, result_.data, best_, Priors(), options);
  }

  // Returns what keeps the best state of a fit of all luminaires, and reports its rounds.
  std::function<void(const FitRound&)> KeepBest() {
    return [this](const FitRound& round) {
      best_ = round.state;
      if (options_.on_round) options_.on_round(round);
    };
  }

  // Announces a step. The caller holds the returned token until the step ends.
  std::shared_ptr<void> Begin(const std::string& step, const std::string& words) {
    step_ = step;
    return options_.on_step ? options_.on_step(step, words) : nullptr;
  }

  // Returns places, models and fluxes from which the whole problem needs only a few steps. With photos, the
  // measured indirect light is held. Readings alone need the radiosity.
  LightState StartByParts() {
    const bool photos = !result_.data.observations.empty();
    LightData data = photos ? WithMeasuredIndirect(room_, result_.data) : result_.data;
    result_.data.checkpoint = data.checkpoint = CheckpointOf(options_.stop_reason, rounds_);
    {
      const auto step = Begin("guess", "where the luminaires may be");
      start_ = StartFit(room_, given_, light_, data, result_.findings);
      result_.luminaire_found = start_.luminaire_found;
    }
    best_ = start_.state;
    LightState state = start_.state;
    // Without readings, the camera's scale is given or follows from a known flux.
    if (photos) state.camera_scale_free = state.camera_scale_free && start_.flux_known;
    if (photos) state.meter_scale_free = false;
    LightData part = data;
    part.observations = ThinElements(data.observations, options_.max_elements_to_choose);
    FitLuminairesOptions quick;
    quick.covariance = false;
    quick.has_texture = false;
    quick.on_round = KeepBest();
    LuminaireFit fit = FitLuminaires(room_, part, state, Priors(), quick);
    if (photos && fit.status != FitStatus::kNoData) {
      const auto lit = WithTwoSides(room_, data, fit.state, OpenDistributions(), Priors());
      if (lit) fit = FitLuminaires(room_, part, *lit, Priors(), quick);
    }
    quick.has_texture = true;
    if (fit.status == FitStatus::kNoData) return start_.state;
    if (photos) {
      // The radiosity is solved here, so that the models are compared with its indirect light.
      part.observations = ThinElements(result_.data.observations, options_.max_elements_to_choose / 2);
      part.indirect_is_held = false;
      quick.steps_by_direct_light = true;
      fit = FitLuminaires(room_, part, fit.state, Priors(), quick);
      is_textured_ = IsTextured(fit);
      data = WithoutTexture(room_, WithModelledIndirect(room_, result_.data, fit.state), fit, Priors());
    }
    if (!fit.IsUsable()) return start_.state;
    const SeveralStarts starts =
        FitFromSeveralStarts(room_, data, fit.state, start_.rivals, start_.priors, SeenPriors());
    starts_ = starts.comparisons;
    best_ = starts.state;
    result_.data.outlines = OutlinesOf(given_, start_.luminaire_found, starts.state);
    const LightState shown = AtOutlines(room_, result_.data.outlines, starts.state);
    data.outlines = TellingOutlines(result_.data.outlines, shown);
    const LightState chosen = ChooseModels(data, shown);
    state = WithNamesInOrder(given_, chosen);
    FollowNames(chosen, state);
    result_.data.outlines = shown_ = OutlinesOf(given_, start_.luminaire_found, state);
    state.camera_scale_free = start_.state.camera_scale_free;
    state.meter_scale_free = start_.state.meter_scale_free;
    return state;
  }

  // Returns what is known beside the data.
  std::vector<ParameterPrior> Priors() const {
    std::vector<ParameterPrior> priors = start_.priors;
    for (const ParameterPrior& prior : SeenPriors()) priors.push_back(prior);
    return priors;
  }

  // Returns the places from which photos start luminaires, of those whose places no outline tells.
  std::vector<ParameterPrior> SeenPriors() const {
    std::vector<ParameterPrior> priors;
    std::set<int> outlined;
    for (const LuminaireOutline& outline : result_.data.outlines) outlined.insert(outline.luminaire);
    for (int k = 0; k < static_cast<int>(start_.seen.size()); ++k) {
      const std::optional<SeenPlace>& place = start_.seen[static_cast<size_t>(k)];
      if (!place || outlined.count(k) > 0 || !start_.state.free[static_cast<size_t>(k)].position) continue;
      for (int axis = 0; axis < 3; ++axis)
        priors.push_back({ParameterKind::kLuminaire, k, static_cast<LuminaireQuantity>(axis),
                          place->position[axis], place->sigma_m});
    }
    return priors;
  }

  // Names what was compared of luminaires, and where photos show them, as they are named now.
  void FollowNames(const LightState& before, const LightState& after) {
    const auto named = [&](size_t luminaire) {
      const Eigen::Vector3d& place = before.luminaires[luminaire].position;
      return std::find_if(after.luminaires.begin(), after.luminaires.end(),
                          [&](const Luminaire& l) { return l.position == place; }) -
             after.luminaires.begin();
    };
    for (StartComparison& c : starts_)
      c.luminaire = static_cast<int>(named(static_cast<size_t>(c.luminaire)));
    const std::vector<std::optional<SeenPlace>> seen = start_.seen;
    for (size_t k = 0; k < seen.size(); ++k) start_.seen[static_cast<size_t>(named(k))] = seen[k];
  }

  // Records where several places explain a luminaire's light, and which of them no photo settles.
  void RecordAmbiguity() {
    for (const StartComparison& c : starts_) {
      const bool is_settled = c.rivals.empty() || is_seen_.count(c.luminaire) > 0;
      RecordStarts(given_, c, is_settled, result_.findings);
      if (is_settled) continue;
      AmbiguousPlace place{c.luminaire, c.end[static_cast<size_t>(c.chosen)], {}};
      for (const int rival : c.rivals) place.rivals.push_back(c.end[static_cast<size_t>(rival)]);
      result_.ambiguous.push_back(std::move(place));
    }
  }

  // Returns by luminaire whether nothing is known of its distribution.
  std::vector<bool> OpenDistributions() const {
    std::vector<bool> open;
    open.reserve(given_.luminaires.size());
    for (size_t k = 0; k < given_.luminaires.size(); ++k)
      open.push_back(result_.luminaire_found[k] &&
                     given_.luminaires[k].photometry == KnownPhotometry::kNothing);
    return open;
  }

  LightState ChooseModels(const LightData& data, const LightState& state) {
    const auto step = Begin("choose", "the simplest model of each luminaire that the data support");
    for (size_t k = 0; k < state.luminaires.size(); ++k) {
      const KnownLuminaire& known = given_.luminaires[k];
      const bool found = result_.luminaire_found[k];
      held_.push_back({state.free[k].tilt ? Eigen::Vector3d(0, 0, -1) : state.luminaires[k].aim,
                       state.luminaires[k].heading});
      open_.push_back({found && known.photometry == KnownPhotometry::kNothing,
                       found && !known.shape_is_known && known.photometry != KnownPhotometry::kFile,
                       found && !known.aim.has_value(),
                       found && !known.shape_is_known && !known.heading.has_value(), RefinementsOf(k)});
    }
    const LightState typed = TypedBySwitching(data, state, open_, start_.seen);
    const ModelChoice choice = ChooseLuminaireModels(
        room_, data, typed, open_, Priors(), SeenPlacesOfTypes(given_.seen, data, typed, start_.seen));
    for (const PlacesChoice& c : choice.places) {
      RecordPlaces(given_, c, result_.findings);
      if (!c.is_seen) continue;
      is_seen_.insert(c.luminaires.begin(), c.luminaires.end());
    }
    for (const LuminaireChoice& c : choice.choices) RecordChoice(given_, c, result_.findings);
    for (const AimChoice& c : choice.aims)
      RecordAim(given_, c, state.luminaires[static_cast<size_t>(c.luminaire)].aim, result_.findings);
    for (const Refinement& r : choice.refinements) RecordRefinement(given_, r, result_.findings);
    if (!choice.stop_reason.empty()) {
      best_ = choice.state;
      throw FitStopped(choice.stop_reason);
    }
    for (const Contradiction& c : FindContradictions(room_, data, choice.state, open_, Priors()))
      WarnOfContradiction(given_, c, result_.findings);
    return WithSidesAlike(choice.state, open_);
  }

  // Compares finer and coarser models at the fitted state. A material that fits as well in grey becomes grey.
  void CompareDetails(const LuminaireFit& fit) {
    const auto step = Begin("detail", "");
    RecordDetail(CompareDetail(room_, result_.data, fit, Priors()), taken_, result_.findings);
    RecordColours(given_, room_, AddColours(room_, given_, light_.balance, fit, result_), result_.findings);
  }

  LuminaireFit Refine(const LightState& start) {
    const auto step = Begin("refine", "the whole problem, interreflection solved");
    const WholeProblem problem = {
        open_, held_, is_textured_, options_.max_elements_to_choose, [this] { return Priors(); }, KeepBest()};
    WholeFit whole = FitWhole(room_, given_, start, problem, result_.data, result_.findings);
    taken_ = std::move(whole.taken);
    return std::move(whole.fit);
  }

  // Returns which refinements of the luminaire's simple model are open.
  OpenRefinements RefinementsOf(size_t k) const {
    const KnownLuminaire& known = given_.luminaires[k];
    const Luminaire& start = start_.state.luminaires[k];
    OpenRefinements open;
    if (!result_.luminaire_found[k] || known.is_held) return open;
    const bool is_file = known.photometry == KnownPhotometry::kFile;
    open.heading = is_file && !known.heading && !IsSymmetricAboutAim(*start.table);
    open.table_asked_for = known.photometry == KnownPhotometry::kTableOpen;
    open.aim = (is_file || open.table_asked_for) && !known.aim;
    open.table = known.photometry == KnownPhotometry::kNothing || open.table_asked_for;
    // While the walls are unknown, finer models of the luminaire would absorb their share of the light.
    if (AsksForDirectShare()) {
      open.table = open.table_asked_for;
      return open;
    }
    open.emission = !is_file && known.photometry != KnownPhotometry::kTable &&
                    known.luminaire.emission.size() == 0 &&
                    (!known.shape_is_known || known.luminaire.shape == LuminaireShape::kRectangle);
    return open;
  }

  // Returns whether free reflectances rest on readings alone.
  bool AsksForDirectShare() const {
    return result_.data.observations.empty() && light_.used_readings > 0 &&
           std::count(start_.state.albedo_free.begin(), start_.state.albedo_free.end(), true) > 0;
  }

  // Photos alone give fluxes up to one common factor. A reading, a known flux or a calibrated camera sets it.
  void SettleScale(LightState& state) {
    result_.absolute = light_.used_readings > 0 || start_.flux_known || !state.camera_scale_free;
    if (!result_.absolute) {
      state.camera_scale_free = false;
      result_.findings.AddUndetermined(
          {"scale_undetermined",
           "the fluxes of all luminaires and the camera's scale are known only up to one common factor",
           "name one reading in luxmeter.scale, at a place in the room, or give camera.cdm2_per_count_s or "
           "one "
           "flux_lm with its sigma"});
    }
    result_.is_scaled_by_readings = light_.used_readings > 0 && !start_.flux_known && state.camera_scale_free;
    if (light_.used_readings > 0 && state.camera_scale_free)
      state = WithMatchedScale(room_, given_, result_.data, std::move(state));
    is_scale_settled_ = true;
  }

  const Room& room_;
  const RoomObservations& given_;
  const FitRoomOptions& options_;
  RoomLight light_;
  RoomFit result_;
  FitStart start_;
  std::atomic<int> rounds_ = 0;
  std::string step_;  // that is under way
  LightState best_;   // of all luminaires, so far
  bool is_scale_settled_ = false;
  std::vector<OpenChoice> open_;
  std::vector<StartComparison> starts_;
  std::vector<LuminaireOutline> shown_;  // what photos show of luminaires, explained or not
  std::set<int> is_seen_;                // luminaires whose places photos tell
  bool is_textured_ = false;             // elements depart from their materials
  TakenRows taken_;                      // elements of the last fit
  std::vector<HeldDirections> held_;     // by luminaire, before aims and headings were chosen
};

}  // namespace

RoomFit FitAsGiven(const Room& room, const RoomObservations& observations, const FitRoomOptions& options) {
  return RoomFitter(room, observations, options).Run();
}

}  // namespace luxfit
