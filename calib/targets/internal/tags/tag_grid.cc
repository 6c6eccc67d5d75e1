#include "calib/targets/internal/tags/tag_grid.h"

#include <Eigen/LU>
#include <algorithm>
#include <numeric>

#include "calib/targets/internal/boards/homography.h"

namespace luxfit {
namespace {

constexpr std::size_t kNearTags = 4;
constexpr double kReachTags = 3.5;  // tag diagonals: a prediction from further away is unreliable

Eigen::Vector2d Middle(const GridTag& tag) {
  return (tag.corners_m[0] + tag.corners_m[1] + tag.corners_m[2] + tag.corners_m[3]) / 4;
}

double Diagonal(const GridTag& tag) { return (tag.corners_m[2] - tag.corners_m[0]).norm(); }

const GridTag& TagOf(const TagGrid& grid, const SeenTag& seen) {
  return grid[static_cast<std::size_t>(seen.number)];
}

// Returns indices into `seen`, nearest first, at most `count`.
std::vector<std::size_t> NearestTags(const TagGrid& grid, const std::vector<SeenTag>& seen,
                                     const Eigen::Vector2d& place_m, std::size_t count) {
  std::vector<std::size_t> order(seen.size());
  std::iota(order.begin(), order.end(), 0);
  const auto distance = [&](std::size_t i) { return (Middle(TagOf(grid, seen[i])) - place_m).squaredNorm(); };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
  order.resize(std::min(order.size(), count));
  return order;
}

std::optional<Eigen::Matrix3d> PixelFromBoardBy(const TagGrid& grid, const std::vector<SeenTag>& seen,
                                                const std::vector<std::size_t>& by) {
  std::vector<Eigen::Vector2d> from, to;
  for (const std::size_t i : by) {
    const GridTag& tag = TagOf(grid, seen[i]);
    from.insert(from.end(), tag.corners_m.begin(), tag.corners_m.end());
    to.insert(to.end(), seen[i].corners_px.begin(), seen[i].corners_px.end());
  }
  return FitHomography(from, to);
}

std::array<Eigen::Vector2d, 4> Mapped(const Eigen::Matrix3d& homography, const GridTag& tag) {
  std::array<Eigen::Vector2d, 4> pixels;
  for (std::size_t i = 0; i < 4; ++i) pixels[i] = MapPoint(homography, tag.corners_m[i]);
  return pixels;
}

// Returns whether `a` alone predicts `b` where it is.
bool Predicts(const TagGrid& grid, const SeenTag& a, const TagFrame& frame, const SeenTag& b) {
  if (!frame) return false;
  const std::array<Eigen::Vector2d, 4>& from = TagOf(grid, a).corners_m;
  Eigen::Matrix2d board_from_tag;
  board_from_tag << from[1] - from[0], from[3] - from[0];
  const Eigen::Matrix2d tag_from_board = board_from_tag.inverse();
  double error_px = 0, side_px = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d expected =
        MapPoint(*frame, tag_from_board * (TagOf(grid, b).corners_m[i] - from[0]));
    error_px += (expected - b.corners_px[i]).norm() / 4;
    side_px += (b.corners_px[(i + 1) % 4] - b.corners_px[i]).norm() / 4;
  }
  // The further the other tag is, the worse a tag's own corners extrapolate.
  const double tags_away =
      (Middle(TagOf(grid, a)) - Middle(TagOf(grid, b))).norm() / Diagonal(TagOf(grid, a));
  return error_px < 0.25 * side_px * std::max(1.0, tags_away);
}

// Returns whether the corners go round clockwise and enclose an area.
bool IsProper(const std::array<Eigen::Vector2d, 4>& corners_px) {
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d a = corners_px[(i + 1) % 4] - corners_px[i];
    const Eigen::Vector2d b = corners_px[(i + 2) % 4] - corners_px[(i + 1) % 4];
    if (!(a.x() * b.y() - a.y() * b.x() > 1)) return false;
  }
  return true;
}

}  // namespace

