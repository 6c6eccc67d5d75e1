#include "inverse/fit/internal/judge/contradicted_given.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace luxfit {
namespace {

constexpr double kPlaceLimit = 14.16, kFluxLimit = 3;
constexpr double kSmallError = 0.05;  // relative

// Returns what the fit says of the luminaire; null where it was not found.
const Luminaire* FittedOf(const KnownLuminaire& given, const RoomFit& fit) {
  const std::vector<Luminaire>& all = fit.fit.state.luminaires;
  const auto at =
      std::find_if(all.begin(), all.end(), [&](const Luminaire& l) { return l.id == given.luminaire.id; });
  if (at == all.end() || !fit.luminaire_found[static_cast<size_t>(at - all.begin())]) return nullptr;
  return &*at;
}

int IndexOf(const Luminaire& fitted, const RoomFit& fit) {
  return static_cast<int>(&fitted - fit.fit.state.luminaires.data());
}

bool IsPlaceContradicted(const KnownLuminaire& given, const RoomFit& fit) {
  const Luminaire* fitted = FittedOf(given, fit);
  if (!fitted || !given.position_m || !(given.position_sigma_m.value_or(0) > 0)) return false;
  double z2 = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double sigma =
        SigmaOf(fit, ParameterKind::kLuminaire, IndexOf(*fitted, fit), static_cast<LuminaireQuantity>(axis));
    z2 += std::pow((fitted->position - *given.position_m)[axis] / std::hypot(*given.position_sigma_m, sigma),
                   2);
  }
  return z2 > kPlaceLimit;
}

bool IsFluxContradicted(const KnownLuminaire& given, const RoomFit& fit) {
  const Luminaire* fitted = FittedOf(given, fit);
  if (!fitted || !fit.absolute || !given.flux_lm || !(given.flux_sigma_lm.value_or(0) > 0)) return false;
  const double z = std::log(fitted->flux_lm / *given.flux_lm) / (*given.flux_sigma_lm / *given.flux_lm);
  return std::abs(z) > kFluxLimit && std::abs(fitted->flux_lm / *given.flux_lm - 1) > kSmallError;
}

std::string PlaceWords(const KnownLuminaire& given, const Luminaire& fitted) {
  const Eigen::Vector3d& p = fitted.position;
  return fmt::format("at ({:.2f}, {:.2f}, {:.2f}) m, {:.2f} m from its position_m, which is given to {:g} m",
                     p.x(), p.y(), p.z(), (p - *given.position_m).norm(), *given.position_sigma_m);
}

std::string RemedyOfPlace(const std::string& id) {
  return fmt::format("measure position_m of {} again, or raise its position_sigma_m", id);
}

}  // namespace

ContradictedGiven FindContradictedGiven(const RoomObservations& given, const RoomFit& fit) {
  ContradictedGiven found;
  if (!fit.IsUsable() || fit.stopped) return found;
  for (size_t k = 0; k < given.luminaires.size(); ++k) {
    const KnownLuminaire& known = given.luminaires[k];
    if (known.is_held) continue;
    if (IsPlaceContradicted(known, fit)) found.places.push_back(static_cast<int>(k));
    if (IsFluxContradicted(known, fit)) found.fluxes.push_back(static_cast<int>(k));
  }
  return found;
}

RoomObservations WithoutPlacesOf(const std::vector<int>& luminaires, RoomObservations given) {
  for (const int k : luminaires) {
    KnownLuminaire& known = given.luminaires[static_cast<size_t>(k)];
    known.position_m.reset();
    known.position_sigma_m.reset();
  }
  return given;
}

void WarnOfPlaceLeftOut(const KnownLuminaire& given, const RoomFit& fit, const RoomFit& fit_as_given,
                        Findings& findings) {
  const Luminaire* fitted = FittedOf(given, fit);
  if (!fitted) return;
  const std::string& id = given.luminaire.id;
  findings.warnings.push_back({"given_contradicted",
                               fmt::format("the data show {} {}: the place was left out (the light is "
                                           "explained to {:.2g} % without it, to {:.2g} % "
                                           "with it)",
                                           id, PlaceWords(given, *fitted), 100 * fit.fit.relative_sigma,
                                           100 * fit_as_given.fit.relative_sigma),
                               RemedyOfPlace(id)});
}

void WarnOfPlace(const KnownLuminaire& given, const RoomFit& fit, Findings& findings) {
  const Luminaire* fitted = FittedOf(given, fit);
  if (!fitted) return;
  const std::string& id = given.luminaire.id;
  findings.AddUndetermined({"given_contradicted",
                            fmt::format("the data pull {} away from where it is given: it ends {}", id,
                                        PlaceWords(given, *fitted)),
                            RemedyOfPlace(id)});
}

void WarnOfFlux(const KnownLuminaire& given, const RoomFit& fit, Findings& findings) {
  const Luminaire* fitted = FittedOf(given, fit);
  if (!fitted) return;
  const std::string& id = given.luminaire.id;
  findings.AddUndetermined(
      {"given_contradicted",
       fmt::format("the other data contradict flux_lm of {} ({:g} ± {:g} lm): the fit ends at {:.0f} lm "
                   "between them. "
                   "What sets the scale besides, readings, the camera or fluxes of other luminaires, "
                   "disagrees with it, "
                   "and nothing tells which is wrong",
                   id, *given.flux_lm, *given.flux_sigma_lm, fitted->flux_lm),
       fmt::format(
           "check flux_lm of {} and its sigma, and the readings that set the scale; leave out what is wrong",
           id)});
}

}  // namespace luxfit
