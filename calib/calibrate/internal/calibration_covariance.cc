#include "calib/calibrate/internal/calibration_covariance.h"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <limits>
#include <set>

#include "calib/lens/internal/rotation_vector.h"

namespace luxfit {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Returns d(rotation vector on the left) / d(Rodrigues vector).
Eigen::Matrix3d LeftJacobian(const Eigen::Vector3d& r) {
  const double angle = r.norm();
  const Eigen::Matrix3d cross = CrossMatrix(r);
  if (angle < 1e-6) return Eigen::Matrix3d::Identity() + cross / 2;
  return Eigen::Matrix3d::Identity() + (1 - std::cos(angle)) / (angle * angle) * cross +
         (angle - std::sin(angle)) / (angle * angle * angle) * cross * cross;
}

// Returns d(twist) / d(Rodrigues vector, translation): p' = exp(w) p + v for points in the pose's outer
// frame.
Matrix6 TwistOf(const Eigen::Isometry3d& pose) {
  Matrix6 twist = Matrix6::Identity();
  twist.topLeftCorner<3, 3>() = LeftJacobian(RodriguesOf(pose).head<3>());
  twist.bottomLeftCorner<3, 3>() = CrossMatrix(pose.translation()) * twist.topLeftCorner<3, 3>();
  return twist;
}

// Returns the matrix that maps a twist of the inner frame of `pose` to its outer frame.
Matrix6 Adjoint(const Eigen::Isometry3d& pose) {
  Matrix6 adjoint = Matrix6::Zero();
  adjoint.topLeftCorner<3, 3>() = adjoint.bottomRightCorner<3, 3>() = pose.linear();
  adjoint.bottomLeftCorner<3, 3>() = CrossMatrix(pose.translation()) * pose.linear();
  return adjoint;
}

void AddBlock(const Matrix6& block, Eigen::Index row, int column, Eigen::MatrixXd& matrix) {
  matrix.block<6, 6>(row, column) += block;
}

std::set<int> SetsSeen(const CalibrationProblem& problem, int camera) {
  std::set<int> sets;
  for (const CornerObservation& corner : problem.corners) {
    if (corner.camera == camera && corner.used) sets.insert(corner.set);
  }
  return sets;
}

// Returns the matrix that selects one camera's lens and mean twist. Rows: free lens parameters, mean twist;
// columns: unknowns of the adjustment.
Eigen::MatrixXd Selection(const CalibrationProblem& problem, const CalibrationState& state,
                          const LinearizedState& linearized, std::size_t camera) {
  const int free = ParameterCount(state.lens) - FirstFreeParameter(state.lens);
  Eigen::MatrixXd selection = Eigen::MatrixXd::Zero(free + 6, linearized.jacobian.cols());
  selection.block(0, linearized.intrinsics_at[camera], free, free).setIdentity();
  const std::set<int> sets = SetsSeen(problem, static_cast<int>(camera));
  const Matrix6 to_camera = Adjoint(state.cam_from_rig[camera]);
  for (const int set : sets) {
    const auto s = static_cast<std::size_t>(set);
    AddBlock(to_camera * TwistOf(state.rig_from_target[s]) / static_cast<double>(sets.size()), free,
             linearized.rig_from_target_at[s], selection);
  }
  if (linearized.cam_from_rig_at[camera] >= 0)
    AddBlock(TwistOf(state.cam_from_rig[camera]), free, linearized.cam_from_rig_at[camera], selection);
  return selection;
}

}  // namespace

CalibrationCovariance CovarianceOf(const CalibrationProblem& problem, const CalibrationState& state,
                                   const LinearizedState& linearized, double noise_px) {
  CalibrationCovariance out;
  out.cameras.resize(state.intrinsics.size());
  out.cam_from_rig.assign(state.intrinsics.size(),
                          Matrix6::Constant(std::numeric_limits<double>::quiet_NaN()));
  out.cam_from_rig.front().setZero();
  for (ProjectionCovariance& camera : out.cameras) {
    camera.kind = state.lens.kind;
    camera.noise_px = noise_px;
  }
  // Unknowns differ by ten orders of magnitude: scale the matrix to unit diagonal before it is factorised.
  Eigen::SparseMatrix<double> hessian = linearized.jacobian.transpose() * linearized.jacobian;
  const Eigen::VectorXd diagonal = hessian.diagonal();
  if (!(diagonal.minCoeff() > 0)) return out;
  const Eigen::VectorXd unit = diagonal.cwiseSqrt().cwiseInverse();
  hessian = unit.asDiagonal() * hessian * unit.asDiagonal();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(hessian);
  if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 1e-14)) return out;
  const double variance = noise_px * noise_px;
  const auto covariance_of = [&](const Eigen::MatrixXd& selection) {
    const Eigen::MatrixXd scaled = selection * unit.asDiagonal();
    const Eigen::MatrixXd solved = factor.solve(scaled.transpose());
    return Eigen::MatrixXd(variance * scaled * solved);
  };
  for (std::size_t c = 0; c < out.cameras.size(); ++c) {
    out.cameras[c].covariance = covariance_of(Selection(problem, state, linearized, c));
    if (linearized.cam_from_rig_at[c] < 0) continue;
    Eigen::MatrixXd selection = Eigen::MatrixXd::Zero(6, hessian.cols());
    Matrix6 own = Matrix6::Identity();
    own.topLeftCorner<3, 3>() = LeftJacobian(RodriguesOf(state.cam_from_rig[c]).head<3>());
    AddBlock(own, 0, linearized.cam_from_rig_at[c], selection);
    out.cam_from_rig[c] = covariance_of(selection);
  }
  if (linearized.warp_at >= 0) {
    Eigen::MatrixXd selection = Eigen::MatrixXd::Zero(2, hessian.cols());
    selection.block<2, 2>(0, linearized.warp_at).setIdentity();
    out.warp_sigma_m = covariance_of(selection).diagonal().cwiseMax(0).cwiseSqrt();
  }
  return out;
}

}  // namespace luxfit
