// Makes least-squares rows that keep a luminaire's intensity table and its emission smooth.
//
//   table, nodes j of gamma:    (I_{j-1} - 2 I_j + I_{j+1}) / (s I_ref)      s = FreeQuantities::table_sigma
//   cells i, j of a rectangle:  (f_i - f_j) / (s f_ref), i, j neighbours   s = FreeQuantities::emission_sigma
//
// I: intensity at a node, f: share of a cell, ref: the part with the largest share at the start. A table is
// mirrored at gamma = 0. The second difference at 90 degrees is left free: in the plane of its opening, the
// light of a luminaire ends with a kink. As s goes to 0, tables become straight lines on either side of 90
// degrees, and emission becomes even. With large s they follow the data.
//
// A fit J with such rows R has trace(J^T J (J^T J + R^T R)^-1) effective parameters over the part parameters,
// between 0 and their number.
//
// Sources: Hastie, Tibshirani, Friedman (2009), "The Elements of Statistical Learning", sec. 5.4.1; Eilers
// and Marx (1996), "Flexible smoothing with B-splines and penalties".
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_PART_SMOOTHNESS_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_PART_SMOOTHNESS_H_

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "inverse/model/light_state.h"

namespace luxfit {

// Holds one row: constant + sum of coefficient * parameter, with a standard deviation of 1.
struct SmoothnessRow {
  std::vector<std::pair<int, double>> terms;  // index into the parameters, coefficient
  double constant = 0;

  double Value(const Eigen::Ref<const Eigen::VectorXd>& x) const;
};

std::vector<SmoothnessRow> SmoothnessRows(const LightState& state, const std::vector<Parameter>& parameters);

// Returns the effective parameters, 0 without part parameters. `data_hessian`: J^T J of the weighted data,
// all parameters.
double EffectiveParts(const Eigen::MatrixXd& data_hessian, const std::vector<SmoothnessRow>& rows,
                      const std::vector<Parameter>& parameters);

// Adds R^T R.
void AddSmoothness(const std::vector<SmoothnessRow>& rows, Eigen::MatrixXd& hessian);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_PART_SMOOTHNESS_H_
