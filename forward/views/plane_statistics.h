// What standards ask of the illuminance over an area: its mean, its least, its uniformity, and how sure they
// are.
//
//   E_avg = mean E_i,   E_min = min E_i,   U0 = E_min / E_avg,   Ud = E_min / E_max          lx
//   Var(E_avg) = |mean s_i|^2 + (f E_avg)^2,   Var(E_min) = |s_min|^2 + (f E_min)^2
//   Var(U0) / U0^2 = |s_min / E_min - mean s_i / E_avg|^2 + f^2 (1 + 1/n)
//
// s_i is the row of point i in a factor S of the points' covariance, Cov(E) = S S^T; f the relative model
// error, which is common to all points in E_avg and each point's own in U0. First order: the point of least
// light stays the same.
//
// Statistics of no point, or of points without light, are not defined: `points` 0, or U0 0.
// Source: EN 12464-1:2021, sec. 3 and 4.4; EN 12665:2018 (uniformity); JCGM 100:2008, sec. 5.2 (propagation).
#ifndef LUXFIT_FORWARD_VIEWS_PLANE_STATISTICS_H_
#define LUXFIT_FORWARD_VIEWS_PLANE_STATISTICS_H_

#include <Eigen/Core>
#include <vector>

namespace luxfit {

struct PlaneStatistics {
  int points = 0;
  double average_lx = 0, least_lx = 0, largest_lx = 0;
  double uniformity = 0;  // U0
  double diversity = 0;   // Ud
  // One standard deviation; 0 where no factor was given.
  double average_sigma_lx = 0, least_sigma_lx = 0, uniformity_sigma = 0;
};

// `counts[i]`: whether the point belongs to the area. `factor` points x any, or empty. Throws
// std::invalid_argument where the sizes differ.
PlaneStatistics StatisticsOf(const Eigen::VectorXd& illuminance_lx, const std::vector<bool>& counts,
                             const Eigen::MatrixXd& factor = {}, double relative_model_error = 0);

// Whether a value meets what is asked for: at 95 %, two-sided.
enum class Verdict { kMet, kMissed, kOpen };
Verdict AtLeast(double value, double sigma, double asked);
Verdict AtMost(double value, double sigma, double asked);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_VIEWS_PLANE_STATISTICS_H_
