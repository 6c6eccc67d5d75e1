#include "inverse/observe/observe.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace luxfit {
namespace {

// A tag's paper reaches beyond its black square: at least one cell of white border, with mounts often more.
constexpr double kTagMargin = 1.5;

using IndexImage = Eigen::Array<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

bool Inside(const PixelQuad& quad, const Eigen::Vector2d& p) {
  int left = 0, right = 0;
  for (size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d edge = quad[(i + 1) % 4] - quad[i], to = p - quad[i];
    (edge.x() * to.y() - edge.y() * to.x() >= 0 ? left : right)++;
  }
  return left == 4 || right == 4;
}

void EraseQuad(const PixelQuad& quad, IndexImage& facets) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : quad) box.extend(corner);
  const int u0 = std::max(0, static_cast<int>(std::floor(box.min().x())));
  const int u1 = std::min(static_cast<int>(facets.cols()) - 1, static_cast<int>(std::ceil(box.max().x())));
  const int v0 = std::max(0, static_cast<int>(std::floor(box.min().y())));
  const int v1 = std::min(static_cast<int>(facets.rows()) - 1, static_cast<int>(std::ceil(box.max().y())));
  for (int v = v0; v <= v1; ++v) {
    for (int u = u0; u <= u1; ++u) {
      if (Inside(quad, {u, v})) facets(v, u) = -1;
    }
  }
}

bool SameFacetAround(const IndexImage& facets, int u, int v, int guard) {
  const int facet = facets(v, u);
  if (facet < 0) return false;
  const int rows = static_cast<int>(facets.rows()), cols = static_cast<int>(facets.cols());
  for (const auto& [du, dv] : {std::pair{-guard, 0},
                               {guard, 0},
                               {0, -guard},
                               {0, guard},
                               {-guard, -guard},
                               {guard, guard},
                               {-guard, guard},
                               {guard, -guard}}) {
    const int x = u + du, y = v + dv;
    if (x >= 0 && x < cols && y >= 0 && y < rows && facets(y, x) != facet) return false;
  }
  return true;
}

double SizeOf(const Element& element) { return std::max(element.edge_u.norm(), element.edge_v.norm()); }

}  // namespace

std::vector<PixelQuad> TagQuads(const std::vector<SurveyedTag>& survey, const Camera& camera,
                                const Eigen::Isometry3d& cam_from_world) {
  std::vector<PixelQuad> quads;
  for (SurveyedTag tag : survey) {
    tag.size_m *= kTagMargin;
    PixelQuad quad;
    bool in_front = true;
    const auto corners = TagCornersInWorld(tag);
    for (size_t i = 0; i < 4; ++i) {
      quad[i] = Project(camera, cam_from_world * corners[i]);
      in_front = in_front && quad[i].allFinite();
    }
    if (in_front) quads.push_back(quad);
  }
  return quads;
}

PixelDirections UnprojectAllPixels(const Camera& camera) {
  PixelDirections directions(3, static_cast<Eigen::Index>(camera.width_px) * camera.height_px);
  tbb::parallel_for(0, camera.height_px, [&](int v) {
    for (int u = 0; u < camera.width_px; ++u) {
      directions.col(static_cast<Eigen::Index>(v) * camera.width_px + u) =
          Unproject(camera, Eigen::Vector2d(u, v)).cast<float>();
    }
  });
  return directions;
}

