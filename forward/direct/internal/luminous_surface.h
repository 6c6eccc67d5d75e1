// A luminaire's luminous surface: its points, its outline, and what moves them.
//
// A place on it is (a, b) in [-1/2, 1/2]^2, in units of the luminaire's sides along heading and across; a
// disc's sides are both its diameter, those of a point and of a sphere, which are their centre, are 0.
#ifndef LUXFIT_FORWARD_DIRECT_INTERNAL_LUMINOUS_SURFACE_H_
#define LUXFIT_FORWARD_DIRECT_INTERNAL_LUMINOUS_SURFACE_H_

#include <Eigen/Core>
#include <vector>

#include "forward/direct/direct_light.h"
#include "forward/luminaire/luminaire.h"

namespace luxfit {

// Refers to the luminaire, which must outlive it.
class LuminousSurface {
 public:
  explicit LuminousSurface(const Luminaire& luminaire);

  // The unit square mapped onto the surface with even density, for random or low-discrepancy sampling.
  Eigen::Vector2d PlaceAt(const Eigen::Vector2d& unit) const;
  // From the luminaire's position, m.
  Eigen::Vector3d OffsetOf(const Eigen::Vector2d& place) const {
    return place[0] * sides_[0] * axes_.along + place[1] * sides_[1] * axes_.across;
  }
  Eigen::Vector3d PointOf(const Eigen::Vector2d& place) const {
    return luminaire_->position + OffsetOf(place);
  }
  Eigen::Vector3d PointAt(const Eigen::Vector2d& unit) const { return PointOf(PlaceAt(unit)); }

  // Corners of the outline as a polygon, counter-clockwise about the aim: so many pieces a side of a
  // rectangle or an eighth of a disc's rim.
  std::vector<Eigen::Vector2d> Outline(int pieces_a_side) const;

  // Adds what an illuminance that changes by gradient . dx as the point at a place moves by dx, changes as
  // the luminaire moves, turns and grows. What turning does to the lobe is not in it.
  void AddMotion(const Eigen::Vector2d& place, const Eigen::Vector3d& gradient, DirectIlluminance& sum) const;

  const Luminaire& luminaire() const { return *luminaire_; }
  const LuminaireAxes& axes() const { return axes_; }
  const Eigen::Vector2d& sides() const { return sides_; }
  bool is_disc() const { return luminaire_->shape == LuminaireShape::kDisc; }
  bool has_extent() const { return is_disc() || luminaire_->shape == LuminaireShape::kRectangle; }
  double area_m2() const;

 private:
  const Luminaire* luminaire_;
  LuminaireAxes axes_;
  Eigen::Vector2d sides_;
};

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_DIRECT_INTERNAL_LUMINOUS_SURFACE_H_
