#include "forward/shadowed_light.h"

#include <Eigen/Geometry>
#include <cmath>
#include <unordered_map>
#include <vector>

namespace luxfit {
namespace {

constexpr double kPi = 3.14159265358979323846;

// A luminous surface over the unit square (s, t), of even density: place in units of its sides, point in
// world.
class Surface {
 public:
  explicit Surface(const Luminaire& luminaire) : luminaire_(luminaire), axes_(AxesOf(luminaire)) {
    is_disc_ = luminaire.shape == LuminaireShape::kDisc;
    sides_ = is_disc_ ? Eigen::Vector2d::Constant(luminaire.size_m[0]) : luminaire.size_m;
    area_m2_ = is_disc_ ? kPi / 4 * sides_[0] * sides_[0] : sides_.prod();
  }
  Eigen::Vector2d PlaceAt(double s, double t) const {
    if (!is_disc_) return {s - 0.5, t - 0.5};
    const double radius = 0.5 * std::sqrt(s);
    return {radius * std::cos(2 * kPi * t), radius * std::sin(2 * kPi * t)};
  }
  Eigen::Vector3d OffsetOf(const Eigen::Vector2d& place) const {
    return place[0] * sides_[0] * axes_.along + place[1] * sides_[1] * axes_.across;
  }
  Eigen::Vector3d PointAt(double s, double t) const { return luminaire_.position + OffsetOf(PlaceAt(s, t)); }
  // Corners of the outline as a polygon, in units of the sides, counter-clockwise about the aim.
  std::vector<Eigen::Vector2d> Outline(int pieces_a_side) const {
    std::vector<Eigen::Vector2d> outline;
    const int n = pieces_a_side;
    for (int k = 0; is_disc_ && k < 8 * n; ++k)
      outline.emplace_back(0.5 * std::cos(2 * kPi * k / (8 * n)), 0.5 * std::sin(2 * kPi * k / (8 * n)));
    const Eigen::Vector2d corners[5] = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}, {-0.5, -0.5}};
    for (int side = 0; !is_disc_ && side < 4; ++side) {
      for (int k = 0; k < n; ++k)
        outline.push_back(corners[side] + static_cast<double>(k) / n * (corners[side + 1] - corners[side]));
    }
    return outline;
  }

  const Luminaire& luminaire() const { return luminaire_; }
  const LuminaireAxes& axes() const { return axes_; }
  const Eigen::Vector2d& sides() const { return sides_; }
  double area_m2() const { return area_m2_; }
  bool is_disc() const { return is_disc_; }

 private:
  const Luminaire& luminaire_;
  LuminaireAxes axes_;
  Eigen::Vector2d sides_;
  double area_m2_;
  bool is_disc_;
};

// Visible shares of the cells of a grid over the surface, refined where the corners disagree.
class VisibleCells {
 public:
  struct Cell {
    double s, t, weight, share;  // centre, part of the surface, part of it that is seen
  };

  VisibleCells(const RayScene& rays, const Surface& surface, const Eigen::Vector3d& start,
               const ShadowOptions& options)
      : rays_(rays), surface_(surface), start_(start), finest_(options.grid << options.refinements) {
    const int size = 1 << options.refinements;
    for (int i = 0; i < options.grid; ++i) {
      for (int j = 0; j < options.grid; ++j) Add(i * size, j * size, size);
    }
  }
  const std::vector<Cell>& cells() const { return cells_; }

 private:
  // Cell with its lower corner at (i, j), `size` finest cells wide.
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
    cells_.push_back({(i + 0.5 * size) / n, (j + 0.5 * size) / n, width * width, 0.25 * seen});
  }
  int Sees(int i, int j) {
    const int key = i * (finest_ + 1) + j;
    const auto known = seen_.find(key);
    if (known != seen_.end()) return known->second;
    // Never at the very rim, which may touch what the luminaire hangs on.
    const auto inside = [&](int k) { return 1e-6 + (1 - 2e-6) * k / finest_; };
    return seen_[key] = rays_.Occluded(start_, surface_.PointAt(inside(i), inside(j))) ? 0 : 1;
  }

  const RayScene& rays_;
  const Surface& surface_;
  Eigen::Vector3d start_;
  int finest_;
  std::unordered_map<int, int> seen_;
  std::vector<Cell> cells_;
};

bool HasExtent(const Luminaire& luminaire) {
  return luminaire.shape == LuminaireShape::kRectangle || luminaire.shape == LuminaireShape::kDisc;
}

// The integrand at one point of the surface: E per lm of the whole surface if all of it were here.
struct Sample {
  Eigen::Vector3d direction;   // from the luminaire to the receiver
  double r = 0, geometry = 0;  // m, cos(theta) / r^2
  DirectedIntensity intensity;
};
Sample SampleAt(const Surface& surface, const Eigen::Vector3d& point, const Eigen::Vector3d& p,
                const Eigen::Vector3d& normal) {
  Sample sample;
  const Eigen::Vector3d to_lamp = point - p;
  const double height = normal.dot(to_lamp);
  sample.r = to_lamp.norm();
  if (height <= 0 || sample.r < 1e-6) return sample;
  sample.direction = -to_lamp / sample.r;
  sample.geometry = height / (sample.r * sample.r * sample.r);
  sample.intensity = IntensityPerLumen(surface.luminaire(), surface.axes(), sample.direction);
  return sample;
}

