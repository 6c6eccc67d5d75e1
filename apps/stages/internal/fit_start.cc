#include "apps/stages/internal/fit_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>

#include "apps/stages/given_luminaire.h"
#include "apps/stages/internal/fit_words.h"
#include "forward/luminaire/photometry.h"
#include "inverse/model/first_guess.h"

namespace luxfit {
namespace {

// A material with fewer observed elements is as good as unseen.
constexpr int kMinElementsOfMaterial = 3;

// Of a table that is asked for, until its strength is chosen.
constexpr double kStartTableSigma = 0.1;

class Starter {
 public:
  Starter(const Session& session, const Room& room, const SessionLight& light, RunContext& context)
      : session_(session), room_(room), light_(light), context_(context) {
    start_.priors = light.priors;
    start_.state.meter_scale_free = light.meter_scale_free;
    start_.state.sensor_gain = light.sensor_gain;
    start_.state.sensor_gains_free = light.sensor_gains_free;
    FillKnown();
  }

  FitStart Run(const LightData& data, const std::vector<SeenPlace>& seen) {
    std::vector<std::optional<Eigen::Vector3d>> known;
    for (const SessionLuminaire& luminaire : session_.luminaires) known.push_back(luminaire.position_m);
    const FirstGuess guess = IsAllHeld() ? NothingToGuess() : GuessLuminaires(room_, data, known, seen);
    RecordFirstGuess(session_, guess, seen, context_);
    MatchKnownFluxes(guess);
    for (const std::vector<int>& group : guess.groups) WarnOfInterchangeable(session_, group, context_);
    for (Eigen::Index m = 0; m < start_.state.albedo.size(); ++m) {
      if (start_.state.albedo_free[static_cast<size_t>(m)]) start_.state.albedo[m] = guess.albedo[m];
    }
    for (size_t k = 0; k < session_.luminaires.size(); ++k) AddLuminaire(guess, static_cast<int>(k));
    if (!guess.separable) {
      context_.warnings.push_back(
          {"luminaires_not_separated", "no start for luminaires without a given position: " + guess.message,
           "photograph each luminaire in at least one state without the others, or give position_m"});
    }
    return std::move(start_);
  }

 private:
  // Reflectances, camera scale: known, to be estimated, or out of reach.
  void FillKnown() {
    const std::vector<std::string>& materials = room_.scene.materials;
    std::vector<std::set<int>> seen(materials.size());
    for (const Observation& o : light_.data.observations) {
      const int patch = room_.patches.elements[static_cast<size_t>(o.element)].patch;
      seen[static_cast<size_t>(room_.patches.patches[static_cast<size_t>(patch)].material)].insert(o.element);
    }
    const std::vector<std::optional<double>> known = KnownAlbedo(session_, room_);
    start_.state.albedo = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(materials.size()), 0.5);
    start_.state.albedo_free.assign(materials.size(), false);
    for (size_t m = 0; m < materials.size(); ++m) {
      const bool observed = static_cast<int>(seen[m].size()) >= kMinElementsOfMaterial;
      if (known[m]) {
        start_.state.albedo[static_cast<Eigen::Index>(m)] = *known[m];
      } else if (observed || (light_.data.observations.empty() && light_.used_readings > 0)) {
        start_.state.albedo_free[m] = true;
      } else if (!light_.data.observations.empty()) {
        context_.warnings.push_back(
            {"material_unseen",
             fmt::format("the reflectance of \"{}\" is not determined: no photo shows it; 0.5 was "
                         "taken for the light that it reflects",
                         materials[m]),
             fmt::format("photograph it, or give scene.albedo.{}", materials[m])});
      }
    }
    start_.state.camera_scale_free = !light_.data.observations.empty();
    if (!session_.cameras.empty() && session_.cameras[0].cdm2_per_count_s > 0) {
      // Relative luminance 1 is full scale at 1 s.
      const double range_counts =
          session_.cameras[0].full_scale_counts - session_.cameras[0].black_level_counts;
      start_.state.camera_scale = 1 / (session_.cameras[0].cdm2_per_count_s * range_counts);
      start_.state.camera_scale_free = false;
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
    if (start_.state.camera_scale_free && guessed > 0 && known > 0)
      start_.state.camera_scale = guessed / known;
  }

  bool IsAllHeld() const {
    return !session_.luminaires.empty() && std::all_of(session_.luminaires.begin(), session_.luminaires.end(),
                                                       [](const SessionLuminaire& l) { return l.is_held; });
  }

  FirstGuess NothingToGuess() const {
    FirstGuess guess;
    guess.separable = true;
    guess.luminaires.resize(session_.luminaires.size());
    guess.albedo = start_.state.albedo;
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
    luminaire.flux_lm = given.flux_lm.value_or(guessed.flux / start_.state.camera_scale);
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
      start_.flux_known = true;
    }
    if (found && !given.is_held) AddPriors(given, index);
    if (!given.heading && !given.photometry_path.empty() && IsSymmetricAboutAim(*luminaire.table)) {
      context_.choices.push_back({"heading of " + given.id,
                                  "not estimated",
                                  {"not estimated", "estimated"},
                                  "its photometry is the same all round: no light tells a heading"});
    }
    start_.luminaire_found.push_back(found);
    start_.rivals.push_back(given.position_m ? std::vector<Luminaire>() : guessed.rivals);
    start_.state.luminaires.push_back(luminaire);
    start_.state.free.push_back(free);
  }

  void AddPriors(const SessionLuminaire& given, int index) {
    if (given.position_m && given.position_sigma_m.value_or(0) > 0) {
      for (int axis = 0; axis < 3; ++axis) {
        start_.priors.push_back({ParameterKind::kLuminaire, index, static_cast<LuminaireQuantity>(axis),
                                 (*given.position_m)[axis], *given.position_sigma_m});
      }
    }
    if (given.flux_lm && given.flux_sigma_lm.value_or(0) > 0) {
      start_.priors.push_back({ParameterKind::kLogFlux,
                               index,
                               {},
                               std::log(*given.flux_lm),
                               *given.flux_sigma_lm / *given.flux_lm});
      start_.flux_known = true;
    }
    start_.flux_known = start_.flux_known || (given.flux_lm && given.flux_sigma_lm.value_or(1) == 0);
  }

  const Session& session_;
  const Room& room_;
  const SessionLight& light_;
  RunContext& context_;
  FitStart start_;
};

}  // namespace

FitStart StartFit(const Session& session, const Room& room, const SessionLight& light,
                  const LightData& guess_from, const std::vector<SeenPlace>& seen, RunContext& context) {
  return Starter(session, room, light, context).Run(guess_from, seen);
}

}  // namespace luxfit
