// Describes a luminaire's luminous surface: its points, its outline, and how they move with the luminaire.
//
// A place on it is (a, b) in [-1/2, 1/2]^2, in units of the luminaire's sides along heading and across. Both
// sides of a disc are its diameter. A point and a sphere are their centre: their sides are 0.
#ifndef LUXFIT_FORWARD_DIRECT_INTERNAL_LUMINOUS_SURFACE_H_
#define LUXFIT_FORWARD_DIRECT_INTERNAL_LUMINOUS_SURFACE_H_

#include <Eigen/Core>
#include <vector>

#include "forward/direct/direct_light.h"
#include "forward/luminaire/distribution_ops.h"
#include "forward/luminaire/luminaire.h"

namespace luxfit {

// Refers to the luminaire, which must outlive it.
class LuminousSurface {
 public:
  explicit LuminousSurface(const Luminaire& luminaire);

  // Maps the unit square onto the surface with even density, for random or low-discrepancy sampling.
  Eigen::Vector2d PlaceAt(const Eigen::Vector2d& unit) const;
  // Returns the vector from the luminaire's position, m.
  Eigen::Vector3d OffsetOf(const Eigen::Vector2d& place) const {
    return place[0] * sides_[0] * axes_.along + place[1] * sides_[1] * axes_.across;
  }
  Eigen::Vector3d PointOf(const Eigen::Vector2d& place) const {
    return luminaire_->position + OffsetOf(place);
  }
  Eigen::Vector3d PointAt(const Eigen::Vector2d& unit) const { return PointOf(PlaceAt(unit)); }

  // Returns the corners of the outline as a polygon, counter-clockwise about the aim. A side of a rectangle,
  // or an eighth of a disc's rim, has `pieces_a_side` pieces.
  std::vector<Eigen::Vector2d> Outline(int pieces_a_side) const;

  // Adds an illuminance's derivatives with respect to the luminaire's position, turns and size. The
  // illuminance changes by gradient . dx as the point at a place moves by dx. The effect of a turn on the
  // lobe is left out.
  void AddMotion(const Eigen::Vector2d& place, const Eigen::Vector3d& gradient, DirectIlluminance& sum) const;

  const Luminaire& luminaire() const { return *luminaire_; }
  const LuminaireAxes& axes() const { return axes_; }
  const Eigen::Vector2d& sides() const { return sides_; }
  bool is_disc() const { return luminaire_->shape == LuminaireShape::kDisc; }
  // Looks the distribution up once a surface: sums over its points call this.
  DirectedIntensity IntensityTowards(const Eigen::Vector3d& direction) const {
    return towards_(*luminaire_, axes_, direction);
  }
  bool has_extent() const { return is_disc() || luminaire_->shape == LuminaireShape::kRectangle; }
  double area_m2() const;

 private:
  const Luminaire* luminaire_;
  decltype(DistributionOps::towards) towards_;
  LuminaireAxes axes_;
  Eigen::Vector2d sides_;
};

// Here, because sums over surfaces call it at every point.
inline void LuminousSurface::AddMotion(const Eigen::Vector2d& place, const Eigen::Vector3d& gradient,
                                       DirectIlluminance& sum) const {
  const double along = gradient.dot(axes_.along), across = gradient.dot(axes_.across);
  const double x = place[0] * sides_[0], y = place[1] * sides_[1];
  sum.d_position += gradient;
  // A turn about w moves the point by w x offset; tilts are about across and -along, the heading is about
  // aim.
  sum.d_tilt -= gradient.dot(luminaire_->aim) * Eigen::Vector2d(x, y);
  sum.d_heading += x * across - y * along;
  if (is_disc()) {
    sum.d_size[0] += place[0] * along + place[1] * across;
  } else {
    sum.d_size += Eigen::Vector2d(place[0] * along, place[1] * across);
  }
}

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_DIRECT_INTERNAL_LUMINOUS_SURFACE_H_
