#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "apps/fit_words.h"
#include "apps/given_luminaire.h"
#include "apps/light_data.h"
#include "apps/stages.h"
#include "forward/photometry.h"
#include "inverse/albedo_rgb.h"
#include "inverse/contradiction.h"
#include "inverse/first_guess.h"
#include "inverse/measured_indirect.h"
#include "inverse/several_starts.h"

namespace luxfit {
namespace {

// Observed elements used until the models are chosen: positions are then known to a few millimetres.
constexpr int kMaxElementsToChoose = 2000;
// A material with fewer observed elements is as good as unseen.
constexpr int kMinElementsOfMaterial = 3;

// Of a table that is asked for, until its strength is chosen.
constexpr double kStartTableSigma = 0.1;

// Everything between session and inversion; a class because each step adds to the same few things.
class FitStage {
 public:
  FitStage(const Session& session, const Room& room, const SessionObservations& observed, RunContext& context)
      : session_(session), room_(room), seen_(observed.seen), context_(context) {
    SessionLight light = LightOf(session, observed.observations);
    RecordReadings(session, light, context);
    result_.data = std::move(light.data);
    priors_ = std::move(light.priors);
    used_readings_ = light.used_readings;
    start_.meter_scale_free = light.meter_scale_free;
    start_.sensor_gain = light.sensor_gain;
    start_.sensor_gains_free = light.sensor_gains_free;
    FillKnown();
  }

  SessionFit Run() {
    const StageTimer timer(
        context_, "fit",
        fmt::format("{} observations, {} readings to fit or scale, {} luminaires",
                    result_.data.observations.size(), used_readings_, session_.luminaires.size()));
    LightState state = StartByParts();
    SettleScale(state);
    LuminaireFit fit = FitToAll(state);
    if (fit.IsUsable() && AsksForDirectShare()) {
      result_.direct_share = ProfileDirectShare(room_, result_.data, fit, open_, priors_);
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
      Start(data);
    }
    LightState state = start_;
    // Without readings, a flux tells the camera's scale, or it is given.
    if (photos) state.camera_scale_free = state.camera_scale_free && flux_known_;
    if (photos) state.meter_scale_free = false;
    LightData part = data;
    part.observations = ThinElements(data.observations, kMaxElementsToChoose);
    FitLuminairesOptions quick;
    quick.covariance = false;
    LuminaireFit fit = FitLuminaires(room_, part, state, priors_, quick);
    if (fit.status == FitStatus::kNoData) return start_;
    if (photos) {
      // With the radiosity solved, so that the models are compared in its light.
      part.observations = ThinElements(result_.data.observations, kMaxElementsToChoose / 2);
      part.indirect_is_held = false;
      fit = FitLuminaires(room_, part, fit.state, priors_, quick);
      data = WithModelledIndirect(room_, result_.data, fit.state);
    }
    if (!fit.IsUsable()) return start_;
    const SeveralStarts starts = FitFromSeveralStarts(room_, data, fit.state, rivals_, priors_);
    for (const StartComparison& c : starts.comparisons) RecordStarts(session_, c, context_);
    state = ChooseModels(data, starts.state);
    state.camera_scale_free = start_.camera_scale_free;
    state.meter_scale_free = start_.meter_scale_free;
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
    const ModelChoice choice = ChooseLuminaireModels(room_, data, state, open_, priors_);
    for (const LuminaireChoice& c : choice.choices) RecordChoice(session_, c, context_);
    for (const AimChoice& c : choice.aims)
      RecordAim(session_, c, state.luminaires[static_cast<size_t>(c.luminaire)].aim, context_);
    for (const Refinement& r : choice.refinements) RecordRefinement(session_, r, context_);
    for (const Contradiction& c : FindContradictions(room_, data, choice.state, open_, priors_))
      WarnOfContradiction(session_, c, context_);
    return choice.state;
  }

  // What detail the data ask for, at the fitted state; materials that are as good grey are given as grey.
  void CompareDetails(const LuminaireFit& fit) {
    const StageTimer timer(context_, "detail", "");
    RecordDetail(CompareDetail(room_, result_.data, fit), context_);
    const ColourDetail colours = CompareColours(room_, result_.data, fit);
    RecordColours(session_, room_, colours, context_);
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
      return FitLuminaires(room_, result_.data, start, priors_);
    FitLuminairesOptions options;
    options.covariance = false;
    LuminaireFit near = FitLuminaires(room_, part, start, priors_, options);
    if (near.status == FitStatus::kNoData) return near;
    const LightState refined = WithoutVanishedSizes(near.state);
    options.covariance = true;
    options.start_is_near = true;
    options.initial_relative_sigma = near.relative_sigma;
    return FitLuminaires(room_, result_.data, refined, priors_, options);
  }

  // What is open of a luminaire beyond its simple model.
  OpenRefinements RefinementsOf(size_t k) const {
    const SessionLuminaire& given = session_.luminaires[k];
    const Luminaire& start = start_.luminaires[k];
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
    return result_.data.observations.empty() && used_readings_ > 0 &&
           std::count(start_.albedo_free.begin(), start_.albedo_free.end(), true) > 0;
  }

