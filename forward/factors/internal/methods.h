// Makes the row of each method of form factors (forward/factors/form_factors.h), each in the file that
// implements it.
#ifndef LUXFIT_FORWARD_FACTORS_INTERNAL_METHODS_H_
#define LUXFIT_FORWARD_FACTORS_INTERNAL_METHODS_H_

#include "forward/factors/form_factors.h"

namespace luxfit {

FormFactorOps HybridMethod();            // pair_rows.cc
FormFactorOps AnalyticMethod();          // pair_rows.cc
FormFactorOps MalleyMethod();            // malley.cc
FormFactorOps MalleyStratifiedMethod();  // malley.cc
FormFactorOps IsocellMethod();           // isocell.cc
FormFactorOps MonteCarloMethod();        // monte_carlo.cc
FormFactorOps HemicubeMethod();          // hemicube.cc
FormFactorOps SinglePlaneMethod();       // single_plane.cc
FormFactorOps WallaceMethod();           // disc_rows.cc

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_FACTORS_INTERNAL_METHODS_H_
