#include "inverse/fit/fit_room.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "forward/luminaire/photometry.h"
#include "inverse/albedo/internal/albedo_rgb.h"
#include "inverse/choose/internal/choose_bodies.h"
#include "inverse/choose/internal/choose_colour.h"
#include "inverse/choose/internal/choose_model.h"
#include "inverse/choose/internal/colour_detail.h"
#include "inverse/choose/internal/contradiction.h"
#include "inverse/choose/internal/needless_parameters.h"
#include "inverse/choose/internal/profile_direct_share.h"
#include "inverse/choose/internal/scene_detail.h"
#include "inverse/choose/internal/several_starts.h"
#include "inverse/fit/internal/outlines.h"
#include "inverse/fit/internal/room_light.h"
#include "inverse/fit/internal/start.h"
#include "inverse/fit/internal/words.h"
#include "inverse/model/internal/light_model.h"
#include "inverse/model/internal/measured_indirect.h"

namespace luxfit {
namespace {

// Runs the steps in order. It is a class because each step adds to the same result.
class RoomFitter {
 public:
  RoomFitter(const Room& room, const RoomObservations& given, const FitRoomOptions& options)
      : room_(room), given_(given), options_(options), light_(LightOf(given)) {
    RecordReadings(given.meter, light_, result_.findings);
    result_.data = light_.data;
  }

  RoomFit Run() {
    const auto step = Begin(
        "fit", fmt::format("{} observations, {} readings to fit or scale, {} luminaires",
                           result_.data.observations.size(), light_.used_readings, given_.luminaires.size()));
    LightState state = StartByParts();
    SettleScale(state);
    LuminaireFit fit = FitToAll(state);
    if (fit.IsUsable() && AsksForDirectShare()) {
      result_.direct_share = ProfileDirectShare(room_, result_.data, fit, open_, start_.priors);
      RecordDirectShare(*result_.direct_share, result_.findings);
    }
    result_.albedo_rgb = EstimateAlbedoRgb(room_, result_.data, fit);
    CompareDetails(fit);
    result_.fit = std::move(fit);
    WarnOfMisfit(room_, result_, result_.findings);
    RecordOutcome(given_, result_.fit, result_.findings);
    return std::move(result_);
  }

 private:
  // Announces a step. The caller holds the returned token until the step ends.
  std::shared_ptr<void> Begin(const std::string& step, const std::string& words) const {
    return options_.on_step ? options_.on_step(step, words) : nullptr;
  }

  // Returns places, models and fluxes from which the whole problem needs only a few steps. With photos, the
  // measured indirect light is held. Readings alone need the radiosity.
  LightState StartByParts() {
    const bool photos = !result_.data.observations.empty();
    LightData data = photos ? WithMeasuredIndirect(room_, result_.data) : result_.data;
    {
      const auto step = Begin("guess", "where the luminaires may be");
      start_ = StartFit(room_, given_, light_, data, result_.findings);
      result_.luminaire_found = start_.luminaire_found;
    }
    LightState state = start_.state;
    // Without readings, the camera's scale is given or follows from a known flux.
    if (photos) state.camera_scale_free = state.camera_scale_free && start_.flux_known;
    if (photos) state.meter_scale_free = false;
    LightData part = data;
    part.observations = ThinElements(data.observations, options_.max_elements_to_choose);
    FitLuminairesOptions quick;
    quick.covariance = false;
    LuminaireFit fit = FitLuminaires(room_, part, state, start_.priors, quick);
    if (fit.status == FitStatus::kNoData) return start_.state;
    if (photos) {
      // The radiosity is solved here, so that the models are compared with its indirect light.
      part.observations = ThinElements(result_.data.observations, options_.max_elements_to_choose / 2);
      part.indirect_is_held = false;
      fit = FitLuminaires(room_, part, fit.state, start_.priors, quick);
      data = WithModelledIndirect(room_, result_.data, fit.state);
    }
    if (!fit.IsUsable()) return start_.state;
    const SeveralStarts starts = FitFromSeveralStarts(room_, data, fit.state, start_.rivals, start_.priors);
    for (const StartComparison& c : starts.comparisons) RecordStarts(given_, c, result_.findings);
    result_.data.outlines = data.outlines = OutlinesOf(given_, start_.luminaire_found, starts.state);
    state = ChooseModels(data, starts.state);
    state.camera_scale_free = start_.state.camera_scale_free;
    state.meter_scale_free = start_.state.meter_scale_free;
    return state;
  }

