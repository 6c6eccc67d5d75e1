#include "forward/room/internal/sampling.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace luxfit {

uint64_t Mix(uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

double Fraction(double x) { return x - std::floor(x); }

Eigen::Vector2d PlasticPoint(double index, const Eigen::Vector2d& start) {
  const Eigen::Vector2d x = start + index * Eigen::Vector2d(0.75487766624669276, 0.56984029099805327);
  return x.array() - x.array().floor();
}

Eigen::Vector3d LiftedFromDisc(double radius2, double turns) {
  const double radius = std::sqrt(radius2), angle = 2 * M_PI * turns;
  // The direction is never quite level: a ray in the receiver's own plane meets nothing of use.
  return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(std::max(1e-12, 1 - radius2))};
}

Eigen::Matrix3d FrameOf(const Eigen::Vector3d& normal) {
  Eigen::Matrix3d frame;
  frame.col(0) = normal.unitOrthogonal();
  frame.col(1) = normal.cross(frame.col(0));
  frame.col(2) = normal;
  return frame;
}

std::vector<Eigen::Vector2d> Isocell(int count) {
  constexpr int kFirstRing = 3;
  constexpr double kGolden = 0.61803398874989485;
  const int rings =
      std::max(1, static_cast<int>(std::lround(std::sqrt(count / static_cast<double>(kFirstRing)))));
  std::vector<Eigen::Vector2d> cells;
  for (int i = 1; i <= rings; ++i) {
    const int in_ring = kFirstRing * (2 * i - 1);
    const double inner = i - 1, outer = i;
    const double share = (inner * inner + outer * outer) / (2.0 * rings * rings);
    // Rings are turned against one another, so that no spoke of rays runs along an edge of the room.
    const double turn = Fraction(i * kGolden);
    for (int k = 0; k < in_ring; ++k) cells.emplace_back(share, (k + turn) / in_ring);
  }
  return cells;
}

}  // namespace luxfit
