// Finds luminaires that are unlike those that are always on together with them: the fit is in a wrong place.
//
// No state tells luminaires of one switch apart. A fit that ends in the wrong place puts two of them into one large
// luminaire and leaves another without light, and it may explain the light nearly as well. Real luminaires of one
// switch differ by a factor of two or three: spots beside panels, aged ones. They do not differ by a hundred in flux,
// nor by ten in area where they are panels: a panel among downlights has an outline in photos that says so.
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_ODD_LUMINAIRES_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_ODD_LUMINAIRES_H_

#include <vector>

#include "inverse/model/fit_luminaires.h"
#include "inverse/observe/seen_luminaires.h"

namespace luxfit {

struct OddLuminaire {
  int luminaire = 0;
  std::vector<int> fellows;   // always on together with it
  bool is_left_over = false;  // else it is too large
  double flux_ratio = 1;      // to the fellows' median
  double area_ratio = 1;      // to the largest fellow's; 1 where fellows have no area
};

// Returns the luminaires with less than 2 % of the median flux, or more than ten times the largest area, of at least
// two fellows whose fluxes were fitted as well. An area that outlines of `data`, those that the fit explains, show is
// not judged.
std::vector<OddLuminaire> FindOddLuminaires(const LuminaireFit& fit, const LightData& data);

// Holds a luminaire whose fitted opening is not the one that photos show.
struct OversizedLuminaire {
  int luminaire = 0;
  double area_m2 = 0, shown_m2 = 0;
};

// Returns the luminaires that have more than kMostTimesShown the area that `outlines` show (inverse/fit/internal/outlines.h):
// all outlines, those that the fit does not explain, too.
std::vector<OversizedLuminaire> FindOversizedLuminaires(const LuminaireFit& fit,
                                                        const std::vector<LuminaireOutline>& outlines);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_ODD_LUMINAIRES_H_
