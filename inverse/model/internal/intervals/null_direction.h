// Describes in words a combination of parameters that the data leave free, and what data would determine it.
//
//   J d = 0     d: null direction of the (scaled) normal matrix; x + t d fits as well for every t
//
// The parameters that take part, |d_i| > 0.1 of unit length, identify the known ambiguity of light:
// - photos fix fluxes up to a factor;
// - luminaires that are always on together share their flux;
// - direct light and light from the walls are told apart only where one changes without the other;
// - height, lobe and flux of a luminaire look alike from far below.
//
// Source: own; Belhumeur, Kriegman, Yuille (1999), "The bas-relief ambiguity", for the kind of question.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_INTERVALS_NULL_DIRECTION_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_INTERVALS_NULL_DIRECTION_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/model/fit_luminaires.h"

namespace luxfit {

// `direction` has unit length and one entry for each parameter. Throws std::invalid_argument where sizes
// differ.
NullDirection DescribeNullDirection(const std::vector<Parameter>& parameters,
                                    const Eigen::VectorXd& direction);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_INTERVALS_NULL_DIRECTION_H_
