// Stores the coupling of many patches sparsely: only the pairs that a ray connected.
//
//   K = (B + B^T) / 2,   B_ij = sqrt(A_i) F_ij / sqrt(A_j)
//   F from rays as in form_factors.h, ray for ray
//
// The numbers are those of MakeTransportGeometry of ComputeFormFactors, without zeros. There are at most 2
// rays_per_element pairs for each element, 8 bytes a pair (three times that while it is made). A room of 10^6
// patches of one element with 128 rays takes 2 GB, 6 GB at the peak.
//
// Throws std::invalid_argument if rays_per_element < 1.
// Source: form_factors.h; transport.h.
#ifndef LUXFIT_FORWARD_RADIOSITY_INTERNAL_SPARSE_TRANSPORT_H_
#define LUXFIT_FORWARD_RADIOSITY_INTERNAL_SPARSE_TRANSPORT_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "forward/radiosity/internal/linear_transport.h"
#include "forward/room/patches.h"
#include "forward/room/visibility.h"

namespace luxfit {

class SparseTransport : public LinearTransport {
 public:
  struct Pair {
    int32_t column;
    float value;
  };
  SparseTransport(const RayScene& rays, const Patches& patches, const FormFactorOptions& options = {});
  Eigen::Index size() const override { return static_cast<Eigen::Index>(row_start_.size()) - 1; }
  Eigen::MatrixXf RowsTimes(Eigen::Index first, Eigen::Index count, const Eigen::MatrixXf& x) const override;
  Eigen::MatrixXf DiagonalBlock(Eigen::Index first, Eigen::Index count) const override;
  void AddColumn(Eigen::Index i, float factor, Eigen::Ref<Eigen::VectorXf> y) const override;
  int64_t pair_count() const { return row_start_.back(); }
  // Shares of the rays, as FormFactors has them.
  double escaped_fraction() const { return escaped_fraction_; }
  double back_fraction() const { return back_fraction_; }
  int64_t rays() const { return rays_; }

 private:
  std::vector<int64_t> row_start_;  // patches + 1
  std::vector<Pair> pairs_;         // by row, then column
  double escaped_fraction_ = 0, back_fraction_ = 0;
  int64_t rays_ = 0;
};

// Return areas and materials by patch, as SolveRadiosity takes them.
Eigen::VectorXf PatchAreas(const Patches& patches);
std::vector<int> PatchMaterials(const Patches& patches);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_RADIOSITY_INTERNAL_SPARSE_TRANSPORT_H_
