#include "forward/direct/internal/shadowed_light.h"

#include <Eigen/Geometry>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "forward/direct/internal/cell_sum.h"
#include "forward/direct/internal/luminous_surface.h"

namespace luxfit {
namespace {

// Holds the visible shares of the cells of a grid over the surface, refined where the corners disagree.
class VisibleCells {
 public:
  struct Cell {
    Eigen::Vector2d at;    // centre, on the unit square
    double weight, share;  // part of the surface, part of it that is seen
  };

  VisibleCells(const RayScene& rays, const LuminousSurface& surface, const Eigen::Vector3d& start,
               const ShadowOptions& options)
      : rays_(rays), surface_(surface), start_(start), finest_(options.grid << options.refinements) {
    const int size = 1 << options.refinements;
    for (int i = 0; i < options.grid; ++i) {
      for (int j = 0; j < options.grid; ++j) Add(i * size, j * size, size);
    }
  }
  const std::vector<Cell>& cells() const { return cells_; }

 private:
  // Adds the cell with its lower corner at (i, j), `size` finest cells wide.
  void Add(int i, int j, int size) {
    const int seen = Sees(i, j) + Sees(i + size, j) + Sees(i, j + size) + Sees(i + size, j + size);
    const bool agree = seen == 0 || seen == 4;
    if (!agree && size > 1) {
      const int half = size / 2;
      for (const int a : {i, i + half}) {
        for (const int b : {j, j + half}) Add(a, b, half);
      }
      return;
    }
    const double n = finest_, width = size / n;
    cells_.push_back({{(i + 0.5 * size) / n, (j + 0.5 * size) / n}, width * width, 0.25 * seen});
  }
  int Sees(int i, int j) {
    const int key = i * (finest_ + 1) + j;
    const auto known = seen_.find(key);
    if (known != seen_.end()) return known->second;
    // Rays avoid the very rim, which may touch what the luminaire hangs on.
    const auto inside = [&](int k) { return 1e-6 + (1 - 2e-6) * k / finest_; };
    return seen_[key] = rays_.Occluded(start_, surface_.PointAt({inside(i), inside(j)})) ? 0 : 1;
  }