  LightState ChooseModels(const LightData& data, const LightState& state) {
    const auto step = Begin("choose", "the simplest model of each luminaire that the data support");
    for (size_t k = 0; k < state.luminaires.size(); ++k) {
      const KnownLuminaire& known = given_.luminaires[k];
      const bool found = result_.luminaire_found[k];
      held_.push_back({state.luminaires[k].aim, state.luminaires[k].heading});
      open_.push_back({found && known.photometry == KnownPhotometry::kNothing,
                       found && !known.shape_is_known && known.photometry != KnownPhotometry::kFile,
                       found && !known.aim.has_value(),
                       found && !known.shape_is_known && !known.heading.has_value(), RefinementsOf(k)});
    }
    const ModelChoice choice = ChooseLuminaireModels(room_, data, state, open_, start_.priors);
    for (const LuminaireChoice& c : choice.choices) RecordChoice(given_, c, result_.findings);
    for (const AimChoice& c : choice.aims)
      RecordAim(given_, c, state.luminaires[static_cast<size_t>(c.luminaire)].aim, result_.findings);
    for (const Refinement& r : choice.refinements) RecordRefinement(given_, r, result_.findings);
    for (const Contradiction& c : FindContradictions(room_, data, choice.state, open_, start_.priors))
      WarnOfContradiction(given_, c, result_.findings);
    return choice.state;
  }

  // Compares finer and coarser models at the fitted state. A material that fits as well in grey becomes grey.
  void CompareDetails(const LuminaireFit& fit) {
    const auto step = Begin("detail", "");
    RecordDetail(CompareDetail(room_, result_.data, fit), result_.findings);
    const ColourDetail colours = CompareColours(room_, result_.data, fit);
    RecordColours(given_, room_, colours, result_.findings);
    if (!colours.luminaires.among.empty() && colours.luminaires.chosen != 0) result_.tint_rgb = colours.tint;
    for (size_t m = 0; m < colours.materials.size(); ++m) {
      const Eigen::Index material = static_cast<Eigen::Index>(m);
      if (!colours.materials[m].among.empty() && colours.materials[m].chosen == 0)
        result_.albedo_rgb.col(material).setConstant(fit.state.albedo[material]);
    }
  }

  // Turns a luminaire into a point where its size has shrunk to nothing.
  LightState WithoutVanishedSizes(LightState state) {
    for (size_t k = 0; k < state.luminaires.size(); ++k) {
      Luminaire& luminaire = state.luminaires[k];
      if (!state.free[k].size || !HasVanished(luminaire)) continue;
      result_.findings.choices.push_back(
          {"shape of " + luminaire.id,
           "point",
           {ToString(luminaire.shape), "point"},
           "its size shrank to nothing in the fit of all luminaires together"});
      luminaire.shape = LuminaireShape::kPoint;
      luminaire.size_m.setZero();
      state.free[k].size = false;
    }
    return state;
  }

  // Fits the whole problem: to a part of the elements until nothing moves, then to all of them.
  LuminaireFit FitToAll(const LightState& start) {
    const auto step = Begin("refine", "the whole problem, interreflection solved");
    LightData part = result_.data;
    part.observations = ThinElements(result_.data.observations, options_.max_elements_to_choose);
    const LightState sized = WithSeenSizes(open_, part.outlines, start, result_.findings);
    LuminaireFit near = FitLuminaires(room_, part, sized, start_.priors, OfPart());
    if (near.status == FitStatus::kNoData) return near;
    near = WithoutUnexplained(part, std::move(near));
    near = WithoutNeedless(part, std::move(near));
    const ColourChoice colour =
        ChooseColour(room_, part, near, EstimateAlbedoRgb(room_, part, near), start_.priors);
    RecordTransportColour(colour, result_.findings);
    const BodyChoice bodies = ChooseBodies(room_, part, colour.fit, start_.priors);
    RecordBodies(bodies, result_.findings);
    FitLuminairesOptions options;
    options.start_is_near = true;
    options.initial_relative_sigma = bodies.relative_sigma;
    // Errors of neighbours are alike: more rows of a facet do not tell more.
    const double thinning = static_cast<double>(result_.data.observations.size()) /
                            std::max(1.0, static_cast<double>(part.observations.size()));
    options.photo_design_effect = 1 + (colour.fit.photo_design_effect - 1) * thinning;
    return FitLuminaires(room_, result_.data, bodies.state, start_.priors, options);
  }