std::vector<TagFrame> FramesOf(const std::vector<SeenTag>& tags) {
  std::vector<TagFrame> frames;
  frames.reserve(tags.size());
  for (const SeenTag& tag : tags) frames.push_back(UnitSquareTo(tag.corners_px));
  return frames;
}

std::vector<SeenTag> AgreeingTags(const TagGrid& grid, const std::vector<SeenTag>& found,
                                  const std::vector<TagFrame>& frames) {
  std::vector<std::size_t> group(found.size());
  std::iota(group.begin(), group.end(), 0);
  for (std::size_t i = 0; i < found.size(); ++i) {
    // The nearest is the tag itself.
    for (const std::size_t j : NearestTags(grid, found, Middle(TagOf(grid, found[i])), kNearTags + 1)) {
      if (j == i || found[i].number == found[j].number || group[i] == group[j]) continue;
      if (!Predicts(grid, found[i], frames[i], found[j]) && !Predicts(grid, found[j], frames[j], found[i]))
        continue;
      const std::size_t from = group[j], to = group[i];
      std::replace(group.begin(), group.end(), from, to);
    }
  }
  std::size_t best = 0;
  std::ptrdiff_t most = 0;
  for (std::size_t i = 0; i < group.size(); ++i) {
    const std::ptrdiff_t size = std::count(group.begin(), group.end(), group[i]);
    if (size > most) {
      most = size;
      best = group[i];
    }
  }
  std::vector<SeenTag> agreeing;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const bool is_new = std::none_of(agreeing.begin(), agreeing.end(),
                                     [&](const SeenTag& tag) { return tag.number == found[i].number; });
    if (group[i] == best && is_new) agreeing.push_back(found[i]);
  }
  return agreeing;
}

std::optional<Eigen::Matrix3d> PixelFromBoardNear(const TagGrid& grid, const std::vector<SeenTag>& seen,
                                                  const Eigen::Vector2d& place_m) {
  std::vector<std::size_t> near = NearestTags(grid, seen, place_m, kNearTags);
  if (near.empty()) return std::nullopt;
  const double reach_m = kReachTags * Diagonal(TagOf(grid, seen[near.front()]));
  if ((Middle(TagOf(grid, seen[near.front()])) - place_m).norm() > reach_m) return std::nullopt;
  near.erase(std::remove_if(near.begin(), near.end(),
                            [&](std::size_t i) {
                              return (Middle(TagOf(grid, seen[i])) - place_m).norm() > 2 * reach_m;
                            }),
             near.end());
  return PixelFromBoardBy(grid, seen, near);
}

std::vector<SeenTag> WithPredictedTags(const ImagePlane& grey, const TagGrid& grid,
                                       const std::vector<TagCells>& cells, std::vector<SeenTag> seen,
                                       const MeasureTag& measure) {
  std::vector<bool> is_seen(grid.size(), false);
  for (const SeenTag& tag : seen) is_seen[static_cast<std::size_t>(tag.number)] = true;
  bool grows = true;
  while (grows) {  // from tag to tag: each new one predicts its neighbours
    grows = false;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if (is_seen[i]) continue;
      const auto homography = PixelFromBoardNear(grid, seen, Middle(grid[i]));
      if (!homography) continue;
      SeenTag tag{static_cast<int>(i), Mapped(*homography, grid[i])};
      if (!IsProper(tag.corners_px)) continue;
      const auto pixel_from_tag = UnitSquareTo(tag.corners_px);
      if (!pixel_from_tag || !ShowsTag(grey, *pixel_from_tag, cells[i])) continue;
      const std::optional<SeenTag> measured = measure(tag);
      if (!measured) continue;
      seen.push_back(*measured);
      is_seen[i] = true;
      grows = true;
    }
  }
  return seen;
}

}  // namespace luxfit
