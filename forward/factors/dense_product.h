// Product of a form-factor matrix with columns of light: C = A B, float, on all cores.
#ifndef LUXFIT_FORWARD_FACTORS_DENSE_PRODUCT_H_
#define LUXFIT_FORWARD_FACTORS_DENSE_PRODUCT_H_

#include <Eigen/Core>

#include "forward/factors/form_factors.h"

namespace luxfit {

Eigen::MatrixXf Product(const FormFactorMatrix& a, const Eigen::MatrixXf& b);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_FACTORS_DENSE_PRODUCT_H_
