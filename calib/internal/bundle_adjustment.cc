#include "calib/internal/bundle_adjustment.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <utility>

#include "calib/internal/reprojection_cost.h"

namespace luxfit {
namespace {

Eigen::Vector3d CenterInWorld(const TagObservation& tag) {
  const std::array<Eigen::Vector3d, 4>& p = tag.corners_in_world;
  return (p[0] + p[1] + p[2] + p[3]) / 4;
}

struct Problem {
  std::unique_ptr<ceres::Problem> problem;
  // Shared by every residual and every pose block; owned here, as the problem is told.
  std::unique_ptr<ceres::LossFunction> loss;
  std::unique_ptr<ceres::Manifold> manifold;
};

Problem BuildProblem(const BundleContext& context, BundleAdjustment& adjustment) {
  Problem built;
  ceres::Problem::Options problem_options;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  built.loss = std::make_unique<ceres::HuberLoss>(context.options.huber_sigmas);
  built.manifold = std::make_unique<ceres::EigenQuaternionManifold>();
  built.problem = std::make_unique<ceres::Problem>(problem_options);
  const double survey_sigma_m = context.options.survey_sigma_m;

  std::set<int> ids;
  for (BundleView& view : adjustment.views) {
    if (!view.active) continue;
    double* const q = view.world_from_cam.coeffs().data();
    double* const c = view.center_in_world.data();
    for (std::size_t i = 0; i < view.tags.size(); ++i) {
      if (!view.used[i]) continue;
      const TagObservation& tag = view.tags[i];
      Eigen::Vector3d& displacement_m =
          adjustment.displacement_m.emplace(tag.id, Eigen::Vector3d::Zero()).first->second;
      ids.insert(tag.id);
      for (std::size_t corner = 0; corner < 4; ++corner) {
        built.problem->AddResidualBlock(
            new ReprojectionCost(context.cameras[static_cast<std::size_t>(view.camera)],
                                 tag.corners_in_world[corner], CenterInWorld(tag), tag.corners_px[corner],
                                 tag.sigma_px),
            built.loss.get(), q, c, displacement_m.data(), &adjustment.size_error);
      }
    }
    built.problem->SetManifold(q, built.manifold.get());
  }
  for (const int id : ids) {
    double* const displacement_m = adjustment.displacement_m.at(id).data();
    if (survey_sigma_m > 0) {
      built.problem->AddResidualBlock(new ZeroPrior<3>(survey_sigma_m), nullptr, displacement_m);
    } else {
      built.problem->SetParameterBlockConstant(displacement_m);
    }
  }
  if (context.options.tag_size_sigma > 0) {
    built.problem->AddResidualBlock(new ZeroPrior<1>(context.options.tag_size_sigma), nullptr,
                                    &adjustment.size_error);
  } else {
    built.problem->SetParameterBlockConstant(&adjustment.size_error);
  }
  return built;
}

void Rescale(const BundleContext& context, BundleAdjustment& adjustment) {
  std::vector<double> squared;
  double unknowns = 0;
  for (const BundleView& view : adjustment.views) {
    if (!view.active) continue;
    unknowns += 6;
    for (const BundleCornerError& error : BundleViewErrors(context, adjustment, view)) {
      squared.push_back(error.sigmas * error.sigmas);
    }
  }
  adjustment.scale = adjustment.reduced_chi2 = 1;
  const double spare = 2 * static_cast<double>(squared.size()) - unknowns;
  if (spare <= 0) return;
  // What the fit has taken out of the residuals.
  const double correction = 2 * static_cast<double>(squared.size()) / spare;
  const auto middle = squared.begin() + static_cast<std::ptrdiff_t>(squared.size() / 2);
  std::nth_element(squared.begin(), middle, squared.end());
  constexpr double kMedianOfTwo = 1.386;  // median of chi2 with two degrees of freedom, 2 ln 2
  adjustment.scale = std::sqrt(std::max(1.0, *middle / kMedianOfTwo * correction));
  double sum = 0, count = 0;
  for (const double value : squared) {
    if (value > std::pow(kBundleRejectedSigmas * adjustment.scale, 2)) continue;
    sum += value;
    count += 1;
  }
  adjustment.reduced_chi2 = std::max(1.0, sum / std::max(1.0, 2 * count - unknowns));
}

}  // namespace

std::vector<BundleCornerError> BundleTagErrors(const BundleContext& context,
                                               const BundleAdjustment& adjustment, const BundleView& view,
                                               std::size_t tag_index) {
  const TagObservation& tag = view.tags[tag_index];
  const Eigen::Isometry3d cam_from_world = view.CamFromWorld();
  const Eigen::Vector3d displacement_m = adjustment.displacement_m.at(tag.id);
  const Eigen::Vector3d center = CenterInWorld(tag);
  std::vector<BundleCornerError> errors;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d pixel =
        Project(context.cameras[static_cast<std::size_t>(view.camera)],
                cam_from_world * (tag.corners_in_world[i] + displacement_m +
                                  adjustment.size_error * (tag.corners_in_world[i] - center)));
    const Eigen::Vector2d error_px = pixel - tag.corners_px[i];
    errors.push_back({error_px, error_px.norm() / tag.sigma_px});
  }
  return errors;
}

