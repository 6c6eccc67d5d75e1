#include "inverse/model/internal/search/lobes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "forward/luminaire/distribution_ops.h"
#include "inverse/model/light_state.h"

namespace luxfit {
namespace {

std::vector<Eigen::Vector3d> DividedIcosahedron() {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  std::vector<Eigen::Vector3d> vertices;
  vertices.reserve(12 + 30);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double short_side : {-1.0, 1.0}) {
      for (const double long_side : {-golden, golden}) {
        Eigen::Vector3d vertex = Eigen::Vector3d::Zero();
        vertex[(axis + 1) % 3] = short_side;
        vertex[(axis + 2) % 3] = long_side;
        vertices.push_back(vertex);
      }
    }
  }
  constexpr double kEdge = 2;
  for (size_t i = 0; i < 12; ++i) {
    for (size_t j = 0; j < i; ++j) {
      if ((vertices[i] - vertices[j]).norm() < 1.1 * kEdge) vertices.push_back(vertices[i] + vertices[j]);
    }
  }
  for (Eigen::Vector3d& vertex : vertices) vertex.normalize();
  return vertices;
}

}  // namespace

const std::vector<Lobe>& SimpleLobes() {
  using D = Distribution;
  static const std::vector<Lobe> lobes = {
      {D::kIsotropic, 1, {0, 0, -1}},   {D::kCosinePower, 1, {0, 0, -1}}, {D::kCosinePower, 3, {0, 0, -1}},
      {D::kCosinePower, 8, {0, 0, -1}}, {D::kCosinePower, 1, {0, 0, 1}},  {D::kCosinePower, 1, {1, 0, 0}},
      {D::kCosinePower, 1, {-1, 0, 0}}, {D::kCosinePower, 1, {0, 1, 0}},  {D::kCosinePower, 1, {0, -1, 0}}};
  return lobes;
}

const std::vector<Lobe>& LobesOfKnownPlaces() {
  static const std::vector<Lobe> lobes = [] {
    std::vector<Lobe> all = SimpleLobes();
    all.push_back({Distribution::kCosinePower, 1, {0, 0, -1}, 0.5});
    return all;
  }();
  return lobes;
}

const std::vector<Lobe>& LobesUnderCeiling() {
  static const std::vector<Lobe> lobes = [] {
    std::vector<Lobe> down;
    for (const Lobe& lobe : SimpleLobes())
      if (lobe.distribution == Distribution::kCosinePower && lobe.aim.z() < 0) down.push_back(lobe);
    down.push_back({Distribution::kCosinePower, 22, {0, 0, -1}});
    return down;
  }();
  return lobes;
}

const std::vector<Lobe>& LobesInMidAir() {
  static const std::vector<Lobe> lobes = [] {
    std::vector<Lobe> all = LobesUnderCeiling();
    all.push_back(SimpleLobes().front());
    for (const double up : {0.25, 0.5, 0.75}) all.push_back({Distribution::kCosinePower, 1, {0, 0, -1}, up});
    return all;
  }();
  return lobes;
}

const std::vector<Eigen::Vector3d>& AimsOverSphere() {
  static const std::vector<Eigen::Vector3d> aims = DividedIcosahedron();
  return aims;
}

double HalfPeakCosine(double exponent) { return std::pow(0.5, 1 / exponent); }

std::vector<Lobe> LobesNear(const Lobe& lobe, double turn_rad, double width_factor) {
  if (!OpsOf(lobe.distribution).has_aim) return {lobe};
  const Eigen::Vector3d u = lobe.aim.unitOrthogonal(), v = lobe.aim.cross(u);
  std::vector<Eigen::Vector3d> aims = {lobe.aim};
  constexpr int kAround = 6;
  for (int i = 0; i < kAround; ++i) {
    const double angle = 2 * M_PI * i / kAround;
    const Eigen::Vector3d side = std::cos(angle) * u + std::sin(angle) * v;
    aims.emplace_back((std::cos(turn_rad) * lobe.aim + std::sin(turn_rad) * side).normalized());
  }
  std::vector<Lobe> near;
  near.reserve(3 * aims.size());
  for (const double factor : {1.0, width_factor, 1 / width_factor}) {
    const double exponent = std::clamp(factor * lobe.exponent, 1.0, kGreatestCosinePower);
    for (const Eigen::Vector3d& aim : aims) near.push_back({lobe.distribution, exponent, aim});
  }
  return near;
}

}  // namespace luxfit
