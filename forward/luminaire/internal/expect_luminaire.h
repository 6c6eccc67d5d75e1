// Checks luminaires: finite numbers, an aim, a size >= 0, an exponent above 0 and a table where the distribution has them.
//
// Throws std::invalid_argument that names it, and what is wrong with it.
#ifndef LUXFIT_FORWARD_LUMINAIRE_INTERNAL_EXPECT_LUMINAIRE_H_
#define LUXFIT_FORWARD_LUMINAIRE_INTERNAL_EXPECT_LUMINAIRE_H_

#include <vector>

#include "forward/luminaire/luminaire.h"

namespace luxfit {

void ExpectValid(const Luminaire& luminaire);
void ExpectValid(const std::vector<Luminaire>& luminaires);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LUMINAIRE_INTERNAL_EXPECT_LUMINAIRE_H_