std::vector<BundleCornerError> BundleViewErrors(const BundleContext& context,
                                                const BundleAdjustment& adjustment, const BundleView& view) {
  std::vector<BundleCornerError> errors;
  for (std::size_t i = 0; i < view.tags.size(); ++i) {
    if (!view.used[i]) continue;
    const std::vector<BundleCornerError> of_tag = BundleTagErrors(context, adjustment, view, i);
    errors.insert(errors.end(), of_tag.begin(), of_tag.end());
  }
  return errors;
}

double BundleRmsSigmas(const std::vector<BundleCornerError>& errors) {
  double sum = 0;
  for (const BundleCornerError& error : errors) sum += error.sigmas * error.sigmas;
  return errors.empty() ? 0 : std::sqrt(sum / (2 * static_cast<double>(errors.size())));
}

void SolveBundle(const BundleContext& context, BundleAdjustment& adjustment) {
  const bool any = std::any_of(adjustment.views.begin(), adjustment.views.end(),
                               [](const BundleView& v) { return v.active; });
  if (!any) {
    adjustment.converged = false;
    adjustment.message = "no view could be registered";
    return;
  }
  const Problem built = BuildProblem(context, adjustment);
  ceres::Solver::Options solver_options;
  solver_options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  solver_options.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
  solver_options.max_num_iterations = 200;
  solver_options.function_tolerance = 1e-8;
  solver_options.parameter_tolerance = 1e-10;
  solver_options.num_threads = 1;
  solver_options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options, built.problem.get(), &summary);
  adjustment.converged = summary.termination_type == ceres::CONVERGENCE && summary.IsSolutionUsable();
  adjustment.message = summary.message;
  Rescale(context, adjustment);
}

BundleCovariance ComputeBundleCovariance(const BundleContext& context, BundleAdjustment& adjustment) {
  const Problem built = BuildProblem(context, adjustment);
  ceres::Covariance::Options covariance_options;
  covariance_options.algorithm_type = ceres::SPARSE_QR;
  covariance_options.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
  ceres::Covariance solver(covariance_options);
  std::vector<std::pair<const double*, const double*>> blocks;
  for (const BundleView& view : adjustment.views) {
    if (!view.active) continue;
    const double* const q = view.world_from_cam.coeffs().data();
    const double* const c = view.center_in_world.data();
    blocks.insert(blocks.end(), {{q, q}, {q, c}, {c, c}});
  }
  const double* const size_error = &adjustment.size_error;
  const bool with_size = context.options.tag_size_sigma > 0;
  if (with_size) blocks.emplace_back(size_error, size_error);
  BundleCovariance covariance;
  covariance.determined = solver.Compute(blocks, built.problem.get());
  if (!covariance.determined) return covariance;
  if (with_size) {
    double variance = 0;
    solver.GetCovarianceBlock(size_error, size_error, &variance);
    covariance.size_error_sigma = std::sqrt(adjustment.reduced_chi2 * variance);
  }
  // The manifold's tangent is half a rotation vector.
  Eigen::Matrix<double, 6, 1> to_rotation_vector;
  to_rotation_vector << 2, 2, 2, 1, 1, 1;
  for (const BundleView& view : adjustment.views) {
    if (!view.active) continue;
    Eigen::Matrix<double, 6, 6, Eigen::RowMajor> tangent;
    solver.GetCovarianceMatrixInTangentSpace(
        {view.world_from_cam.coeffs().data(), view.center_in_world.data()}, tangent.data());
    covariance.of_views.emplace_back(adjustment.reduced_chi2 * (to_rotation_vector.asDiagonal() * tangent *
                                                                to_rotation_vector.asDiagonal()));
  }
  return covariance;
}

}  // namespace luxfit
