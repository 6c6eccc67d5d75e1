// Finds luminaires that nobody named and that the fit does not need.
//
// A number that was estimated (inverse/choose/internal/choose_count.h) rests on simple lobes and few rounds: one luminaire more makes up for
// what these lack. The fit then has better models, and leaves it over: hardly any light, or a place, aim or flux that nothing determines.
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_SUPERFLUOUS_LUMINAIRES_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_SUPERFLUOUS_LUMINAIRES_H_

#include <cstddef>
#include <optional>

#include "inverse/fit/fit_room.h"

namespace luxfit {

// Returns the observations without the last luminaire of which nothing is known, where the fit leaves one such luminaire over, whichever
// it is; none where it does not, where it departs from the data by more than 5 %, where luminaires are named, or where there is but one.
std::optional<RoomObservations> WithoutSuperfluous(const RoomObservations& given, const RoomFit& fit);

// Returns whether the fit of fewer luminaires is whole and departs from the data by less than 1 %, or leaves at most a tenth more of the
// squares than that of all that were counted. `sigma`: relative_sigma of the latter, as below.
bool ExplainsAsWell(const RoomFit& fewer, double sigma);

// Records how many luminaires were left out of those counted.
void RecordSuperfluous(size_t counted, double sigma, RoomFit& fewer);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_SUPERFLUOUS_LUMINAIRES_H_
