// Decides which luminaires are of one type: alike but for place and flux.
//
// Luminaires that are always switched together are taken as alike at first: an installer puts one kind into a
// row, and their light alone hardly tells the models of single ones. A model of the whole row is chosen. But where
// photos show that one hangs 0.3 m and more below the other, or where one shines all round and the other in a beam, they are of two kinds.
//
// Types whose models have the same form are merged where a fit of all luminaires does not tell their numbers
// apart: exponents, sizes, tables, tilts, headings. Directions of a type's own luminaires become one by the same test.
//   (x_a - x_b)^T C_ab^-1 (x_a - x_b) <= chi2_95     C_ab: covariance of the difference
//
// Source: Wald (1943), "Tests of statistical hypotheses concerning several parameters".
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_LUMINAIRE_TYPES_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_LUMINAIRE_TYPES_H_

#include <optional>
#include <vector>

#include "inverse/choose/internal/choose_model.h"
#include "inverse/observe/seen_luminaires.h"

namespace luxfit {

// Holds by luminaire the place where photos show it; none where they do not.
using ShownLuminaires = std::vector<std::optional<SeenPlace>>;

// Returns the state with its types: luminaires of `open` distribution and shape that are always on together at the
// same level, and not of two kinds by what is `shown` or by their lobes, are of one type. One that no photo shows joins those that are
// nearest in height. Given aims must be alike. Where the search for places told aims that differ by 11 degrees and
// more, as those of spots do, each luminaire of the type has its own direction.
LightState TypedBySwitching(const LightData& data, LightState start, const std::vector<OpenChoice>& open,
                            const ShownLuminaires& shown);

// Returns the state with these types. Luminaires of a type get the model of the one whose aim is nearest to the
// others': a first guess sees some of them wrong.
LightState WithTypes(LightState state, const std::vector<int>& first_of_type);

// Returns for every type of several luminaires the places of photos that may be theirs: of those that are bright
// where and only where the type is on, and of no other kind than those of its luminaires that are `shown`, as many
// as it has luminaires, of largest area, in the order of x. No places where photos show too few, and none where all
// are within reach of the state's.
std::vector<TypePlaces> SeenPlacesOfTypes(const std::vector<SeenPlace>& seen, const LightData& data,
                                          const LightState& state, const ShownLuminaires& shown);

// Names the sides of rectangles alike: where a type's sides are those of an earlier type the other way round, its
// heading turns by a quarter and its sides change places, which leaves its light as it is. Only types of `open`
// distribution, shape and heading whose light is symmetric about the aim.
LightState WithSidesAlike(LightState state, const std::vector<OpenChoice>& open);

// Holds two types that became one: the first luminaire of each.
struct MergedTypes {
  int into = 0, merged = 0;
  double chi2 = 0;
  int parameters = 0;  // compared; 0: only the form was
};

struct TypedState {
  LightState state;
  std::vector<MergedTypes> merged;
  std::vector<int>
      turned_alike;  // the first of each type whose luminaires had a direction each and now have one
};

// Merges types of a fit with a covariance. Luminaires whose distribution or shape is not open keep theirs.
TypedState WithMergedTypes(const LuminaireFit& fit, const std::vector<OpenChoice>& open);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_LUMINAIRE_TYPES_H_
