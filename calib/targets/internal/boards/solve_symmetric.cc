#include "calib/targets/internal/boards/solve_symmetric.h"

#include <Eigen/Cholesky>

namespace luxfit {

Eigen::MatrixXd SolveSymmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.ldlt().solve(b);
}

}  // namespace luxfit