double ShareOf(const VisibleCells& visible, const Surface& surface, const Eigen::Vector3d& p,
               const Eigen::Vector3d& normal) {
  double seen = 0, all = 0;
  for (const VisibleCells::Cell& cell : visible.cells()) {
    const Sample sample = SampleAt(surface, surface.PointAt(cell.s, cell.t), p, normal);
    const double light = cell.weight * sample.intensity.cd_per_lm * sample.geometry;
    all += light;
    seen += cell.share * light;
  }
  return all > 0 ? seen / all : 0;
}

// What the luminance of fixed directions changes, over the visible part of the surface.
void AddLobeDerivatives(const VisibleCells& visible, const Surface& surface, const Eigen::Vector3d& p,
                        const Eigen::Vector3d& normal, DirectIlluminance& sum) {
  const Eigen::Vector3d& aim = surface.luminaire().aim;
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();  // dE per rad about each axis of world
  for (const VisibleCells::Cell& cell : visible.cells()) {
    if (cell.share == 0) continue;
    const Sample sample = SampleAt(surface, surface.PointAt(cell.s, cell.t), p, normal);
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

// Visible shares of the pieces of an outline: where a piece's ends disagree, the edge of the shadow between
// them is found by halving.
class VisibleOutline {
 public:
  VisibleOutline(const RayScene& rays, const Surface& surface, const Eigen::Vector3d& start,
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
  const Surface& surface_;
  Eigen::Vector3d start_;
  std::vector<double> shares_;
};

// What the visible part of the outline sweeps.
void AddOutlineDerivatives(const RayScene& rays, const Surface& surface, const Eigen::Vector3d& p,
                           const Eigen::Vector3d& normal, int pieces, DirectIlluminance& sum) {
  const LuminaireAxes& axes = surface.axes();
  const Eigen::Vector3d& aim = surface.luminaire().aim;
  const std::vector<Eigen::Vector2d> outline = surface.Outline(pieces);
  const VisibleOutline visible(rays, surface, LiftedOff(p, normal), outline);
  for (size_t k = 0; k < outline.size(); ++k) {
    const Eigen::Vector2d &from = outline[k], &to = outline[(k + 1) % outline.size()];
    const Eigen::Vector2d place = 0.5 * (from + to);
    const Eigen::Vector3d offset = surface.OffsetOf(place), point = surface.luminaire().position + offset;
    const Sample sample = SampleAt(surface, point, p, normal);
    const double cosine = aim.dot(sample.direction);
    if (visible.share(k) == 0 || sample.geometry == 0 || std::abs(cosine) < 1e-6) continue;
    // Counter-clockwise about the aim is clockwise for the receiver in front of it: d, from the luminaire,
    // has both signs right.
    const double luminance =
        visible.share(k) * sample.intensity.cd_per_lm / (surface.area_m2() * std::abs(cosine));
    const Eigen::Vector3d step = surface.OffsetOf(to - from);
    const Eigen::Vector3d swept =
        (cosine > 0 ? 1 : -1) * luminance * sample.geometry * step.cross(sample.direction);  // . velocity
    sum.d_position += swept;
    const Eigen::Vector2d along(place[0] * swept.dot(axes.along), place[1] * swept.dot(axes.across));
    sum.d_size += surface.is_disc() ? Eigen::Vector2d(along.sum(), 0) : along;
    sum.d_tilt += Eigen::Vector2d(swept.dot(axes.across.cross(offset)), -swept.dot(axes.along.cross(offset)));
    sum.d_heading += swept.dot(aim.cross(offset));
  }
}

}  // namespace

double VisibleShare(const RayScene& rays, const Luminaire& luminaire, const Eigen::Vector3d& p_in_world,
                    const Eigen::Vector3d& normal, const ShadowOptions& options) {
  const Eigen::Vector3d start = LiftedOff(p_in_world, normal);
  if (!HasExtent(luminaire))
    return normal.dot(luminaire.position - p_in_world) > 0 && !rays.Occluded(start, luminaire.position) ? 1
                                                                                                        : 0;
  const Surface surface(luminaire);
  return ShareOf(VisibleCells(rays, surface, start, options), surface, p_in_world, normal);
}

double VisibleIlluminancePerLumen(const RayScene& rays, const Luminaire& luminaire,
                                  const Eigen::Vector3d& p_in_world, const Eigen::Vector3d& normal,
                                  const ShadowOptions& options) {
  const double unoccluded = DirectIlluminancePerLumen(luminaire, p_in_world, normal).lx_per_lm;
  return unoccluded == 0 ? 0 : unoccluded * VisibleShare(rays, luminaire, p_in_world, normal, options);
}

DirectIlluminance ShadowedIlluminancePerLumen(const RayScene& rays, const Luminaire& luminaire,
                                              const Eigen::Vector3d& p_in_world,
                                              const Eigen::Vector3d& normal, const ShadowOptions& options) {
  const DirectIlluminance whole = DirectIlluminancePerLumen(luminaire, p_in_world, normal);
  DirectIlluminance sum;
  if (!HasExtent(luminaire)) {
    sum.AddScaled(VisibleShare(rays, luminaire, p_in_world, normal), whole);
    return sum;
  }
  const Surface surface(luminaire);
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
