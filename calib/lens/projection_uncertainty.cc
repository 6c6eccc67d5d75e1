#include "calib/lens/projection_uncertainty.h"

#include <cmath>
#include <limits>

#include "calib/lens/internal/lens_function.h"
#include "calib/lens/internal/rotation_vector.h"
#include "calib/lens/lens_family.h"

namespace luxfit {
namespace {

constexpr double kUnknownSigma = std::numeric_limits<double>::quiet_NaN();

LensFunction FunctionOf(const Camera& camera, const LensKind& kind) {
  LensFunction lens;
  lens.kind = kind;
  if (OpsOf(kind.lens).is_in_mrcal) lens.model = ToMrcal(camera, kind.coefficients).model;
  return lens;
}

}  // namespace

Eigen::Matrix2d ProjectionCovarianceAt(const Camera& camera, const ProjectionCovariance& uncertainty,
                                       const Eigen::Vector2d& pixel, double range_m) {
  const Eigen::Vector3d direction = Unproject(camera, pixel);
  const LensFunction lens = FunctionOf(camera, uncertainty.kind);
  const int first = FirstFreeParameter(lens), free = ParameterCount(lens) - first;
  if (!direction.allFinite() || uncertainty.covariance.rows() != free + 6)
    return Eigen::Matrix2d::Constant(kUnknownSigma);
  const LensPoint image = ProjectByLens(lens, ParametersOf(lens, camera).data(), direction, true);
  if (!image.pixel.allFinite()) return Eigen::Matrix2d::Constant(kUnknownSigma);
  Eigen::Matrix<double, 2, Eigen::Dynamic> jacobian(2, free + 6);
  jacobian.leftCols(free) = image.d_parameters.rightCols(free);
  // Projection does not depend on the range: its derivative is that at the unit direction, divided by the
  // range.
  jacobian.middleCols<3>(free) = -image.d_point * CrossMatrix(direction);
  jacobian.rightCols<3>() = image.d_point / range_m;
  return jacobian * uncertainty.covariance * jacobian.transpose();
}

double ProjectionSigmaPx(const Camera& camera, const ProjectionCovariance& uncertainty,
                         const Eigen::Vector2d& pixel, double range_m) {
  const Eigen::Matrix2d covariance = ProjectionCovarianceAt(camera, uncertainty, pixel, range_m);
  if (!covariance.allFinite()) return kUnknownSigma;
  const double mean = covariance.trace() / 2;
  const double half_difference = (covariance(0, 0) - covariance(1, 1)) / 2;
  return std::sqrt(mean + std::hypot(half_difference, covariance(0, 1)));
}

Eigen::MatrixXd ProjectionSigmaMap(const Camera& camera, const ProjectionCovariance& uncertainty, int columns,
                                   int rows, double range_m) {
  Eigen::MatrixXd sigma_px(rows, columns);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Eigen::Vector2d pixel((column + 0.5) * camera.width_px / columns - 0.5,
                                  (row + 0.5) * camera.height_px / rows - 0.5);
      sigma_px(row, column) = ProjectionSigmaPx(camera, uncertainty, pixel, range_m);
    }
  }
  return sigma_px;
}

}  // namespace luxfit