  // Reflectances, camera scale: known, to be estimated, or out of reach.
  void FillKnown() {
    const std::vector<std::string>& materials = room_.scene.materials;
    std::vector<std::set<int>> seen(materials.size());
    for (const Observation& o : result_.data.observations) {
      const int patch = room_.patches.elements[static_cast<size_t>(o.element)].patch;
      seen[static_cast<size_t>(room_.patches.patches[static_cast<size_t>(patch)].material)].insert(o.element);
    }
    start_.albedo = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(materials.size()), 0.5);
    start_.albedo_free.assign(materials.size(), false);
    for (size_t m = 0; m < materials.size(); ++m) {
      const bool observed = static_cast<int>(seen[m].size()) >= kMinElementsOfMaterial;
      const auto known = session_.scene->known_albedo_rgb.find(materials[m]);
      if (known != session_.scene->known_albedo_rgb.end()) {
        start_.albedo[static_cast<Eigen::Index>(m)] = LuminanceWeights(session_).dot(known->second);
      } else if (observed || (result_.data.observations.empty() && used_readings_ > 0)) {
        start_.albedo_free[m] = true;
      } else if (!result_.data.observations.empty()) {
        context_.warnings.push_back(
            {"material_unseen",
             fmt::format("the reflectance of \"{}\" is not determined: no photo shows it; 0.5 was "
                         "taken for the light that it reflects",
                         materials[m]),
             fmt::format("photograph it, or give scene.albedo.{}", materials[m])});
      }
    }
    start_.camera_scale_free = !result_.data.observations.empty();
    if (!session_.cameras.empty() && session_.cameras[0].cdm2_per_count_s > 0) {
      // Relative luminance 1 is full scale at 1 s.
      const double range_counts =
          session_.cameras[0].full_scale_counts - session_.cameras[0].black_level_counts;
      start_.camera_scale = 1 / (session_.cameras[0].cdm2_per_count_s * range_counts);
      start_.camera_scale_free = false;
    }
  }

  // `data`: with the indirect light that photos measured, or readings alone.
  void Start(const LightData& data) {
    std::vector<std::optional<Eigen::Vector3d>> known;
    for (const SessionLuminaire& luminaire : session_.luminaires) known.push_back(luminaire.position_m);
    const FirstGuess guess = IsAllHeld() ? NothingToGuess() : GuessLuminaires(room_, data, known, seen_);
    RecordFirstGuess(session_, guess, seen_, context_);
    MatchKnownFluxes(guess);
    for (const std::vector<int>& group : guess.groups) WarnOfInterchangeable(session_, group, context_);
    for (Eigen::Index m = 0; m < start_.albedo.size(); ++m) {
      if (start_.albedo_free[static_cast<size_t>(m)]) start_.albedo[m] = guess.albedo[m];
    }
    for (size_t k = 0; k < session_.luminaires.size(); ++k) AddLuminaire(guess, static_cast<int>(k));
    if (!guess.separable) {
      context_.warnings.push_back(
          {"luminaires_not_separated", "no start for luminaires without a given position: " + guess.message,
           "photograph each luminaire in at least one state without the others, or give position_m"});
    }
  }

  // Known fluxes tell the camera's scale, roughly: the guess has it as 1.
  void MatchKnownFluxes(const FirstGuess& guess) {
    double guessed = 0, known = 0;
    for (size_t k = 0; k < session_.luminaires.size(); ++k) {
      if (!session_.luminaires[k].flux_lm || !guess.luminaires[k].found) continue;
      guessed += guess.luminaires[k].flux;
      known += *session_.luminaires[k].flux_lm;
    }
    if (start_.camera_scale_free && guessed > 0 && known > 0) start_.camera_scale = guessed / known;
  }

  bool IsAllHeld() const {
    return !session_.luminaires.empty() && std::all_of(session_.luminaires.begin(), session_.luminaires.end(),
                                                       [](const SessionLuminaire& l) { return l.is_held; });
  }

  FirstGuess NothingToGuess() const {
    FirstGuess guess;
    guess.separable = true;
    guess.luminaires.resize(session_.luminaires.size());
    guess.albedo = start_.albedo;
    return guess;
  }

