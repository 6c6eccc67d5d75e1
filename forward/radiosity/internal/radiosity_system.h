// Describes the radiosity system that every iterative solver solves, and when it may stop.
//
//   z = rho (g + K z),   z = sqrt(A) M,   g = sqrt(A) D
//
// In the unknown z the matrix is the symmetric coupling K itself.
#ifndef LUXFIT_FORWARD_RADIOSITY_INTERNAL_RADIOSITY_SYSTEM_H_
#define LUXFIT_FORWARD_RADIOSITY_INTERNAL_RADIOSITY_SYSTEM_H_

#include <Eigen/Core>

#include "forward/radiosity/internal/linear_transport.h"

namespace luxfit {

struct RadiositySystem {
  const LinearTransport& coupling;
  Eigen::VectorXf rho;         // by patch
  Eigen::VectorXf root_area;   // m
  Eigen::MatrixXf source;      // g, patches x columns
  double error_factor = 1;     // max |dE| <= error_factor max |r|
  Eigen::RowVectorXf allowed;  // by column: greatest |r| (lm/m2) that meets the tolerance
  int max_iterations = 1000;

  Eigen::Index patches() const { return source.rows(); }
  Eigen::Index columns() const { return source.cols(); }
  // Returns the greatest magnitude in column c of a residual given as sqrt(A) r, in lm/m2.
  float Largest(const Eigen::Ref<const Eigen::VectorXf>& scaled) const {
    return scaled.cwiseQuotient(root_area).cwiseAbs().maxCoeff();
  }
  bool IsSmall(const Eigen::MatrixXf& scaled_residual) const {
    for (Eigen::Index c = 0; c < columns(); ++c) {
      if (!(Largest(scaled_residual.col(c)) <= allowed[c])) return false;
    }
    return true;
  }
};

struct RadiosityIterate {
  Eigen::MatrixXf scaled_exitance;  // z
  int iterations = 0;
};

// Returns the means by column of |x|, weighted with the patches' areas.
inline Eigen::RowVectorXf AreaMean(const Eigen::MatrixXf& x, const Eigen::VectorXf& root_area) {
  const Eigen::VectorXd area = root_area.cast<double>().cwiseAbs2();
  return (area.transpose() * x.cwiseAbs().cast<double>() / area.sum()).cast<float>();
}

RadiosityIterate SolveJacobi(const RadiositySystem& system);
RadiosityIterate SolveGaussSeidel(const RadiositySystem& system);
RadiosityIterate SumNeumannSeries(const RadiositySystem& system, int bounces);
RadiosityIterate SolveShooting(const RadiositySystem& system);
RadiosityIterate SolveConjugateGradient(const RadiositySystem& system);
RadiosityIterate SolveBicgstab(const RadiositySystem& system);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_RADIOSITY_INTERNAL_RADIOSITY_SYSTEM_H_
