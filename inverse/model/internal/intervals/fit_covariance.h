// Computes the covariance of fitted parameters whose residuals are not independent.
//
//   H = J^T J + P,   C = H^-1 (T sum_c g_c' g_c'^T T + sum_readings + P) H^-1 + sum_b b_theta b_theta^T
//
// J: weighted Jacobian, P: information of priors and smoothness. g_c = J_c^T r_c is the gradient of one
// cluster, the rows of one facet in one state, which share their model error. A facet's error may be the same in
// all states (its pose, its reflectance), so the sum is taken over coarser clusters too. Along each axis the
// larger of the two variances counts.
//
// Where clusters are few, each has leverage: the fit follows it, so its residual is smaller than its error.
// g_c' = H (H - J_c^T J_c)^-1 g_c is the gradient of a fit without the cluster (CR3, the jackknife). It is
// exact for a linear model. Where a cluster holds nearly all that is known of a direction, a tenth of it
// counts as known without it.
//
// The estimate then has few degrees of freedom itself: nu = (sum_c v_c)^2 / sum_c v_c^2. v_c is the variance
// that cluster c would add with independent errors (Satterthwaite's, as Bell and McCaffrey use it). nu is
// multiplied by (1 + known / estimated)^2 where readings and priors, whose sigmas are known, share the
// direction. It is at least 3.
//
// A bootstrap over the same clusters checks this (inverse/model/internal/intervals/cluster_bootstrap.h). Along each axis
// the whole variance, known and estimated, is at least the bootstrap's, which needs no T: its quantiles are those
// of 95 % intervals. Where fewer than five clusters carry a direction the bootstrap says nothing.
//
// T enlarges the clusters' part to t_975(nu) / 1.96 of itself, so that 1.96 sigma is the 95 % interval. nu
// and T belong to the principal axes of the scaled H, so that what cancels in a prediction stays cancelled.
// Along these axes the covariance is never below the plain H^-1. In no direction is the clusters' part below that of
// independent rows, sum_c J_c^T J_c in the place of the sum over g_c': the covariance is singular only where H is.
//
// b_theta = H^-1 J^T b is the effect of an error b of the model that all rows share on the parameters. Each has
// a known form and an amplitude of 1 sigma: what remains of the discretisation's bias
// (inverse/model/internal/discretisation_bias.h), or a quantity that is held although it is not exactly known (a
// "consider parameter", Schmidt 1966).
//
// Directions of eigenvalue below 1e-10 of the largest (after scaling) have no covariance and are returned.
//
// Sources: Liang and Zeger (1986); Bell and McCaffrey (2002), "Bias reduction in standard errors for linear
// regression with multi-stage samples"; Cameron and Miller (2015), sec. VI (few clusters); Cameron, Gelbach and
// Miller (2008), "Bootstrap-based improvements for inference with clustered errors".
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_INTERVALS_FIT_COVARIANCE_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_INTERVALS_FIT_COVARIANCE_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/model/internal/intervals/cluster_sums.h"

namespace luxfit {

struct WeightedRows {
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>
      jacobian;  // derivative of root weight times residual
  Eigen::VectorXd residual;
  Eigen::MatrixXd biases;    // one in each column, weighted likewise
  std::vector<int> cluster;  // one for each row, from 0; -1: stands alone
  // A coarser choice of clusters, of the same rows; empty: none. Of the two variances the larger counts.
  std::vector<int> coarse_cluster;
  // Rows that follow those of the clusters and are sums over them (cluster_sums.h), for either choice of clusters.
  std::vector<SpreadRow> spread, coarse_spread;
  double alone_scatter = 1;           // expected mean square of the residuals of rows that stand alone
  Eigen::MatrixXd prior_information;  // P, for priors and smoothness: parameters x parameters
};

struct FitCovariance {
  Eigen::MatrixXd covariance;
  std::vector<Eigen::VectorXd> null_directions;  // unit, in parameters scaled to unit curvature
  Eigen::VectorXd degrees_of_freedom;  // nu of the axes; infinite where readings and priors give all
};

// Returns H^-1 over the directions that the data determine, 0 over the others.
Eigen::MatrixXd InverseOf(const Eigen::MatrixXd& hessian);

// Returns how many times larger the variance is that clustered rows give than the one they would give if they
// were independent: the median over the axes of H, at least 1. Rows that stand alone do not count.
// Source: Kish (1965), "Survey sampling" (design effect).
double DesignEffect(const WeightedRows& rows);

FitCovariance CovarianceOf(const WeightedRows& rows);

// Returns the quantile of Student's t over that of the normal distribution, both for 95 %; nu >= 3.
double StudentFactor(double degrees_of_freedom);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_INTERVALS_FIT_COVARIANCE_H_