  // Takes outlines that the fit does not explain out of the data, and fits again without them.
  LuminaireFit WithoutUnexplained(LightData& part, LuminaireFit fit) {
    result_.data.outlines = ExplainedOutlines(given_, part, fit, result_.findings);
    if (result_.data.outlines.size() == part.outlines.size()) return fit;
    part.outlines = result_.data.outlines;
    return FitLuminaires(room_, part, fit.state, start_.priors, OfPart(&fit));
  }

  // `near`: a fit to the same part, from which the fit starts.
  static FitLuminairesOptions OfPart(const LuminaireFit* near = nullptr) {
    FitLuminairesOptions options;
    options.subtracts_discretisation = false;
    if (near == nullptr) return options;
    options.start_is_near = true;
    options.initial_relative_sigma = near->relative_sigma;
    options.photo_design_effect = near->photo_design_effect;
    return options;
  }

  LuminaireFit WithoutNeedless(const LightData& part, LuminaireFit fit) {
    SimplifiedState simplified = WithoutNeedlessParameters(fit, open_, held_);
    RecordNeedless(given_, simplified.needless, result_.findings);
    if (!simplified.needless.empty())
      fit = FitLuminaires(room_, part, simplified.state, start_.priors, OfPart(&fit));
    fit.state = WithoutVanishedSizes(fit.state);
    return fit;
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
      result_.findings.undetermined = true;
      result_.findings.warnings.push_back(
          {"scale_undetermined",
           "the fluxes of all luminaires and the camera's scale are known only up to one common factor",
           "name one reading in luxmeter.scale, or give camera.cdm2_per_count_s or one flux_lm with its "
           "sigma"});
    }
    if (light_.used_readings > 0 && state.camera_scale_free) MatchScale(state);
  }

  // Scales the fluxes to the readings by one linear factor, solved exactly.
  void MatchScale(LightState& state) const {
    LightData readings;
    readings.dimming = result_.data.dimming;
    for (const Reading& reading : result_.data.readings) {
      if (reading.used) readings.readings.push_back(reading);
    }
    LightModel model(room_, readings);
    model.FreezeVisibility(state);
    const double modelled = model.Predict(state, {}, false).value.sum();
    double measured = 0;
    for (const Reading& reading : readings.readings) measured += reading.illuminance_lx;
    if (!(measured > 0) || !(modelled > 0)) return;
    for (size_t k = 0; k < state.luminaires.size(); ++k) {
      if (state.free[k].flux && !given_.luminaires[k].flux_lm)
        state.luminaires[k].flux_lm *= measured / modelled;
    }
    state.camera_scale *= modelled / measured;
  }

  const Room& room_;
  const RoomObservations& given_;
  const FitRoomOptions& options_;
  RoomLight light_;
  RoomFit result_;
  FitStart start_;
  std::vector<OpenChoice> open_;
  std::vector<HeldDirections> held_;  // by luminaire, before aims and headings were chosen
};

void ExpectWhole(const Room& room, const RoomObservations& given) {
  const auto expect = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(std::string("FitRoom: expected ") + what);
  };
  expect(!given.luminaires.empty(), "at least one luminaire");
  expect(!given.dimming.empty(), "at least one state");
  for (const Eigen::VectorXd& dimming : given.dimming)
    expect(dimming.size() == static_cast<Eigen::Index>(given.luminaires.size()),
           "one dimming a luminaire in each state");
  const int states = static_cast<int>(given.dimming.size());
  for (const MeterReading& reading : given.meter.readings)
    expect(reading.state >= 0 && reading.state < states && reading.sensor_index < given.meter.sensor_count,
           "readings of known states and sensors");
  expect(given.albedo.empty() || given.albedo.size() == room.scene.materials.size(),
         "one albedo a material, or none");
  const bool has_used = std::any_of(given.meter.readings.begin(), given.meter.readings.end(),
                                    [](const MeterReading& r) { return r.used; });
  expect(!given.observations.empty() || has_used, "observations or readings to fit to");
}

}  // namespace

RoomFit FitRoom(const Room& room, const RoomObservations& observations, const FitRoomOptions& options) {
  ExpectWhole(room, observations);
  return RoomFitter(room, observations, options).Run();
}

}  // namespace luxfit
