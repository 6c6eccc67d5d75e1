#include "inverse/furniture/internal/cell_judge.h"

#include <algorithm>

namespace luxfit {

CellJudge::CellJudge(const SweptViews& swept)
    : swept_(swept), signatures_(swept.views.empty() ? 0 : swept.views.front().states) {}

int CellJudge::VoteOn(const Eigen::Vector3d& place, const Eigen::Vector3d& normal, std::uint64_t& agreeing) {
  agreeing = 0;
  FindFacing(place, normal);
  if (count_ < swept_.fewest_views) return 0;
  if (UnexplainedOf((std::uint64_t{1} << count_) - 1) < 2) return -1;
  Sample();
  if (count_ < swept_.fewest_views) return 0;
  const std::uint64_t best = signatures_.LargestAgreement(swept_.tolerance);
  const int agree = __builtin_popcountll(best), unexplained = UnexplainedOf(best);
  if (agree < swept_.fewest_views || agree < kLeastShareThatAgrees * count_) return -1;
  if (2 * unexplained < agree) return -1;
  for (int i = 0; i < count_; ++i) {
    if ((best >> i & 1U) != 0 && !facing_[static_cast<size_t>(i)].is_explained)
      agreeing |= std::uint64_t{1} << facing_[static_cast<size_t>(i)].view;
  }
  return 1;
}

void CellJudge::FindFacing(const Eigen::Vector3d& place, const Eigen::Vector3d& normal) {
  count_ = 0;
  const size_t views = std::min<size_t>(swept_.views.size(), kMostViews - 1);
  for (size_t v = 0; v < views; ++v) {
    const Eigen::Vector3d to_eye = swept_.eyes[v] - place;
    const double distance = to_eye.norm();
    if (to_eye.dot(normal) < kLeastCosine * distance) continue;
    const Eigen::Vector2d pixel = PixelOf(swept_.views[v], place);
    if (!(pixel.x() > 0)) continue;
    const MeshAgreement& mesh = swept_.mesh[v];
    const size_t cell = mesh.CellOf(pixel.x(), pixel.y());
    if (distance > mesh.distance_m[cell] + kOnMeshM) continue;
    facing_[static_cast<size_t>(count_++)] = {static_cast<int>(v), mesh.is_explained[cell] != 0, pixel};
  }
}

int CellJudge::UnexplainedOf(std::uint64_t set) const {
  int unexplained = 0;
  for (int i = 0; i < count_; ++i)
    unexplained += (set >> i & 1U) != 0 && !facing_[static_cast<size_t>(i)].is_explained ? 1 : 0;
  return unexplained;
}

void CellJudge::Sample() {
  signatures_.Clear();
  int kept = 0;
  for (int i = 0; i < count_; ++i) {
    const Facing& f = facing_[static_cast<size_t>(i)];
    if (!signatures_.Add(swept_.views[static_cast<size_t>(f.view)], f.pixel.x(), f.pixel.y())) continue;
    facing_[static_cast<size_t>(kept++)] = f;
  }
  count_ = kept;
}

}  // namespace luxfit
