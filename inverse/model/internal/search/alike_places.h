// Knows luminaires that photos show to be alike: at one height, of about one area.
//
// Their light is so alike, too, that least squares may give all of it to one of several neighbours. What photos show
// settles it: like luminaires share their strength equally until a fit tells them apart.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_ALIKE_PLACES_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_ALIKE_PLACES_H_

#include <vector>

#include "inverse/model/internal/search/sparse_luminaires.h"
#include "inverse/observe/seen_luminaires.h"

namespace luxfit {

constexpr size_t kFewestAlike = 3;  // two may be alike by chance

// Returns whether the heights agree to 0.1 m and the areas to 30 %.
bool AreAlike(const SeenPlace& a, const SeenPlace& b);

// Returns a source at the place, which stays there. It shines down (Lambert).
SparseSource SourceAt(const SeenPlace& place);

// Returns the source as the luminaire that photos show at the place, which is its own.
SparseSource SeenAt(SparseSource source, const SeenPlace& place);

// Returns sources at the sure places (IsSure) that are alike, where these are exactly `count`; else none.
std::vector<SparseSource> SourcesAtAlike(const std::vector<SeenPlace>& places, size_t count);

// Returns the place in photos of a source; null: it has none of `places`.
const SeenPlace* PlaceOf(const SparseSource& source, const std::vector<SeenPlace>& places);

// Returns the indices of the sources at places like that of source `i`, its own among them; none where it has no place.
std::vector<size_t> SourcesLike(const std::vector<SeenPlace>& places,
                                const std::vector<SparseSource>& sources, size_t i);

// Gives sources at three like places and more the mean of their strengths.
void ShareAmongAlike(const std::vector<SeenPlace>& places, std::vector<SparseSource>& sources);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_ALIKE_PLACES_H_
