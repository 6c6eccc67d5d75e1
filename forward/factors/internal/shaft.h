// Whether anything stands between two convex polygons, decided without sampling.
//
// The shaft is the convex hull of both. A facet that a plane separates from it cannot stand between; if none
// is left, every point of one polygon sees every point of the other. A convex facet that all segments between
// corners cross blocks the whole shaft: where the hull meets the facet's plane is the hull of those
// crossings.
//
// Source: Haines and Wallace (1991), "Shaft culling for efficient ray-traced radiosity"; Teller and Hanrahan
// (1993), "Global visibility algorithms for illumination computations" (visible, invisible, partly).
#ifndef LUXFIT_FORWARD_FACTORS_INTERNAL_SHAFT_H_
#define LUXFIT_FORWARD_FACTORS_INTERNAL_SHAFT_H_

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "forward/factors/internal/polygon_factor.h"

namespace luxfit {

enum class Sight : uint8_t {
  kNone,     // they face away from each other, or something hides them wholly
  kFree,     // nothing stands between
  kPartial,  // something may
};

// A facet as something that blocks light.
struct Blocker {
  ConvexPolygon polygon;
  Eigen::Vector3d normal;
  Eigen::AlignedBox3d box;
  int facet = 0;         // its index
  bool is_whole = true;  // it blocks all of its polygon
};
std::vector<Blocker> BlockersOf(const std::vector<Facet>& facets);

class Shaft {
 public:
  // The polygons with their unit normals.
  Shaft(const ConvexPolygon& a, const Eigen::Vector3d& normal_a, const ConvexPolygon& b,
        const Eigen::Vector3d& normal_b);

  // Whether neither sees the front of the other.
  bool FacesAway() const;
  // Whether a plane separates the blocker from the shaft: first the planes at hand, then those of the shaft's
  // sides, once made.
  bool ClearlyExcludes(const Blocker& blocker) const;
  void MakeSides();
  bool SidesExclude(const Blocker& blocker) const;
  bool IsBlockedBy(const Blocker& blocker) const;

 private:
  struct Plane {
    Eigen::Vector3d normal;  // into the shaft
    double offset;
  };
  void AddSides(const ConvexPolygon& base, const Eigen::Vector3d& normal, const ConvexPolygon& tip);

  const ConvexPolygon &a_, &b_;
  Eigen::Vector3d normal_a_, normal_b_;
  Eigen::AlignedBox3d box_;
  std::array<Plane, 16> sides_;
  int side_count_ = 0;
};

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_FACTORS_INTERNAL_SHAFT_H_
