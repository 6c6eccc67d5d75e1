#include "calib/register/internal/bundle/bundle_problem.h"

#include <set>

namespace luxfit {
namespace {

void AddCorners(const BundleContext& context, BundleAdjustment& adjustment, BundleView& view,
                BundleProblem& built) {
  for (std::size_t i = 0; i < view.tags.size(); ++i) {
    if (!view.used[i]) continue;
    const TagObservation& tag = view.tags[i];
    BundleTag& hung = adjustment.tags[tag.id];
    for (std::size_t corner = 0; corner < 4; ++corner) {
      built.problem->AddResidualBlock(
          new TagCornerCost(context.CameraOf(view), tag.corners_in_world[corner], TagCenter(tag),
                            {tag.corners_px[corner], tag.sigma_px * adjustment.corner_weight_scale}),
          built.loss.get(), view.pose.data(), hung.displacement_m.data(), hung.turn.coeffs().data(),
          &adjustment.size_error);
    }
  }
}

void AddPoints(const BundleContext& context, BundleAdjustment& adjustment, BundleView& view,
               const std::vector<bool>& used, BundleProblem& built) {
  for (const PointObservation& seen : view.points) {
    const auto point = static_cast<std::size_t>(seen.point);
    if (!seen.used || !used[point]) continue;
    built.problem->AddResidualBlock(
        new PointCost(context.CameraOf(view), {seen.pixel, adjustment.point_sigma_px}), built.loss.get(),
        adjustment.points[point].p_in_world.data(), view.pose.data());
  }
}

// Returns W of the prior W d of a surveyed tag's displacement: along the normal of its surface, if it has one,
// d is as small as the surface says, else as small as the survey does.
Eigen::Matrix3d WhiteningOf(const BundleTag& tag, double survey_sigma_m) {
  Eigen::Matrix3d whitening = Eigen::Matrix3d::Identity() / survey_sigma_m;
  if (!tag.surface) return whitening;
  const Eigen::Vector3d& n = tag.surface->normal;
  whitening += (1 / tag.surface->sigma_m - 1 / survey_sigma_m) * n * n.transpose();
  return whitening;
}

// Frees or holds the tags. A surveyed tag may be off its place but not turned. An unsurveyed tag is where the
// photos put it, except the one that is the frame.
void SettleTags(const BundleContext& context, BundleAdjustment& adjustment, const std::set<int>& ids,
                Frame frame, BundleProblem& built) {
  const bool is_surveyed = adjustment.fixed_tag < 0;
  const double sigma_m = context.options.survey_sigma_m;
  for (const int id : ids) {
    BundleTag& tag = adjustment.tags.at(id);
    double* const displacement_m = tag.displacement_m.data();
    double* const turn = tag.turn.coeffs().data();
    const bool may_move = is_surveyed ? sigma_m > 0 : id != adjustment.fixed_tag || frame == Frame::kFree;
    const bool may_turn = !is_surveyed && may_move;
    if (may_move) {
      built.tag_ids.push_back(id);
      built.tag_parts.push_back(displacement_m);
    }
    if (may_move && is_surveyed)
      built.problem->AddResidualBlock(new ZeroPrior<3>(WhiteningOf(tag, sigma_m)), nullptr, displacement_m);
    if (!may_move) built.problem->SetParameterBlockConstant(displacement_m);
    if (may_turn) {
      built.problem->SetManifold(turn, built.turn_manifold.get());
      built.tag_parts.push_back(turn);
    } else {
      built.problem->SetParameterBlockConstant(turn);
    }
  }
  if (ids.empty()) return;
  if (context.options.tag_size_sigma > 0) {
    built.size_error = &adjustment.size_error;
    built.problem->AddResidualBlock(new ZeroPrior<1>(context.options.tag_size_sigma), nullptr,
                                    built.size_error);
  } else {
    built.problem->SetParameterBlockConstant(&adjustment.size_error);
  }
}

void SettlePoints(BundleAdjustment& adjustment, const std::vector<bool>& used, BundleProblem& built) {
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    BundlePoint& point = adjustment.points[i];
    built.points.push_back(point.p_in_world.data());
    if (!point.surface) continue;
    built.problem->AddResidualBlock(
        new SurfaceCost(point.surface->normal, point.surface->on_surface, point.surface->sigma_m),
        built.loss.get(), point.p_in_world.data());
  }
}

}  // namespace

BundleProblem BuildBundleProblem(const BundleContext& context, BundleAdjustment& adjustment, Frame frame) {
  BundleProblem built;
  ceres::Problem::Options options;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  built.loss = std::make_unique<ceres::HuberLoss>(context.options.huber_sigmas);
  built.pose_manifold = std::make_unique<PoseManifold>();
  built.turn_manifold = std::make_unique<ceres::EigenQuaternionManifold>();
  built.problem = std::make_unique<ceres::Problem>(options);
  const std::vector<bool> used = UsedPoints(adjustment);
  std::set<int> ids;
  for (BundleView& view : adjustment.views) {
    if (!view.active) continue;
    built.problem->AddParameterBlock(view.pose.data(), 7, built.pose_manifold.get());
    built.poses.push_back(view.pose.data());
    AddCorners(context, adjustment, view, built);
    AddPoints(context, adjustment, view, used, built);
    for (std::size_t i = 0; i < view.tags.size(); ++i) {
      if (view.used[i]) ids.insert(view.tags[i].id);
    }
  }
  SettleTags(context, adjustment, ids, frame, built);
  SettlePoints(adjustment, used, built);
  return built;
}

}  // namespace luxfit
