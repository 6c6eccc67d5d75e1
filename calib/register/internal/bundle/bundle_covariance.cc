#include "calib/register/internal/bundle/bundle_covariance.h"

#include <ceres/crs_matrix.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "calib/register/internal/bundle/bundle_problem.h"
#include "calib/register/internal/bundle/free_frame.h"

namespace luxfit {
namespace {

// Holds the rows of one point in the normal equations: its own block, and its coupling to each other column.
struct PointRows {
  Eigen::Matrix3d own = Eigen::Matrix3d::Zero();
  std::map<int, Eigen::Vector3d> coupling;
};

// Returns B - E C^-1 E^T of a Jacobian whose first `kept` columns stay. Not finite where a point is
// undetermined.
Eigen::MatrixXd ReducedNormalMatrix(const ceres::CRSMatrix& jacobian, int kept) {
  Eigen::MatrixXd reduced = Eigen::MatrixXd::Zero(kept, kept);
  std::vector<PointRows> points(static_cast<std::size_t>((jacobian.num_cols - kept) / 3));
  for (int row = 0; row < jacobian.num_rows; ++row) {
    const auto r = static_cast<std::size_t>(row);
    const int begin = jacobian.rows[r], end = jacobian.rows[r + 1];
    Eigen::Vector3d by_point = Eigen::Vector3d::Zero();
    int point = -1;
    for (int k = begin; k < end; ++k) {
      const int column = jacobian.cols[static_cast<std::size_t>(k)];
      if (column < kept) continue;
      point = (column - kept) / 3;
      by_point[(column - kept) % 3] = jacobian.values[static_cast<std::size_t>(k)];
    }
    PointRows* const rows = point < 0 ? nullptr : &points[static_cast<std::size_t>(point)];
    if (rows != nullptr) rows->own += by_point * by_point.transpose();
    for (int a = begin; a < end; ++a) {
      const int column_a = jacobian.cols[static_cast<std::size_t>(a)];
      if (column_a >= kept) continue;
      const double value_a = jacobian.values[static_cast<std::size_t>(a)];
      for (int b = begin; b < end; ++b) {
        const int column_b = jacobian.cols[static_cast<std::size_t>(b)];
        if (column_b < kept)
          reduced(column_a, column_b) += value_a * jacobian.values[static_cast<std::size_t>(b)];
      }
      if (rows == nullptr) continue;
      rows->coupling.emplace(column_a, Eigen::Vector3d::Zero()).first->second += value_a * by_point;
    }
  }
  for (const PointRows& rows : points) {
    const Eigen::Matrix3d inverse = rows.own.inverse();
    for (const auto& [a, value_a] : rows.coupling) {
      const Eigen::RowVector3d weighted = value_a.transpose() * inverse;
      for (const auto& [b, value_b] : rows.coupling) reduced(a, b) -= weighted * value_b;
    }
  }
  return reduced;
}

// Returns the inverse of a symmetric positive matrix; empty where it is singular to working precision.
Eigen::MatrixXd InverseIfRegular(const Eigen::MatrixXd& normal) {
  if (!normal.allFinite() || normal.diagonal().minCoeff() <= 0) return {};
  const Eigen::VectorXd unit = normal.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<Eigen::MatrixXd> factored(unit.asDiagonal() * normal * unit.asDiagonal());
  constexpr double kSingular = 1e-13;  // least pivot of a matrix with unit diagonal
  if (factored.info() != Eigen::Success || factored.vectorD().minCoeff() < kSingular) return {};
  const Eigen::MatrixXd inverse = factored.solve(Eigen::MatrixXd::Identity(normal.rows(), normal.cols()));
  return unit.asDiagonal() * inverse * unit.asDiagonal();
}

// Returns a covariance of poses in rotation vectors, symmetric to the last bit. The manifold's tangent is half
// a rotation vector.
Eigen::MatrixXd InRotationVectors(const Eigen::MatrixXd& of_tangents) {
  Eigen::VectorXd factor = Eigen::VectorXd::Ones(of_tangents.rows());
  for (Eigen::Index at = 0; at < factor.size(); at += 6) factor.segment<3>(at).setConstant(2);
  const Eigen::MatrixXd symmetric = (of_tangents + of_tangents.transpose()) / 2;
  return factor.asDiagonal() * symmetric * factor.asDiagonal();
}

}  // namespace

BundleCovariance ComputeBundleCovariance(const BundleContext& context, BundleAdjustment& adjustment) {
  const bool has_frame_tag = adjustment.fixed_tag >= 0;
  const BundleProblem built =
      BuildBundleProblem(context, adjustment, has_frame_tag ? Frame::kFree : Frame::kHeld);
  BundleCovariance covariance;
  if (built.poses.empty()) return covariance;
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = built.poses;
  options.parameter_blocks.insert(options.parameter_blocks.end(), built.tag_parts.begin(),
                                  built.tag_parts.end());
  if (built.size_error != nullptr) options.parameter_blocks.push_back(built.size_error);
  int kept = 0;
  for (const double* const block : options.parameter_blocks)
    kept += built.problem->ParameterBlockTangentSize(block);
  options.parameter_blocks.insert(options.parameter_blocks.end(), built.points.begin(), built.points.end());
  ceres::CRSMatrix jacobian;
  if (!built.problem->Evaluate(options, nullptr, nullptr, nullptr, &jacobian)) return covariance;
  Eigen::MatrixXd normal = ReducedNormalMatrix(jacobian, kept);
  if (has_frame_tag) {
    const auto first = static_cast<int>(6 * built.poses.size());
    const Eigen::MatrixXd rows = FrameRows(adjustment, built.tag_ids, first, kept);
    constexpr double kHard = 1e3;  // relative to the best known unknown
    normal += kHard * normal.diagonal().maxCoeff() * rows.transpose() * rows;
  }
  const Eigen::MatrixXd inverse = InverseIfRegular(normal);
  covariance.determined = inverse.size() > 0;
  if (!covariance.determined) return covariance;
  covariance.variance_factor = built.points.empty() ? adjustment.reduced_chi2 : 1;
  if (built.size_error != nullptr)
    covariance.size_error_sigma = std::sqrt(covariance.variance_factor * inverse(kept - 1, kept - 1));
  const auto pose_columns = static_cast<Eigen::Index>(6 * built.poses.size());
  covariance.of_poses =
      covariance.variance_factor * InRotationVectors(inverse.topLeftCorner(pose_columns, pose_columns));
  if (has_frame_tag) return covariance;
  covariance.displaced_tags = built.tag_ids;
  covariance.of_displacements.reserve(built.tag_ids.size());
  for (std::size_t i = 0; i < built.tag_ids.size(); ++i) {
    const Eigen::Index at = pose_columns + 3 * static_cast<Eigen::Index>(i);
    covariance.of_displacements.emplace_back(inverse.block<3, 3>(at, at));
  }
  return covariance;
}

}  // namespace luxfit
