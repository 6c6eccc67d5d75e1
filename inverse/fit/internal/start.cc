#include "inverse/fit/internal/start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "forward/luminaire/distribution_ops.h"
#include "forward/luminaire/luminaire_parts.h"
#include "forward/luminaire/photometry.h"
#include "inverse/choose/internal/choose_model.h"
#include "inverse/fit/internal/words.h"
#include "inverse/model/internal/search/first_guess.h"

namespace luxfit {
namespace {

// A material with fewer observed elements counts as unseen.
constexpr int kMinElementsOfMaterial = 3;

// Smoothness of a table that is to be estimated, until its strength is chosen.
constexpr double kStartTableSigma = 0.1;

// Starting flux at a known place about which the guess says nothing.
constexpr double kAnyFluxLm = 1000;

// Flux of a luminaire without a place: it gives no light, so that the others can still be fitted.
constexpr double kNoFluxLm = 1e-9;

// Returns the start of a table that is to be estimated: Lambertian, with a node every 7.5 degrees.
std::shared_ptr<const IntensityTable> StartTable() {
  std::vector<double> gamma_rad, intensity;
  for (int j = 0; j <= 12; ++j) {
    gamma_rad.push_back(M_PI / 180 * 7.5 * j);
    intensity.push_back(std::max(std::cos(gamma_rad.back()), 1e-3));
  }
  return std::make_shared<IntensityTable>(RotationalTable(gamma_rad, intensity));
}

FreeQuantities NothingFree() { return {false, false, false, false, false}; }

class Starter {
 public:
  Starter(const Room& room, const RoomObservations& given, const RoomLight& light, Findings& findings)
      : room_(room), given_(given), light_(light), findings_(findings) {
    start_.priors = light.priors;
    start_.state.meter_scale_free = light.meter_scale_free;
    start_.state.sensor_gain = light.sensor_gain;
    start_.state.sensor_gains_free = light.sensor_gains_free;
    start_.state.ambient_share = light.ambient_share;
    start_.state.ambient_shares_free = light.ambient_share.size() > 0;
    FillReflectances();
    FillCameraScale();
  }

  FitStart Run(const LightData& data) {
    std::vector<std::optional<Eigen::Vector3d>> known;
    for (const KnownLuminaire& luminaire : given_.luminaires) known.push_back(luminaire.position_m);
    const FirstGuess guess =
        IsAllHeld() ? NothingToGuess() : GuessLuminaires(room_, data, known, given_.seen, given_.views);
    RecordFirstGuess(given_, guess, given_.seen, findings_);
    MatchKnownFluxes(guess);
    for (const std::vector<int>& group : guess.groups) WarnOfInterchangeable(given_, group, findings_);
    for (Eigen::Index m = 0; m < start_.state.albedo.size(); ++m) {
      if (start_.state.albedo_free[static_cast<size_t>(m)]) start_.state.albedo[m] = guess.albedo[m];
    }
    for (size_t k = 0; k < given_.luminaires.size(); ++k)
      AddLuminaire(guess.luminaires[k], static_cast<int>(k));
    if (!guess.separable) {
      findings_.warnings.push_back(
          {"luminaires_not_separated", "no start for luminaires without a given position: " + guess.message,
           "photograph each luminaire in at least one state without the others, or give position_m"});
    }
    return std::move(start_);
  }

 private:
  // Returns the observed elements of each material.
  std::vector<std::set<int>> SeenElements() const {
    std::vector<std::set<int>> seen(room_.scene.materials.size());
    for (const Observation& o : light_.data.observations) {
      seen[static_cast<size_t>(room_.patches.PatchOf(o.element).material)].insert(o.element);
    }
    return seen;
  }