PixelMap MapPixels(const Camera& camera, const PixelDirections& directions,
                   const Eigen::Isometry3d& cam_from_world, const Room& room,
                   const std::vector<PixelQuad>& masked, const PixelMapOptions& options) {
  const int width = camera.width_px, height = camera.height_px;
  IndexImage facets = IndexImage::Constant(height, width, -1), elements = facets;
  Eigen::ArrayXXf distance(height, width);
  const Eigen::Isometry3d world_from_cam = cam_from_world.inverse();
  const auto direction_of = [&](int u, int v) -> Eigen::Vector3d {
    return world_from_cam.linear() * directions.col(static_cast<Eigen::Index>(v) * width + u).cast<double>();
  };
  tbb::parallel_for(0, height, [&](int v) {
    for (int u = 0; u < width; ++u) {
      const Eigen::Vector3d direction = direction_of(u, v);
      if (!direction.allFinite()) continue;
      const RayHit hit = room.rays.Trace(world_from_cam.translation(), direction);
      if (hit.facet < 0 || !hit.front) continue;
      facets(v, u) = hit.facet;
      distance(v, u) = static_cast<float>(hit.distance);
      elements(v, u) = room.patches.ElementAt(hit.facet, hit.u, hit.v);
    }
  });
  for (const PixelQuad& quad : masked) EraseQuad(quad, facets);

  PixelMap map;
  map.element = IndexImage::Constant(height, width, -1);
  map.pixels_of_element.assign(room.patches.elements.size(), 0);
  std::vector<Eigen::Vector3d> centroid(room.patches.elements.size(), Eigen::Vector3d::Zero());
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      if (elements(v, u) < 0 || !SameFacetAround(facets, u, v, options.guard_px)) continue;
      const size_t e = static_cast<size_t>(elements(v, u));
      map.element(v, u) = elements(v, u);
      ++map.pixels_of_element[e];
      centroid[e] += world_from_cam.translation() + distance(v, u) * direction_of(u, v);
    }
  }
  for (size_t e = 0; e < centroid.size(); ++e) {
    int& pixels = map.pixels_of_element[e];
    const Element& element = room.patches.elements[e];
    const bool central = pixels > 0 && (centroid[e] / pixels - element.center).norm() <
                                           options.centroid_tolerance * SizeOf(element);
    if (pixels < options.min_pixels || !central) pixels = 0;
  }
  map.element = map.element.unaryExpr(
      [&](int e) { return e >= 0 && map.pixels_of_element[static_cast<size_t>(e)] > 0 ? e : -1; });
  return map;
}

std::vector<Observation> ObservePhoto(const PixelMap& map, const LuminanceImage& photo, int view, int state) {
  struct Sums {
    int count = 0;
    double sum = 0, squares = 0, noise = 0;
    Eigen::Vector3d rgb = Eigen::Vector3d::Zero();
  };
  std::vector<Sums> sums(map.pixels_of_element.size());
  for (Eigen::Index v = 0; v < map.element.rows(); ++v) {
    for (Eigen::Index u = 0; u < map.element.cols(); ++u) {
      const int e = map.element(v, u);
      if (e < 0 || !photo.valid(v, u)) continue;
      const double y = photo.relative_luminance(v, u);
      Sums& s = sums[static_cast<size_t>(e)];
      ++s.count;
      s.sum += y;
      s.squares += y * y;
      if (photo.variance.size() > 0) s.noise += photo.variance(v, u);
      s.rgb += Eigen::Vector3d(photo.relative_rgb[0](v, u), photo.relative_rgb[1](v, u),
                               photo.relative_rgb[2](v, u));
    }
  }
  constexpr double kMinValidShare = 0.9;
  std::vector<Observation> observations;
  for (size_t e = 0; e < sums.size(); ++e) {
    const Sums& s = sums[e];
    if (s.count < 2 || s.count < kMinValidShare * map.pixels_of_element[e]) continue;
    const double mean = s.sum / s.count;
    const double spread = std::max(0.0, s.squares / s.count - mean * mean) * s.count / (s.count - 1);
    if (!(mean > 0)) continue;
    // A few pixels may agree by chance better than their noise allows, so the noise is a lower limit.
    const double variance = std::max(spread, s.noise / s.count) / s.count;
    observations.push_back({static_cast<int>(e), view, state, s.count, mean, variance, s.rgb / s.count, 0});
  }
  return observations;
}

std::vector<Observation> ThinElements(const std::vector<Observation>& observations, int max_elements) {
  std::set<int> observed, kept;
  for (const Observation& o : observations) observed.insert(o.element);
  const int stride = std::max(1, static_cast<int>(observed.size()) / std::max(1, max_elements));
  int counter = 0;
  for (const int e : observed) {
    if (counter++ % stride == 0) kept.insert(e);
  }
  std::vector<Observation> thin;
  for (const Observation& o : observations) {
    if (kept.count(o.element) > 0) thin.push_back(o);
  }
  return thin;
}

}  // namespace luxfit
