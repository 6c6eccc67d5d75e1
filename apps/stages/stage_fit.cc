#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/stages/internal/fit_start.h"
#include "apps/stages/internal/fit_words.h"
#include "apps/stages/internal/light_data.h"
#include "apps/stages/stages.h"
#include "forward/luminaire/photometry.h"
#include "inverse/albedo/albedo_rgb.h"
#include "inverse/choose/contradiction.h"
#include "inverse/choose/several_starts.h"
#include "inverse/model/measured_indirect.h"

namespace luxfit {
namespace {

// Observed elements used until the models are chosen: positions are then known to a few millimetres.
constexpr int kMaxElementsToChoose = 2000;
// Everything between session and inversion; a class because each step adds to the same few things.
class FitStage {
 public:
  FitStage(const Session& session, const Room& room, const SessionObservations& observed, RunContext& context)
      : session_(session),
        room_(room),
        seen_(observed.seen),
        context_(context),
        light_(LightOf(session, observed.observations)) {
    RecordReadings(session, light_, context);
    result_.data = light_.data;
  }

  SessionFit Run() {
    const StageTimer timer(
        context_, "fit",
        fmt::format("{} observations, {} readings to fit or scale, {} luminaires",
                    result_.data.observations.size(), light_.used_readings, session_.luminaires.size()));
    LightState state = StartByParts();
    SettleScale(state);
    LuminaireFit fit = FitToAll(state);
    if (fit.IsUsable() && AsksForDirectShare()) {
      result_.direct_share = ProfileDirectShare(room_, result_.data, fit, open_, start_.priors);
      RecordDirectShare(*result_.direct_share, context_);
    }
    result_.albedo_rgb = EstimateAlbedoRgb(room_, result_.data, fit);
    CompareDetails(fit);
    result_.fit = std::move(fit);
    WarnOfMisfit(room_, result_, context_);
    RecordOutcome(session_, result_.fit, context_);
    return std::move(result_);
  }

 private:
  // A start that needs no more than a few steps of the whole problem: places, models and fluxes of the
  // luminaires. Photos hold the indirect light that they measured for that; readings alone need the
  // radiosity.
  LightState StartByParts() {
    const bool photos = !result_.data.observations.empty();
    LightData data = photos ? WithMeasuredIndirect(room_, result_.data) : result_.data;
    {
      const StageTimer timer(context_, "guess", "where the luminaires may be");
      start_ = StartFit(session_, room_, light_, data, seen_, context_);
      result_.luminaire_found = start_.luminaire_found;
    }
    LightState state = start_.state;
    // Without readings, a flux tells the camera's scale, or it is given.
    if (photos) state.camera_scale_free = state.camera_scale_free && start_.flux_known;
    if (photos) state.meter_scale_free = false;
    LightData part = data;
    part.observations = ThinElements(data.observations, kMaxElementsToChoose);
    FitLuminairesOptions quick;
    quick.covariance = false;
    LuminaireFit fit = FitLuminaires(room_, part, state, start_.priors, quick);
    if (fit.status == FitStatus::kNoData) return start_.state;
    if (photos) {
      // With the radiosity solved, so that the models are compared in its light.
      part.observations = ThinElements(result_.data.observations, kMaxElementsToChoose / 2);
      part.indirect_is_held = false;
      fit = FitLuminaires(room_, part, fit.state, start_.priors, quick);
      data = WithModelledIndirect(room_, result_.data, fit.state);
    }
    if (!fit.IsUsable()) return start_.state;
    const SeveralStarts starts = FitFromSeveralStarts(room_, data, fit.state, start_.rivals, start_.priors);
    for (const StartComparison& c : starts.comparisons) RecordStarts(session_, c, context_);
    state = ChooseModels(data, starts.state);
    state.camera_scale_free = start_.state.camera_scale_free;
    state.meter_scale_free = start_.state.meter_scale_free;
    return state;
  }

