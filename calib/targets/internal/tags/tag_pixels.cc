#include "calib/targets/internal/tags/tag_pixels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "calib/targets/internal/boards/homography.h"

namespace luxfit {
namespace {

constexpr double kEdgeReachPx = 3;  // error of the corners, and blur
constexpr double kCandidatesPerPixel = 8;
constexpr double kShareAtEdges = 0.85;  // share of the pixels chosen

bool IsOfShare(const Eigen::Array2i& pixel, double share) {
  uint32_t hash =
      static_cast<uint32_t>(pixel.x()) * 0x9e3779b1U ^ static_cast<uint32_t>(pixel.y()) * 0x85ebca77U;
  hash = (hash ^ (hash >> 15)) * 0x2c1b3c6dU;
  hash = (hash ^ (hash >> 12)) * 0x297a2d39U;
  return (hash ^ (hash >> 15)) * 0x1p-32 < share;
}

double CellAt(const TagPicture& picture, const Eigen::Vector2d& st) {
  const int last = picture.total_cells() - 1;
  return picture.cells(std::clamp(static_cast<int>(std::floor(st.y())), 0, last),
                       std::clamp(static_cast<int>(std::floor(st.x())), 0, last));
}

// Returns whether the picture changes within `reach` cells of the place.
bool IsAtEdge(const TagPicture& picture, const Eigen::Vector2d& st, double reach) {
  const double own = CellAt(picture, st);
  return CellAt(picture, st + Eigen::Vector2d(reach, 0)) != own ||
         CellAt(picture, st - Eigen::Vector2d(reach, 0)) != own ||
         CellAt(picture, st + Eigen::Vector2d(0, reach)) != own ||
         CellAt(picture, st - Eigen::Vector2d(0, reach)) != own;
}

struct Candidate {
  Eigen::Array2i pixel;
  bool is_at_edge = false;
};

}  // namespace

std::vector<Eigen::Array2i> ChooseTagPixels(const ImagePlane& grey, const TagPicture& picture,
                                            const std::array<Eigen::Vector2d, 4>& corners_px,
                                            int max_pixels) {
  const double a = picture.border_begin, b = picture.border_end, total = picture.total_cells();
  const auto cell_from_pixel =
      FitHomography({corners_px.begin(), corners_px.end()}, {{a, a}, {b, a}, {b, b}, {a, b}});
  const auto pixel_from_cell =
      FitHomography({{a, a}, {b, a}, {b, b}, {a, b}}, {corners_px.begin(), corners_px.end()});
  if (!cell_from_pixel || !pixel_from_cell) return {};
  // The picture's rim lies outside the corners.
  Eigen::Array2d low = corners_px[0], high = low;
  double side_px = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector2d rim = MapPoint(*pixel_from_cell, {k == 0 || k == 3 ? 0 : total, k < 2 ? 0 : total});
    for (const Eigen::Vector2d& corner : {corners_px[k], rim}) {
      if (!corner.allFinite()) continue;
      low = low.min(corner.array());
      high = high.max(corner.array());
    }
    side_px += (corners_px[(k + 1) % 4] - corners_px[k]).norm() / 4;
  }
  const Eigen::Array2d last(static_cast<double>(grey.cols() - 1), static_cast<double>(grey.rows() - 1));
  const Eigen::Array2i begin = low.max(0).min(last).cast<int>(),
                       end = (high + 1).max(0).min(last).cast<int>();
  const double reach = kEdgeReachPx * (b - a) / side_px;
  // A very large tag has more candidates than are worth visiting: a share of them is skipped.
  const double area_px = 1.0 * (end - begin + 1).prod();
  const double looked_at = std::min(1.0, kCandidatesPerPixel * max_pixels / area_px);
  std::vector<Candidate> candidates;
  int at_edges = 0;
  for (int v = begin.y(); v <= end.y(); ++v) {
    for (int u = begin.x(); u <= end.x(); ++u) {
      if (!IsOfShare({u, v}, looked_at) || !std::isfinite(grey(v, u))) continue;
      const Eigen::Vector2d st = MapPoint(*cell_from_pixel, Eigen::Vector2d(u, v));
      if (!(st.minCoeff() > 0) || !(st.maxCoeff() < total)) continue;
      candidates.push_back({{u, v}, IsAtEdge(picture, st, reach)});
      at_edges += candidates.back().is_at_edge ? 1 : 0;
    }
  }
  const int others = static_cast<int>(candidates.size()) - at_edges;
  const bool takes_all = static_cast<int>(candidates.size()) <= max_pixels;
  const double edge_share = takes_all ? 1 : kShareAtEdges * max_pixels / std::max(at_edges, 1);
  const double other_share = takes_all ? 1 : (1 - kShareAtEdges) * max_pixels / std::max(others, 1);
  std::vector<Eigen::Array2i> chosen;
  for (const Candidate& candidate : candidates) {
    if (IsOfShare(candidate.pixel, looked_at * (candidate.is_at_edge ? edge_share : other_share)))
      chosen.push_back(candidate.pixel);
  }
  return chosen;
}

}  // namespace luxfit
