// Traces rays through the scene: what a ray meets, and whether two points see each other.
//
// Directions need not be normalised; distances are in units of their length. Both sides of a facet block
// light. The caller lifts a point on a surface off it (LiftedOff), so that the point does not see its own
// facet. Never aim a ray exactly at a vertex or an edge: a ray tracer may let it through there.
//
// RayScene throws std::invalid_argument for a scene that is not valid, and std::runtime_error where Embree
// finds no device.
// Source: Wald et al. (2014), "Embree: a kernel framework for efficient CPU ray tracing"; its robust mode
// (Woop et al. 2013).
#ifndef LUXFIT_FORWARD_ROOM_VISIBILITY_H_
#define LUXFIT_FORWARD_ROOM_VISIBILITY_H_

#include <Eigen/Core>
#include <memory>

#include "forward/room/scene.h"

namespace luxfit {

struct RayHit {
  int facet = -1;  // -1: nothing was hit
  double distance = 0;
  double u = 0, v = 0;  // place on the facet, Facet::PointAt
  bool front = false;   // the ray met the reflecting side
};

// Holds up to eight rays, which a ray tracer follows at once.
struct RayPacket {
  static constexpr int kSize = 8;
  alignas(32) float origin[3][kSize];
  alignas(32) float direction[3][kSize];
  int count = 0;

  void Add(const Eigen::Vector3f& from, const Eigen::Vector3f& towards) {
    for (int axis = 0; axis < 3; ++axis) {
      origin[axis][count] = from[axis];
      direction[axis][count] = towards[axis];
    }
    ++count;
  }
};

struct PacketHits {
  int facet[RayPacket::kSize];  // -1: nothing was hit
  float u[RayPacket::kSize], v[RayPacket::kSize];
  bool front[RayPacket::kSize];
};

// Returns a point 10 um off a surface along its normal: far below any detail of a room, far above the
// rounding of floats in it.
inline Eigen::Vector3d LiftedOff(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) {
  return p + 1e-5 * normal;
}

class RayScene {
 public:
  explicit RayScene(const Scene& scene);

  RayHit Trace(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;
  // Tells whether anything lies between the two points (the last 10 um before `to` do not count).
  bool Occluded(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  PacketHits Trace(const RayPacket& packet) const;
  // Returns bit k set where something lies on ray k from its origin to origin + direction (less 10 um).
  unsigned Occluded(const RayPacket& packet) const;

 private:
  struct State;
  std::shared_ptr<const State> state_;  // copies share it
};

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_VISIBILITY_H_