  LightState ChooseModels(const LightData& data, const LightState& state) {
    const StageTimer timer(context_, "choose", "the simplest model of each luminaire that the data support");
    for (size_t k = 0; k < state.luminaires.size(); ++k) {
      const SessionLuminaire& given = session_.luminaires[k];
      const bool found = result_.luminaire_found[k];
      open_.push_back({found && given.photometry == "auto",
                       found && !given.shape.has_value() && given.photometry_path.empty(),
                       found && !given.aim.has_value(), RefinementsOf(k)});
    }
    const ModelChoice choice = ChooseLuminaireModels(room_, data, state, open_, start_.priors);
    for (const LuminaireChoice& c : choice.choices) RecordChoice(session_, c, context_);
    for (const AimChoice& c : choice.aims)
      RecordAim(session_, c, state.luminaires[static_cast<size_t>(c.luminaire)].aim, context_);
    for (const Refinement& r : choice.refinements) RecordRefinement(session_, r, context_);
    for (const Contradiction& c : FindContradictions(room_, data, choice.state, open_, start_.priors))
      WarnOfContradiction(session_, c, context_);
    return choice.state;
  }

  // What detail the data ask for, at the fitted state; materials that are as good grey are given as grey.
  void CompareDetails(const LuminaireFit& fit) {
    const StageTimer timer(context_, "detail", "");
    RecordDetail(CompareDetail(room_, result_.data, fit), context_);
    const ColourDetail colours = CompareColours(room_, result_.data, fit);
    RecordColours(session_, room_, colours, context_);
    if (!colours.luminaires.among.empty() && colours.luminaires.chosen != 0) result_.tint_rgb = colours.tint;
    for (size_t m = 0; m < colours.materials.size(); ++m) {
      const Eigen::Index material = static_cast<Eigen::Index>(m);
      if (!colours.materials[m].among.empty() && colours.materials[m].chosen == 0)
        result_.albedo_rgb.col(material).setConstant(fit.state.albedo[material]);
    }
  }

  // A size that shrank to nothing beside the others' light is a point.
  LightState WithoutVanishedSizes(LightState state) {
    for (size_t k = 0; k < state.luminaires.size(); ++k) {
      Luminaire& luminaire = state.luminaires[k];
      if (!state.free[k].size || !HasVanished(luminaire)) continue;
      context_.choices.push_back({"shape of " + luminaire.id,
                                  "point",
                                  {ToString(luminaire.shape), "point"},
                                  "its size shrank to nothing in the fit of all luminaires together"});
      luminaire.shape = LuminaireShape::kPoint;
      luminaire.size_m.setZero();
      state.free[k].size = false;
    }
    return state;
  }

  // The whole problem: on a part of the elements until nothing moves, then on all of them.
  LuminaireFit FitToAll(const LightState& start) {
    const StageTimer timer(context_, "refine", "the whole problem, interreflection solved");
    LightData part = result_.data;
    part.observations = ThinElements(result_.data.observations, kMaxElementsToChoose);
    if (part.observations.size() == result_.data.observations.size())
      return FitLuminaires(room_, result_.data, start, start_.priors);
    FitLuminairesOptions options;
    options.covariance = false;
    LuminaireFit near = FitLuminaires(room_, part, start, start_.priors, options);
    if (near.status == FitStatus::kNoData) return near;
    const LightState refined = WithoutVanishedSizes(near.state);
    options.covariance = true;
    options.start_is_near = true;
    options.initial_relative_sigma = near.relative_sigma;
    return FitLuminaires(room_, result_.data, refined, start_.priors, options);
  }

  // What is open of a luminaire beyond its simple model.
  OpenRefinements RefinementsOf(size_t k) const {
    const SessionLuminaire& given = session_.luminaires[k];
    const Luminaire& start = start_.state.luminaires[k];
    OpenRefinements open;
    if (!result_.luminaire_found[k] || given.is_held) return open;
    const bool is_file = !given.photometry_path.empty();
    open.heading = is_file && !given.heading && !IsSymmetricAboutAim(*start.table);
    open.table_asked_for = given.photometry == "table" && given.gamma_deg.empty();
    open.aim = (is_file || open.table_asked_for) && !given.aim;
    open.table = given.photometry == "auto" || open.table_asked_for;
    // Finer models of the lamp would take up what is the walls', while these are not known.
    if (AsksForDirectShare()) {
      open.table = open.table_asked_for;
      return open;
    }
    open.emission = given.photometry_path.empty() && given.emission.size() == 0 &&
                    given.shape.value_or("rectangle") == "rectangle" && given.gamma_deg.empty();
    return open;
  }