  // Sets each reflectance as known, to be estimated, or out of reach.
  void FillReflectances() {
    const std::vector<std::string>& materials = room_.scene.materials;
    const std::vector<std::set<int>> seen = SeenElements();
    const bool has_photos = !light_.data.observations.empty();
    start_.state.albedo = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(materials.size()), 0.5);
    start_.state.albedo_free.assign(materials.size(), false);
    std::vector<std::string> unseen;
    for (size_t m = 0; m < materials.size(); ++m) {
      const bool observed = static_cast<int>(seen[m].size()) >= kMinElementsOfMaterial;
      if (!given_.albedo.empty() && given_.albedo[m]) {
        start_.state.albedo[static_cast<Eigen::Index>(m)] = *given_.albedo[m];
      } else if (observed || (!has_photos && light_.used_readings > 0)) {
        start_.state.albedo_free[m] = true;
      } else if (has_photos) {
        unseen.push_back(materials[m]);
      }
    }
    if (!unseen.empty()) WarnOfUnseen(unseen);
  }

  void WarnOfUnseen(const std::vector<std::string>& materials) {
    const bool is_one = materials.size() == 1;
    findings_.warnings.push_back(
        {"material_unseen",
         fmt::format(
             "the reflectance{} of \"{}\" {} not determined: no photo shows {}; 0.5 was taken for the light "
             "that {}",
             is_one ? "" : "s", fmt::join(materials, "\", \""), is_one ? "is" : "are", is_one ? "it" : "them",
             is_one ? "it reflects" : "they reflect"),
         fmt::format("photograph {}, or give {} in [scene.albedo]", is_one ? "it" : "them",
                     is_one ? "it" : "those that matter")});
  }

  void FillCameraScale() {
    start_.state.camera_scale_free = !light_.data.observations.empty() && !given_.camera_scale;
    if (given_.camera_scale) start_.state.camera_scale = *given_.camera_scale;
  }

  // Known fluxes give a rough camera scale; the guess takes it as 1.
  void MatchKnownFluxes(const FirstGuess& guess) {
    double guessed = 0, known = 0;
    for (size_t k = 0; k < given_.luminaires.size(); ++k) {
      if (!given_.luminaires[k].flux_lm || !guess.luminaires[k].found) continue;
      guessed += guess.luminaires[k].flux;
      known += *given_.luminaires[k].flux_lm;
    }
    if (start_.state.camera_scale_free && guessed > 0 && known > 0)
      start_.state.camera_scale = guessed / known;
  }

  bool IsAllHeld() const {
    return !given_.luminaires.empty() && std::all_of(given_.luminaires.begin(), given_.luminaires.end(),
                                                     [](const KnownLuminaire& l) { return l.is_held; });
  }

  FirstGuess NothingToGuess() const {
    FirstGuess guess;
    guess.separable = true;
    guess.luminaires.resize(given_.luminaires.size());
    guess.albedo = start_.state.albedo;
    return guess;
  }

  void AddLuminaire(const LuminaireGuess& guessed, int index) {
    const KnownLuminaire& known = given_.luminaires[static_cast<size_t>(index)];
    if (known.file) RecordPhotometryFile(known.luminaire.id, *known.file, findings_);
    const bool found = guessed.found || known.position_m.has_value();
    const Luminaire luminaire = StartOf(known, guessed, found);
    if (!found) WarnOfNoPlace(luminaire.id);
    if (known.is_held) start_.flux_known = true;
    if (found && !known.is_held) AddPriors(known, index);
    if (!known.heading && known.photometry == KnownPhotometry::kFile &&
        IsSymmetricAboutAim(*luminaire.table)) {
      findings_.choices.push_back({"heading of " + luminaire.id,
                                   "not estimated",
                                   {"not estimated", "estimated"},
                                   "its photometry is the same all round: no light tells a heading"});
    }
    start_.luminaire_found.push_back(found);
    start_.seen.push_back(SeenSurely(guessed));
    start_.rivals.push_back(known.position_m ? std::vector<Luminaire>() : guessed.rivals);
    start_.state.luminaires.push_back(luminaire);
    start_.state.free.push_back(found && !known.is_held ? FreeOf(known, luminaire) : NothingFree());
    // A narrow beam that misses its patch by degrees pulls the position along.
    if (found && guessed.is_aimed && !known.is_held && IsAimOpen(known) &&
        OpsOf(luminaire.distribution).has_aim)
      FreeAim(luminaire.id);
  }

