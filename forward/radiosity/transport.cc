#include "forward/radiosity/transport.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "forward/factors/form_factors.h"
#include "forward/radiosity/internal/dense.h"

namespace luxfit {

TransportGeometry MakeTransportGeometry(const Patches& patches, const FormFactors& form_factors) {
  const Eigen::Index n = static_cast<Eigen::Index>(patches.patches.size());
  TransportGeometry geometry;
  geometry.patch_area_m2.resize(n);
  for (const Patch& patch : patches.patches) {
    geometry.patch_area_m2[static_cast<Eigen::Index>(geometry.patch_material.size())] =
        static_cast<float>(patch.area_m2);
    geometry.patch_material.push_back(patch.material);
  }
  // sqrt(A_i) F_ij / sqrt(A_j), with F_ij the area mean over the elements of patch i.
  const Eigen::VectorXf root = geometry.patch_area_m2.cwiseSqrt();
  FormFactorMatrix coupling = FormFactorMatrix::Zero(n, n);
  for (size_t e = 0; e < patches.elements.size(); ++e) {
    const Element& element = patches.elements[e];
    const float weight = static_cast<float>(element.area_m2) / root[element.patch];
    coupling.row(element.patch) += weight * form_factors.element_to_patch.row(static_cast<Eigen::Index>(e));
  }
  coupling = coupling * root.cwiseInverse().asDiagonal();
  geometry.coupling = 0.5f * (coupling + coupling.transpose());
  return geometry;
}

Transport::Transport(const TransportGeometry& geometry, const Eigen::VectorXd& albedo,
                     const Eigen::VectorXd& patch_factor)
    : geometry_(geometry), albedo_(albedo), patch_factor_(patch_factor) {
  // Entry by entry: minCoeff may pass over a NaN.
  if (!(albedo.array() >= 0).all() || !(albedo.array() < 1).all()) {
    throw std::invalid_argument("Transport: expected reflectances in [0, 1)");
  }
  const Eigen::Index n = geometry.patch_area_m2.size();
  if (n == 0) return;  // a room of no surfaces
  if (geometry.coupling.rows() != n)
    throw std::invalid_argument("Transport: expected a dense coupling, got a sparse one; use SolveRadiosity");
  if (patch_factor.size() > 0 && (patch_factor.size() != n || !(patch_factor.array() >= 0).all()))
    throw std::invalid_argument("Transport: expected one factor of at least 0 for each patch, or none");
  root_area_ = geometry.patch_area_m2.cwiseSqrt();
  root_albedo_.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double of_material = albedo[geometry.patch_material[static_cast<size_t>(i)]];
    const double rho =
        patch_factor.size() > 0 ? std::min(of_material * patch_factor[i], kMostReflectance) : of_material;
    root_albedo_[i] = static_cast<float>(std::sqrt(rho));
  }
  factor_.resize(n, n);
  tbb::parallel_for(Eigen::Index{0}, n, [&](Eigen::Index j) {
    const Eigen::Index below = n - j;  // the lower triangle alone is read
    factor_.col(j).tail(below) = -root_albedo_[j] * root_albedo_.tail(below).cwiseProduct(
                                                        geometry.coupling.row(j).tail(below).transpose());
    factor_(j, j) += 1.0f;
  });
  if (!CholeskyInPlace(factor_)) {
    throw std::invalid_argument(
        "Transport: no solution, the room absorbs no light (reflectance 1 everywhere)");
  }
}

Eigen::MatrixXf Transport::Exitance(const Eigen::MatrixXf& direct_lx) const {
  Eigen::MatrixXf x = root_albedo_.cwiseProduct(root_area_).asDiagonal() * direct_lx;
  CholeskySolveInPlace(factor_, x);
  return root_albedo_.cwiseQuotient(root_area_).asDiagonal() * x;
}

Eigen::MatrixXf Transport::Irradiance(const Eigen::MatrixXf& exitance) const {
  return root_area_.cwiseInverse().asDiagonal() *
         Product(geometry_.coupling, root_area_.asDiagonal() * exitance);
}

Eigen::MatrixXf Transport::ExitanceDerivatives(const std::vector<int>& materials,
                                               const Eigen::MatrixXf& illuminance_lx) const {
  const auto count = static_cast<Eigen::Index>(materials.size());
  Eigen::MatrixXf source = Eigen::MatrixXf::Zero(illuminance_lx.rows(), illuminance_lx.cols() * count);
  for (Eigen::Index c = 0; c < source.cols(); ++c) {
    const int material = materials[static_cast<size_t>(c % count)];
    for (Eigen::Index i = 0; i < source.rows(); ++i) {
      if (geometry_.patch_material[static_cast<size_t>(i)] == material)
        source(i, c) = illuminance_lx(i, c / count) *
                       static_cast<float>(patch_factor_.size() > 0 ? patch_factor_[i] : 1);
    }
  }
  return source + Exitance(Irradiance(source));
}

Eigen::MatrixXf PatchMean(const Patches& patches, const Eigen::MatrixXf& at_elements) {
  Eigen::MatrixXf mean =
      Eigen::MatrixXf::Zero(static_cast<Eigen::Index>(patches.patches.size()), at_elements.cols());
  tbb::parallel_for(Eigen::Index{0}, at_elements.cols(), [&](Eigen::Index c) {
    for (size_t e = 0; e < patches.elements.size(); ++e) {
      const Element& element = patches.elements[e];
      const Patch& patch = patches.patches[static_cast<size_t>(element.patch)];
      mean(element.patch, c) +=
          static_cast<float>(element.area_m2 / patch.area_m2) * at_elements(static_cast<Eigen::Index>(e), c);
    }
  });
  return mean;
}

}  // namespace luxfit
