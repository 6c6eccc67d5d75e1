// Predicts how far the parameters of a fit move when its model leaves light out, without another fit.
//
//   x' - x = H^-1 J^T u^2 l,     H = c J_p^T u^2 J_p + J_o^T u^2 J_o + P
//
// The model without the light l predicts m(x) - l. One Gauss-Newton step leads from the fit x to its minimum
// (deferred correction), so the shift is right to first order in l. J: Jacobian at x, u: root weights of the fit,
// whitened as there; p: photos' rows, o: readings and outlines, P: priors and smoothness. Weights and texture stay,
// and bounds do not hold.
//
// Photos' rows that stand for all count c = (rows that the fit uses) / (those among them) times. Readings and
// outlines keep their light.
//
// A fit to a part A of the elements in place of all, A and B, is such a change, too. Its photos' rows weigh
// (n_A + n_B) / n_A times as much, n: rows used. With r = m(x) - target, l = -(n_B / n_A) r in A, l = r in B:
//   x_A - x = H^-1 (g_B - (n_B / n_A) g_A),     g = J^T u^2 r of a part's photos
// Errors that are alike in both parts cancel.
//
// Shifts are in the unit of each parameter. The fit must hold weights and parameters of `data`; directions that the
// data leave undetermined do not move. Throws std::invalid_argument where the sizes of `rows`, `lost` or `is_in_part`
// do not fit together.
//
// Sources: Pereyra (1966), "On improving an approximate solution of a functional equation by deferred corrections";
// Stetter (1978), "The defect correction principle and discretization methods".
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_INTERVALS_PARAMETER_SHIFT_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_INTERVALS_PARAMETER_SHIFT_H_

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "inverse/model/fit_luminaires.h"

namespace luxfit {

// The least shift, in sigmas of its parameter, that is worth a finer model.
constexpr double kWorthSigmas = 0.1;

// `fit`: a fit to `data` by `priors`. `rows`: the photos' rows that stand for all, ascending. `lost`: rows x models,
// in the rows' unit. Returns parameters x models.
Eigen::MatrixXd ParameterShift(const Room& room, const LightData& data, const LuminaireFit& fit,
                               const std::vector<ParameterPrior>& priors, const std::vector<size_t>& rows,
                               const Eigen::MatrixXd& lost);

// Returns x_A - x. `is_in_part`: by observation, whether its element lies in A. 0 where A or B has no rows.
Eigen::VectorXd ShiftByPart(const Room& room, const LightData& data, const LuminaireFit& fit,
                            const std::vector<ParameterPrior>& priors, const std::vector<bool>& is_in_part);

// Names the parameter that moves farthest in units of its own sigma.
struct LargestShift {
  double sigmas = 0;
  ParameterId parameter = {};
};

// `fit` needs its covariance. Parameters without a sigma do not count.
LargestShift LargestShiftOf(const LuminaireFit& fit, const Eigen::VectorXd& shift);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_INTERVALS_PARAMETER_SHIFT_H_
