#include "calib/register/internal/bundle/free_frame.h"

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <optional>

#include "calib/lens/internal/rotation_vector.h"
#include "calib/register/feature_model.h"

namespace luxfit {
namespace {

// Returns one observation of each tag in use.
std::map<int, const TagObservation*> TagsInUse(const BundleAdjustment& adjustment) {
  std::map<int, const TagObservation*> tags;
  for (const BundleView& view : adjustment.views) {
    if (!view.active) continue;
    for (std::size_t i = 0; i < view.tags.size(); ++i) {
      if (view.used[i]) tags.emplace(view.tags[i].id, &view.tags[i]);
    }
  }
  return tags;
}

}  // namespace

void SettleFrame(BundleAdjustment& adjustment) {
  const std::map<int, const TagObservation*> tags = TagsInUse(adjustment);
  if (tags.empty()) return;
  Eigen::Matrix3Xd adjusted(3, 4 * tags.size()), first(3, 4 * tags.size());
  Eigen::Index column = 0;
  for (const auto& [id, tag] : tags) {
    const std::array<Eigen::Vector3d, 4> corners = AdjustedCorners(adjustment, *tag);
    for (std::size_t i = 0; i < 4; ++i, ++column) {
      adjusted.col(column) = corners[i];
      first.col(column) = tag->corners_in_world[i];
    }
  }
  const std::optional<Similarity> fit = FitSimilarity(adjusted, first, 1);
  if (!fit) return;
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = fit->rotation;
  motion.translation() = fit->translation;
  for (const auto& [id, tag] : tags) {
    BundleTag& hung = adjustment.tags.at(id);
    const Eigen::Vector3d center = TagCenter(*tag);
    hung.displacement_m = motion * (center + hung.displacement_m) - center;
    hung.turn = (Eigen::Quaterniond(motion.linear()) * hung.turn).normalized();
  }
  for (BundleView& view : adjustment.views) view.SetCamFromWorld(view.CamFromWorld() * motion.inverse());
  for (BundlePoint& point : adjustment.points) point.p_in_world = motion * point.p_in_world;
}

Eigen::MatrixXd FrameRows(const BundleAdjustment& adjustment, const std::vector<int>& ids, int first,
                          int columns) {
  const std::map<int, const TagObservation*> tags = TagsInUse(adjustment);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const int id : ids) {
    for (const Eigen::Vector3d& corner : AdjustedCorners(adjustment, *tags.at(id)))
      middle += corner / (4.0 * static_cast<double>(ids.size()));
  }
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(6, columns);
  for (std::size_t t = 0; t < ids.size(); ++t) {
    const TagObservation& tag = *tags.at(ids[t]);
    const Eigen::Vector3d center = TagCenter(tag) + adjustment.tags.at(ids[t]).displacement_m;
    const Eigen::Index at = first + 6 * static_cast<Eigen::Index>(t);
    for (const Eigen::Vector3d& corner : AdjustedCorners(adjustment, tag)) {
      // dx = d(displacement) + 2 d(half turn) x arm
      const Eigen::Matrix3d by_turn = -2 * CrossMatrix(corner - center), lever = CrossMatrix(corner - middle);
      rows.block<3, 3>(0, at) += Eigen::Matrix3d::Identity();
      rows.block<3, 3>(0, at + 3) += by_turn;
      rows.block<3, 3>(3, at) += lever;
      rows.block<3, 3>(3, at + 3) += lever * by_turn;
    }
  }
  return rows;
}

}  // namespace luxfit