  // Reflectances that only readings speak of.
  bool AsksForDirectShare() const {
    return result_.data.observations.empty() && light_.used_readings > 0 &&
           std::count(start_.state.albedo_free.begin(), start_.state.albedo_free.end(), true) > 0;
  }

  // Photos alone give fluxes up to one common factor: it needs a reading, a known flux, or a calibrated
  // camera.
  void SettleScale(LightState& state) {
    result_.absolute = light_.used_readings > 0 || start_.flux_known || !state.camera_scale_free;
    if (!result_.absolute) {
      state.camera_scale_free = false;
      context_.undetermined = true;
      context_.warnings.push_back(
          {"scale_undetermined",
           "the fluxes of all luminaires and the camera's scale are known only up to one common factor",
           "name one reading in luxmeter.scale, or give camera.cdm2_per_count_s or one flux_lm with its "
           "sigma"});
    }
    if (light_.used_readings > 0 && state.camera_scale_free) MatchScale(state);
  }

  // Fluxes in the readings' scale: one linear factor, solved exactly.
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
      if (state.free[k].flux && !session_.luminaires[k].flux_lm)
        state.luminaires[k].flux_lm *= measured / modelled;
    }
    state.camera_scale *= modelled / measured;
  }

  const Session& session_;
  const Room& room_;
  const std::vector<SeenPlace>& seen_;
  RunContext& context_;
  SessionLight light_;
  SessionFit result_;
  FitStart start_;
  std::vector<OpenChoice> open_;
};

// Parameters as fitted (logarithms as such) with their whole covariance, for those who propagate it further.
void WriteArtifact(const LuminaireFit& fit, const RunContext& context) {
  nlohmann::json artifact = ProvenanceJson("luxfit-fit-1", context.provenance);
  artifact["message"] = fit.message;
  artifact["outer_iterations"] = fit.outer_iterations;
  artifact["relative_model_error"] = fit.relative_sigma;
  artifact["undetermined"] = fit.undetermined;
  artifact["parameters"] = nlohmann::json::array();
  const Eigen::VectorXd x = PackParameters(fit.state, fit.parameters);
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const Parameter& p = fit.parameters[i];
    artifact["parameters"].push_back({{"name", p.name},
                                      {"value", x[static_cast<Eigen::Index>(i)]},
                                      {"lower", p.lower},
                                      {"upper", p.upper}});
  }
  artifact["covariance"] = nlohmann::json::array();
  for (const auto row : fit.covariance.rowwise())
    artifact["covariance"].push_back(std::vector<double>(row.begin(), row.end()));
  WriteJson(context.out + "/stages/fit.json", artifact);
}

}  // namespace

SessionFit FitSession(const Session& session, const Room& room, const SessionObservations& observed,
                      RunContext& context) {
  if (session.luminaires.empty()) {
    throw std::runtime_error(session.path +
                             ": states: expected the luminaires of at least one state, got none; add "
                             "[states] such as A = { A = 1.0 }");
  }
  const auto& readings = session.luxmeter.readings;
  const bool fitted = std::any_of(readings.begin(), readings.end(),
                                  [](const SessionReading& r) { return r.role == ReadingRole::kFit; });
  if (observed.observations.empty() && !fitted) {
    throw std::runtime_error(session.path +
                             ": expected something to fit to, got neither photos nor readings; add [photos], "
                             "or fit = [\"*\"] to [luxmeter]");
  }
  SessionFit fit = FitStage(session, room, observed, context).Run();
  WriteArtifact(fit.fit, context);
  return fit;
}

}  // namespace luxfit
