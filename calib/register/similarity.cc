#include "calib/register/similarity.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <cmath>

namespace luxfit {
namespace {

// Points count as lying on a line where their second extent is below this part of the first.
constexpr double kLine = 1e-3;

bool SpansAPlane(const Eigen::Matrix3Xd& centred) {
  const Eigen::Matrix3d scatter = centred * centred.transpose();
  const Eigen::Vector3d squared =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter, Eigen::EigenvaluesOnly).eigenvalues();
  return squared.allFinite() && squared[2] > 0 && squared[1] > kLine * kLine * squared[2];
}

}  // namespace

Similarity Similarity::Inverse() const {
  Similarity inverse;
  inverse.scale = 1 / scale;
  inverse.rotation = rotation.transpose();
  inverse.translation = -(inverse.scale * (inverse.rotation * translation));
  return inverse;
}

std::optional<Similarity> FitSimilarity(const Eigen::Matrix3Xd& points_in_a,
                                        const Eigen::Matrix3Xd& points_in_b, std::optional<double> scale) {
  if (points_in_a.cols() != points_in_b.cols() || points_in_a.cols() < 3) return std::nullopt;
  const Eigen::Vector3d middle_a = points_in_a.rowwise().mean(), middle_b = points_in_b.rowwise().mean();
  const Eigen::Matrix3Xd a = points_in_a.colwise() - middle_a, b = points_in_b.colwise() - middle_b;
  if (!SpansAPlane(a) || !SpansAPlane(b)) return std::nullopt;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(b * a.transpose(), Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d sign = Eigen::Vector3d::Ones();
  sign[2] = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  Similarity fit;
  fit.rotation = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  fit.scale = scale.value_or(svd.singularValues().dot(sign) / a.squaredNorm());
  fit.translation = middle_b - fit.scale * (fit.rotation * middle_a);
  if (!(fit.scale > 0) || !std::isfinite(fit.scale)) return std::nullopt;
  return fit;
}

Eigen::Isometry3d PoseUnder(const Similarity& b_from_a, const Eigen::Isometry3d& cam_from_a) {
  Eigen::Isometry3d cam_from_b = Eigen::Isometry3d::Identity();
  cam_from_b.linear() = cam_from_a.linear() * b_from_a.rotation.transpose();
  cam_from_b.translation() =
      b_from_a.scale * cam_from_a.translation() - cam_from_b.linear() * b_from_a.translation;
  return cam_from_b;
}

}  // namespace luxfit
