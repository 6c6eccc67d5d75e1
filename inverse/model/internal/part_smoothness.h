// Smoothness of what a luminaire's parts give, as rows of least squares.
//
//   table, nodes j of gamma:    (I_{j-1} - 2 I_j + I_{j+1}) / (s I_ref)      s = FreeQuantities::table_sigma
//   cells i, j of a rectangle:  (f_i - f_j) / (s f_ref), i and j neighbours  s =
//   FreeQuantities::emission_sigma
//
// I: intensity at a node, f: share of a cell; ref: the largest share at the start. A table is mirrored at
// gamma = 0. The second difference at 90 degrees is left free: there, in the plane of its opening, the light
// of a luminaire ends with a kink. With s going to 0 tables become straight lines on either side of 90
// degrees, emission even; with s large they follow the data.
//
// Effective parameters of a fit J with such rows R: trace(J^T J (J^T J + R^T R)^-1) over the part parameters,
// between 0 and their number. Source: Hastie, Tibshirani, Friedman (2009), "The Elements of Statistical
// Learning", sec. 5.4.1; Eilers and Marx (1996), "Flexible smoothing with B-splines and penalties".
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_PART_SMOOTHNESS_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_PART_SMOOTHNESS_H_

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "inverse/model/light_model.h"

namespace luxfit {

// One row: constant + sum of coefficient * parameter, with a standard deviation of 1.
struct SmoothnessRow {
  std::vector<std::pair<int, double>> terms;  // index into the parameters, coefficient
  double constant = 0;

  double Value(const Eigen::Ref<const Eigen::VectorXd>& x) const;
};

std::vector<SmoothnessRow> SmoothnessRows(const LightState& state, const std::vector<Parameter>& parameters);

// `data_hessian`: J^T J of the weighted data, all parameters. 0 without part parameters.
double EffectiveParts(const Eigen::MatrixXd& data_hessian, const std::vector<SmoothnessRow>& rows,
                      const std::vector<Parameter>& parameters);

// Adds R^T R.
void AddSmoothness(const std::vector<SmoothnessRow>& rows, Eigen::MatrixXd& hessian);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_PART_SMOOTHNESS_H_