  const RayScene& rays_;
  const LuminousSurface& surface_;
  Eigen::Vector3d start_;
  int finest_;
  std::unordered_map<int, int> seen_;
  std::vector<Cell> cells_;
};

// Holds the integrand at one point of the surface: E per lm of the whole surface if all of it were here.
struct Sample {
  Eigen::Vector3d direction;   // from the luminaire to the receiver
  double r = 0, geometry = 0;  // m, cos(theta) / r^2
  DirectedIntensity intensity;
};
Sample SampleAt(const LuminousSurface& surface, const Eigen::Vector3d& point, const Eigen::Vector3d& p,
                const Eigen::Vector3d& normal) {
  Sample sample;
  const Eigen::Vector3d to_lamp = point - p;
  const double height = normal.dot(to_lamp);
  sample.r = to_lamp.norm();
  if (height <= 0 || sample.r < 1e-6) return sample;
  sample.direction = -to_lamp / sample.r;
  sample.geometry = height / (sample.r * sample.r * sample.r);
  sample.intensity = surface.IntensityTowards(sample.direction);
  return sample;
}

double ShareOf(const VisibleCells& visible, const LuminousSurface& surface, const Eigen::Vector3d& p,
               const Eigen::Vector3d& normal) {
  double seen = 0, all = 0;
  for (const VisibleCells::Cell& cell : visible.cells()) {
    const Sample sample = SampleAt(surface, surface.PointAt(cell.at), p, normal);
    const double light = cell.weight * sample.intensity.cd_per_lm * sample.geometry;
    all += light;
    seen += cell.share * light;
  }
  return all == 0 ? 0 : seen / all;
}

// Adds the change of the luminance of fixed directions, over the visible part of the surface.
void AddLobeDerivatives(const VisibleCells& visible, const LuminousSurface& surface, const Eigen::Vector3d& p,
                        const Eigen::Vector3d& normal, DirectIlluminance& sum) {
  const Eigen::Vector3d& aim = surface.luminaire().aim;
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();  // dE per rad about each axis of world
  for (const VisibleCells::Cell& cell : visible.cells()) {
    if (cell.share == 0) continue;
    const Sample sample = SampleAt(surface, surface.PointAt(cell.at), p, normal);
    const double weight = cell.weight * cell.share * sample.geometry;
    if (weight == 0) continue;
    sum.d_exponent += weight * sample.intensity.d_exponent;
    const double cosine = aim.dot(sample.direction);
    turn += weight * sample.intensity.d_direction.cross(sample.direction);
    if (std::abs(cosine) > 1e-6)
      turn -= weight * sample.intensity.cd_per_lm / cosine * aim.cross(sample.direction);
  }
  sum.d_tilt += Eigen::Vector2d(turn.dot(surface.axes().across), -turn.dot(surface.axes().along));
  sum.d_heading += turn.dot(aim);
}

// Holds the visible shares of the pieces of an outline. Where a piece's ends disagree, the edge of the shadow
// between them is found by halving.
class VisibleOutline {
 public:
  VisibleOutline(const RayScene& rays, const LuminousSurface& surface, const Eigen::Vector3d& start,
                 const std::vector<Eigen::Vector2d>& outline)
      : rays_(rays), surface_(surface), start_(start) {
    std::vector<bool> seen;
    seen.reserve(outline.size());
    shares_.reserve(outline.size());
    for (const Eigen::Vector2d& place : outline) seen.push_back(Sees(place));
    for (size_t k = 0; k < outline.size(); ++k) {
      const size_t next = (k + 1) % outline.size();
      shares_.push_back(seen[k] == seen[next] ? (seen[k] ? 1 : 0)
                                              : ShareBetween(outline[k], outline[next], seen[k]));
    }
  }
  double share(size_t piece) const { return shares_[piece]; }

 private:
  bool Sees(const Eigen::Vector2d& place) const {
    // A little inside: the rim may touch what the luminaire hangs on.
    return !rays_.Occluded(start_, surface_.luminaire().position + (1 - 1e-6) * surface_.OffsetOf(place));
  }
  double ShareBetween(const Eigen::Vector2d& from, const Eigen::Vector2d& to, bool seen_at_from) const {
    constexpr int kHalvings = 8;
    double low = 0, high = 1;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (low + high);
      (Sees(from + middle * (to - from)) == seen_at_from ? low : high) = middle;
    }
    return seen_at_from ? low : 1 - low;
  }

  const RayScene& rays_;
  const LuminousSurface& surface_;
  Eigen::Vector3d start_;
  std::vector<double> shares_;
};

// Adds the light that the visible part of the outline sweeps.
void AddOutlineDerivatives(const RayScene& rays, const LuminousSurface& surface, const Eigen::Vector3d& p,
                           const Eigen::Vector3d& normal, int pieces, DirectIlluminance& sum) {
  const Eigen::Vector3d& aim = surface.luminaire().aim;
  const std::vector<Eigen::Vector2d> outline = surface.Outline(pieces);
  const VisibleOutline visible(rays, surface, LiftedOff(p, normal), outline);
  for (size_t k = 0; k < outline.size(); ++k) {
    const Eigen::Vector2d &from = outline[k], &to = outline[(k + 1) % outline.size()];
    const Eigen::Vector2d place = 0.5 * (from + to);
    const Sample sample = SampleAt(surface, surface.PointOf(place), p, normal);
    const double cosine = aim.dot(sample.direction);
    if (visible.share(k) == 0 || sample.geometry == 0 || std::abs(cosine) < 1e-6) continue;
    // Counter-clockwise about the aim is clockwise for the receiver in front of it: d, from the luminaire,
    // has both signs right.
    const double luminance =
        visible.share(k) * sample.intensity.cd_per_lm / (surface.area_m2() * std::abs(cosine));
    const Eigen::Vector3d step = surface.OffsetOf(to - from);
    const Eigen::Vector3d swept =
        (cosine > 0 ? 1 : -1) * luminance * sample.geometry * step.cross(sample.direction);  // . velocity
    surface.AddMotion(place, swept, sum);
  }
}

}  // namespace

