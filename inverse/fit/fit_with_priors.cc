// Fits as given. What is given of a luminaire's place and is contradicted by all other data is left out, and the fit done again: it stays out
// where the light is explained no worse without it. Where luminaires are counted, not named, those that the fit leaves over are left out alike.
#include <cstddef>
#include <optional>
#include <utility>

#include "inverse/fit/fit_room.h"
#include "inverse/fit/internal/expect_whole.h"
#include "inverse/fit/internal/fit_as_given.h"
#include "inverse/fit/internal/judge/contradicted_given.h"
#include "inverse/fit/internal/judge/superfluous_luminaires.h"

namespace luxfit {
namespace {

// Returns the fit without the places, where it is whole and no worse.
RoomFit FitWithoutPlaces(const Room& room, const RoomObservations& given, const std::vector<int>& places,
                         RoomFit as_given, const FitRoomOptions& options) {
  RoomFit without = FitAsGiven(room, WithoutPlacesOf(places, given), options);
  const bool is_better = without.IsUsable() && !without.stopped && !without.data.observations.empty() &&
                         without.fit.relative_sigma <= as_given.fit.relative_sigma;
  RoomFit& taken = is_better ? without : as_given;
  for (const int k : places) {
    const KnownLuminaire& known = given.luminaires[static_cast<size_t>(k)];
    if (is_better)
      WarnOfPlaceLeftOut(known, without, as_given, taken.findings);
    else
      WarnOfPlace(known, as_given, taken.findings);
  }
  return std::move(taken);
}

// Fits with one luminaire fewer as long as the fit leaves one over and explains the light as well without.
void LeaveOutSuperfluous(const Room& room, RoomObservations& given, RoomFit& fit,
                         const FitRoomOptions& options) {
  const size_t counted = given.luminaires.size();
  const double counted_sigma = fit.fit.relative_sigma;
  while (std::optional<RoomObservations> fewer = WithoutSuperfluous(given, fit)) {
    RoomFit next = FitAsGiven(room, *fewer, options);
    if (!ExplainsAsWell(next, counted_sigma)) break;
    given = std::move(*fewer);
    fit = std::move(next);
  }
  if (given.luminaires.size() < counted) RecordSuperfluous(counted, counted_sigma, fit);
}

}  // namespace

RoomFit FitRoom(const Room& room, const RoomObservations& observations, const FitRoomOptions& options) {
  ExpectWhole(room, observations);
  RoomObservations given = observations;
  RoomFit fit = FitAsGiven(room, given, options);
  LeaveOutSuperfluous(room, given, fit, options);
  const ContradictedGiven contradicted = FindContradictedGiven(given, fit);
  if (!contradicted.places.empty())
    fit = FitWithoutPlaces(room, given, contradicted.places, std::move(fit), options);
  for (const int k : contradicted.fluxes)
    WarnOfFlux(given.luminaires[static_cast<size_t>(k)], fit, fit.findings);
  return fit;
}

}  // namespace luxfit
