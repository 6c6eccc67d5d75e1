// A combination of parameters that the data leave free, in words: what cannot be told from what, and what
// would tell.
//
// A null direction d of the (scaled) normal matrix: J d = 0, so that x + t d fits as well for every t. What
// takes part, |d_i| > 0.1 of unit length, says which of the known ambiguities of light it is: photos fix
// fluxes up to a factor; luminaires that are always on together share theirs; light that comes straight and
// light that comes by the walls are told apart only where one changes without the other; height, lobe and
// flux of a luminaire look alike from far below.
//
// Source: house; Belhumeur, Kriegman, Yuille (1999), "The bas-relief ambiguity", for the kind of question.
#ifndef LUXFIT_INVERSE_MODEL_NULL_DIRECTION_H_
#define LUXFIT_INVERSE_MODEL_NULL_DIRECTION_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "inverse/model/light_model.h"

namespace luxfit {

struct NullDirection {
  std::vector<ParameterId> parameters;  // that take part, the strongest first
  std::string meaning, remedy;          // a sentence each, without a full stop
};

// `direction`: of unit length, one entry a parameter. Throws std::invalid_argument where sizes differ.
NullDirection DescribeNullDirection(const std::vector<Parameter>& parameters,
                                    const Eigen::VectorXd& direction);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_NULL_DIRECTION_H_