double VisibleShare(const RayScene& rays, const Luminaire& luminaire, const Eigen::Vector3d& p_in_world,
                    const Eigen::Vector3d& normal, const ShadowOptions& options) {
  const Eigen::Vector3d start = LiftedOff(p_in_world, normal);
  const double height = normal.dot(luminaire.position - p_in_world);
  if (std::isnan(height)) return height;
  const LuminousSurface surface(luminaire);
  if (!surface.has_extent()) return height > 0 && !rays.Occluded(start, luminaire.position) ? 1 : 0;
  const double share = ShareOf(VisibleCells(rays, surface, start, options), surface, p_in_world, normal);
  // For a surface seen whole or not at all it does not matter where the light comes from.
  if (!HasUnevenEmission(luminaire) || share == 0 || share == 1) return share;
  const double unoccluded = DirectIlluminancePerLumen(luminaire, p_in_world, normal).lx_per_lm;
  return VisibleIlluminancePerLumen(rays, luminaire, p_in_world, normal, options) / unoccluded;
}

double VisibleIlluminancePerLumen(const RayScene& rays, const Luminaire& luminaire,
                                  const Eigen::Vector3d& p_in_world, const Eigen::Vector3d& normal,
                                  const ShadowOptions& options) {
  if (HasUnevenEmission(luminaire)) {
    return SumOverCells(luminaire,
                        [&](const Luminaire& cell) {
                          DirectIlluminance light;
                          light.lx_per_lm =
                              VisibleIlluminancePerLumen(rays, cell, p_in_world, normal, options);
                          return light;
                        })
        .lx_per_lm;
  }
  const double unoccluded = DirectIlluminancePerLumen(luminaire, p_in_world, normal).lx_per_lm;
  if (unoccluded == 0 || std::isnan(unoccluded)) return unoccluded;
  return unoccluded * VisibleShare(rays, luminaire, p_in_world, normal, options);
}

DirectIlluminance ShadowedIlluminancePerLumen(const RayScene& rays, const Luminaire& luminaire,
                                              const Eigen::Vector3d& p_in_world,
                                              const Eigen::Vector3d& normal, const ShadowOptions& options) {
  if (HasUnevenEmission(luminaire)) {
    return SumOverCells(luminaire, [&](const Luminaire& cell) {
      return ShadowedIlluminancePerLumen(rays, cell, p_in_world, normal, options);
    });
  }
  DirectIlluminance whole = DirectIlluminancePerLumen(luminaire, p_in_world, normal);
  if (whole.lx_per_lm == 0 || std::isnan(whole.lx_per_lm)) return whole;
  DirectIlluminance sum;
  const LuminousSurface surface(luminaire);
  if (!surface.has_extent()) {
    sum.AddScaled(VisibleShare(rays, luminaire, p_in_world, normal), whole);
    return sum;
  }
  const VisibleCells visible(rays, surface, LiftedOff(p_in_world, normal), options);
  const double share = ShareOf(visible, surface, p_in_world, normal);
  if (share == 0 || share == 1) {
    sum.AddScaled(share, whole);
    return sum;
  }
  sum.lx_per_lm = share * whole.lx_per_lm;
  AddLobeDerivatives(visible, surface, p_in_world, normal, sum);
  AddOutlineDerivatives(rays, surface, p_in_world, normal, options.outline_pieces, sum);
  // The flux is spread over the area.
  if (surface.is_disc()) {
    sum.d_size[0] -= 2 * sum.lx_per_lm / surface.sides()[0];
  } else {
    sum.d_size -= sum.lx_per_lm * surface.sides().cwiseInverse();
  }
  return sum;
}

}  // namespace luxfit