  void AddLuminaire(const FirstGuess& guess, int index) {
    const SessionLuminaire& given = session_.luminaires[static_cast<size_t>(index)];
    const LuminaireGuess& guessed = guess.luminaires[static_cast<size_t>(index)];
    const GivenLuminaire known = ReadGivenLuminaire(given);
    Luminaire luminaire = known.luminaire;
    FreeQuantities free;
    RecordGivenPhotometry(known, context_);
    free.table_sigma = given.photometry == "table" && given.gamma_deg.empty() ? kStartTableSigma : 0;
    const bool automatic = given.photometry == "auto";
    if (automatic && guessed.found) luminaire.cosine_exponent = std::max(1.0, guessed.cosine_exponent);
    free.exponent = luminaire.distribution == Distribution::kCosinePower;
    const bool size_known = luminaire.size_m[0] > 0;
    if (!size_known) luminaire.size_m.setConstant(0.3);
    free.size = luminaire.shape != LuminaireShape::kPoint && luminaire.shape != LuminaireShape::kSphere &&
                !size_known;
    luminaire.position = given.position_m.value_or(guessed.position);
    luminaire.flux_lm = given.flux_lm.value_or(guessed.flux / start_.camera_scale);
    if (!given.aim && guessed.found && given.photometry_path.empty()) luminaire.aim = guessed.aim;
    const bool found = guessed.found || given.position_m.has_value();
    constexpr double kAnyFluxLm =
        1000;  // of a known place, where the guess says nothing: a start, not a value
    if (found && !(luminaire.flux_lm > 0)) luminaire.flux_lm = kAnyFluxLm;
    if (!found) {
      // Without a place it gives no light, so that the others can still be fitted.
      luminaire.flux_lm = 1e-9;
      free = {false, false, false, false, false};
      context_.undetermined = true;
      context_.warnings.push_back(
          {"luminaire_undetermined",
           fmt::format("luminaire {} is not determined: the data show too little of its own light", given.id),
           fmt::format("photograph {} alone", given.id)});
    }
    free.position = found && !(given.position_sigma_m && *given.position_sigma_m == 0);
    free.flux = found && !(given.flux_sigma_lm && *given.flux_sigma_lm == 0);
    if (given.is_held) {
      free = {false, false, false, false, false};
      flux_known_ = true;
    }
    if (found && !given.is_held) AddPriors(given, index);
    if (!given.heading && !given.photometry_path.empty() && IsSymmetricAboutAim(*luminaire.table)) {
      context_.choices.push_back({"heading of " + given.id,
                                  "not estimated",
                                  {"not estimated", "estimated"},
                                  "its photometry is the same all round: no light tells a heading"});
    }
    result_.luminaire_found.push_back(found);
    rivals_.push_back(given.position_m ? std::vector<Luminaire>() : guessed.rivals);
    start_.luminaires.push_back(luminaire);
    start_.free.push_back(free);
  }

  void AddPriors(const SessionLuminaire& given, int index) {
    if (given.position_m && given.position_sigma_m.value_or(0) > 0) {
      for (int axis = 0; axis < 3; ++axis) {
        priors_.push_back({ParameterKind::kLuminaire, index, static_cast<LuminaireQuantity>(axis),
                           (*given.position_m)[axis], *given.position_sigma_m});
      }
    }
    if (given.flux_lm && given.flux_sigma_lm.value_or(0) > 0) {
      priors_.push_back({ParameterKind::kLogFlux,
                         index,
                         {},
                         std::log(*given.flux_lm),
                         *given.flux_sigma_lm / *given.flux_lm});
      flux_known_ = true;
    }
    flux_known_ = flux_known_ || (given.flux_lm && given.flux_sigma_lm.value_or(1) == 0);
  }

  // Photos alone give fluxes up to one common factor: it needs a reading, a known flux, or a calibrated
  // camera.
  void SettleScale(LightState& state) {
    result_.absolute = used_readings_ > 0 || flux_known_ || !state.camera_scale_free;
    if (!result_.absolute) {
      state.camera_scale_free = false;
      context_.undetermined = true;
      context_.warnings.push_back(
          {"scale_undetermined",
           "the fluxes of all luminaires and the camera's scale are known only up to one common factor",
           "name one reading in luxmeter.scale, or give camera.cdm2_per_count_s or one flux_lm with its "
           "sigma"});
    }
    if (used_readings_ > 0 && state.camera_scale_free) MatchScale(state);
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
  SessionFit result_;
  LightState start_;
  std::vector<std::vector<Luminaire>> rivals_;  // of each luminaire's first guess
  std::vector<OpenChoice> open_;
  std::vector<ParameterPrior> priors_;
  int used_readings_ = 0;
  bool flux_known_ = false;
};

// Parameters as fitted (logarithms as such) with their whole covariance, for those who propagate it further.
void WriteArtifact(const LuminaireFit& fit, const RunContext& context) {
  nlohmann::json json = ProvenanceJson("luxfit-fit-1", context.provenance);
  json["message"] = fit.message;
  json["outer_iterations"] = fit.outer_iterations;
  json["relative_model_error"] = fit.relative_sigma;
  json["undetermined"] = fit.undetermined;
  json["parameters"] = nlohmann::json::array();
  const Eigen::VectorXd x = PackParameters(fit.state, fit.parameters);
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const Parameter& p = fit.parameters[i];
    json["parameters"].push_back({{"name", p.name},
                                  {"value", x[static_cast<Eigen::Index>(i)]},
                                  {"lower", p.lower},
                                  {"upper", p.upper}});
  }
  json["covariance"] = nlohmann::json::array();
  for (const auto row : fit.covariance.rowwise())
    json["covariance"].push_back(std::vector<double>(row.begin(), row.end()));
  WriteJson(context.out + "/stages/fit.json", json);
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