  std::optional<SeenPlace> SeenSurely(const LuminaireGuess& guessed) const {
    if (!guessed.seen || !IsSure(given_.seen[static_cast<size_t>(*guessed.seen)])) return {};
    SeenPlace place = given_.seen[static_cast<size_t>(*guessed.seen)];
    place.position = guessed.position;
    return place;
  }

  // Returns the luminaire with which the fit starts.
  Luminaire StartOf(const KnownLuminaire& known, const LuminaireGuess& guessed, bool found) const {
    Luminaire luminaire = known.luminaire;
    const bool is_open = known.photometry == KnownPhotometry::kNothing;
    if (is_open) luminaire.distribution = Distribution::kCosinePower;
    if (known.photometry == KnownPhotometry::kTableOpen) {
      luminaire.distribution = Distribution::kMeasured;
      luminaire.table = StartTable();
    }
    if (is_open && guessed.found) luminaire.cosine_exponent = std::max(1.0, guessed.cosine_exponent);
    if (!(luminaire.size_m[0] > 0)) luminaire.size_m.setConstant(kStartSizeM);
    luminaire.position = known.position_m.value_or(guessed.position);
    luminaire.flux_lm = known.flux_lm.value_or(guessed.flux / start_.state.camera_scale);
    if (guessed.found && IsAimOpen(known)) luminaire.aim = guessed.aim;
    if (found && !(luminaire.flux_lm > 0)) luminaire.flux_lm = kAnyFluxLm;
    if (!found) luminaire.flux_lm = kNoFluxLm;
    return luminaire;
  }

  void FreeAim(const std::string& id) {
    start_.state.free.back().tilt = true;
    findings_.choices.push_back(
        {"aim of " + id,
         "estimated",
         {"along an axis of the room", "estimated"},
         "in the search over places, lobes aimed along the room's axes left half more "
         "squares of the light unexplained than turned ones"});
  }

  static bool IsAimOpen(const KnownLuminaire& known) {
    return !known.aim && known.photometry != KnownPhotometry::kFile;
  }

  static FreeQuantities FreeOf(const KnownLuminaire& known, const Luminaire& start) {
    FreeQuantities free;
    free.table_sigma = known.photometry == KnownPhotometry::kTableOpen ? kStartTableSigma : 0;
    free.exponent = OpsOf(start.distribution).has_exponent;
    free.size = start.shape != LuminaireShape::kPoint && start.shape != LuminaireShape::kSphere &&
                !(known.luminaire.size_m[0] > 0);
    free.position = !(known.position_sigma_m && *known.position_sigma_m == 0);
    free.flux = !(known.flux_sigma_lm && *known.flux_sigma_lm == 0);
    return free;
  }

  void WarnOfNoPlace(const std::string& id) {
    findings_.AddUndetermined(
        {"luminaire_undetermined",
         fmt::format("luminaire {} is not determined: the data show too little of its own light", id),
         fmt::format("photograph {} alone", id)});
  }

  void AddPriors(const KnownLuminaire& known, int index) {
    if (known.position_m && known.position_sigma_m.value_or(0) > 0) {
      for (int axis = 0; axis < 3; ++axis) {
        start_.priors.push_back({ParameterKind::kLuminaire, index, static_cast<LuminaireQuantity>(axis),
                                 (*known.position_m)[axis], *known.position_sigma_m});
      }
    }
    if (known.flux_lm && known.flux_sigma_lm.value_or(0) > 0) {
      start_.priors.push_back({ParameterKind::kLogFlux,
                               index,
                               {},
                               std::log(*known.flux_lm),
                               *known.flux_sigma_lm / *known.flux_lm});
      start_.flux_known = true;
    }
    start_.flux_known = start_.flux_known || (known.flux_lm && known.flux_sigma_lm.value_or(1) == 0);
  }

  const Room& room_;
  const RoomObservations& given_;
  const RoomLight& light_;
  Findings& findings_;
  FitStart start_;
};

}  // namespace

FitStart StartFit(const Room& room, const RoomObservations& given, const RoomLight& light,
                  const LightData& guess_from, Findings& findings) {
  return Starter(room, given, light, findings).Run(guess_from);
}

}  // namespace luxfit
