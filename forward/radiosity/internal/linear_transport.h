// Applies the coupling K of all patches as an operator: iterative solvers need not know how it is stored.
//
//   K = sqrt(A) F / sqrt(A), symmetric          (A: patch areas, F: form factors; see transport.h)
//
// DenseTransport stores n^2 floats: the choice up to some 30 000 patches (3.6 GB). SparseTransport
// (sparse_transport.h) stores only the pairs that some ray found, 8 bytes each: the choice for 10^5 to 10^6
// patches. To cast the rays anew in every iteration would need no store at all. It costs some 100 ns a ray
// against 1 to 2 ns for a stored pair, in each of ten to a hundred iterations, so nothing here does it.
//
// Columns are independent light sources. Implementations are immutable and may be used from several threads.
#ifndef LUXFIT_FORWARD_RADIOSITY_INTERNAL_LINEAR_TRANSPORT_H_
#define LUXFIT_FORWARD_RADIOSITY_INTERNAL_LINEAR_TRANSPORT_H_

#include <Eigen/Core>
#include <vector>

#include "forward/factors/form_factors.h"
#include "forward/radiosity/solvers.h"

namespace luxfit {

class LinearTransport {
 public:
  virtual ~LinearTransport() = default;
  virtual Eigen::Index size() const = 0;
  // Returns rows [first, first + count) of K x (x: patches x columns).
  virtual Eigen::MatrixXf RowsTimes(Eigen::Index first, Eigen::Index count,
                                    const Eigen::MatrixXf& x) const = 0;
  // Returns rows and columns [first, first + count) of K.
  virtual Eigen::MatrixXf DiagonalBlock(Eigen::Index first, Eigen::Index count) const = 0;
  // Adds: y += factor * (column i of K).
  virtual void AddColumn(Eigen::Index i, float factor, Eigen::Ref<Eigen::VectorXf> y) const = 0;

  Eigen::MatrixXf Times(const Eigen::MatrixXf& x) const { return RowsTimes(0, size(), x); }
};

// Refers to `coupling`, which must outlive it. Throws std::invalid_argument unless it is square.
class DenseTransport : public LinearTransport {
 public:
  explicit DenseTransport(const FormFactorMatrix& coupling);
  Eigen::Index size() const override { return coupling_.rows(); }
  Eigen::MatrixXf RowsTimes(Eigen::Index first, Eigen::Index count, const Eigen::MatrixXf& x) const override;
  Eigen::MatrixXf DiagonalBlock(Eigen::Index first, Eigen::Index count) const override;
  void AddColumn(Eigen::Index i, float factor, Eigen::Ref<Eigen::VectorXf> y) const override;

 private:
  const FormFactorMatrix& coupling_;
};

// Solves without a dense matrix, by the iterative solvers only; auto means conjugate_gradient.
RadiositySolution SolveRadiosity(const LinearTransport& transport, const Eigen::VectorXf& patch_area_m2,
                                 const std::vector<int>& patch_material, const Eigen::VectorXd& albedo,
                                 const Eigen::MatrixXf& direct_lx,
                                 const RadiositySolverOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_RADIOSITY_INTERNAL_LINEAR_TRANSPORT_H_
