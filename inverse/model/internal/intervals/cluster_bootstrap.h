// Bootstraps the variance of a fit over clusters, as a check of fit_covariance.h.
//
//   u_b = -(sum_c m_c S_c + K)^-1 (sum_c m_c s_c + s_K + e_b),   e_b ~ N(0, V)
//   S_c = W^T A_c W,   s_c = W^T g_c,   W W^T = H^-1,   sum_c S_c + K = I,   sum_c s_c + s_K = 0
//   variance along axis d = ((Q_0.975 - Q_0.025) / 3.92)^2,   Q_p: quantiles of u_bd over the draws b
//
// Each draw b takes as many clusters as there are, with replacement; m_c says how often cluster c was taken.
// The draw's fit is one Gauss-Newton step from the optimum, which is exact for a linear model. K, the
// information of readings and priors, is the same in all draws. Their errors are drawn anew, with the variance V.
// Where a parameter lies at a bound the gradient at the optimum is not zero. s_K takes it up: it moves no draw.
//
// The sandwich holds the information as it is; draws change it. The quantiles are those of 95 % intervals, so
// skewed or heavy-tailed draws count with the width that they have there, and a few wild draws do not count.
//
// A direction that few clusters carry says nothing here. With k equal clusters among many, e^-k of the draws
// have none of them: 0.7 % with five, which the quantiles cut off; 5 % with three. The effective number of
// clusters along v is 1 / (v^T R v), R = sum_c S_c^2. It is at most Kish's, 1 / sum_c (v^T S_c v)^2, and does not
// depend on the choice of axes. Eigenvectors of R with fewer than five stay at the optimum in all draws.
//
// Draws whose information is singular are skipped. Where more than half of them are, the variance is 0.
// The draws are the same in each run, with any number of threads.
//
// Sources: Efron and Tibshirani (1993), "An introduction to the bootstrap", ch. 9 and 13 (pairs, percentiles);
// Cameron, Gelbach and Miller (2008), "Bootstrap-based improvements for inference with clustered errors" (pairs
// of whole clusters; they call five to thirty clusters few); Kish (1965), "Survey sampling" (effective number).
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_INTERVALS_CLUSTER_BOOTSTRAP_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_INTERVALS_CLUSTER_BOOTSTRAP_H_

#include <Eigen/Core>

#include "inverse/model/internal/intervals/cluster_sums.h"

namespace luxfit {

// Returns the variance along each axis of whitened parameters; 0 where the clusters say nothing. The Jacobian of
// `rows` is J W; known_variance is V, parameters x parameters.
Eigen::VectorXd BootstrapVariance(const ClusteredRows& rows, const Eigen::MatrixXd& known_variance);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_INTERVALS_CLUSTER_BOOTSTRAP_H_
