#include "forward/radiosity/internal/linear_transport.h"

#include <stdexcept>

#include "forward/radiosity/internal/dense.h"

namespace luxfit {

DenseTransport::DenseTransport(const FormFactorMatrix& coupling) : coupling_(coupling) {
  if (coupling.rows() != coupling.cols())
    throw std::invalid_argument("DenseTransport: expected a square matrix");
}

Eigen::MatrixXf DenseTransport::RowsTimes(Eigen::Index first, Eigen::Index count,
                                          const Eigen::MatrixXf& x) const {
  return RowsProduct(coupling_, first, count, x);
}

Eigen::MatrixXf DenseTransport::DiagonalBlock(Eigen::Index first, Eigen::Index count) const {
  return coupling_.block(first, first, count, count);
}

void DenseTransport::AddColumn(Eigen::Index i, float factor, Eigen::Ref<Eigen::VectorXf> y) const {
  y += factor * coupling_.row(i).transpose();  // symmetric: the row lies together in memory
}

}  // namespace luxfit
