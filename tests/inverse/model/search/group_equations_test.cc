#include "inverse/model/internal/search/group_equations.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "tests/support/closed_forms.h"

namespace luxfit {
namespace {

constexpr double kStrength = 3;  // g
const Eigen::Vector3d kDownlight(0, 0, 2.5);

// A floor of 5 m x 5 m and a wall of as much, of two materials, below a Lambertian luminaire. Indirect light is even. Of the floor's
// places, those for which `is_dark` holds reflect a fifth of what the others do.
template <typename IsDark>
GroupedLight FloorAndWall(const std::array<double, 2>& albedo, const IsDark& is_dark) {
  constexpr int kSide = 15;
  constexpr double kIndirect = 0.05, kStep = 5.0 / kSide;
  GroupedLight light;
  light.value.resize(2 * kSide * kSide, 1);
  light.indirect = Eigen::MatrixXd::Constant(2 * kSide * kSide, 1, kIndirect);
  for (const int material : {0, 1}) {
    for (int i = 0; i < kSide * kSide; ++i) {
      const double a = kStep * (i % kSide + 0.5) - 2.5, b = kStep * (i / kSide + 0.5) - 2.5;
      const bool is_floor = material == 0;
      const Eigen::Vector3d p = is_floor ? Eigen::Vector3d(a, b, 0) : Eigen::Vector3d(a, 2.5, b);
      const Eigen::Vector3d normal(0, is_floor ? 0 : -1, is_floor ? 1 : 0);
      const Eigen::Vector3d to = kDownlight - p, along = to.normalized();
      const double lx_per_lm =
          std::max(0.0, along.z()) / support::kPi * std::max(0.0, along.dot(normal)) / to.squaredNorm();
      const double rho = albedo[static_cast<size_t>(material)] * (is_floor && is_dark(i) ? 0.2 : 1);
      light.value(static_cast<Eigen::Index>(light.places.size()), 0) =
          rho * (kIndirect + kStrength * lx_per_lm);
      light.places.push_back({p, normal, {}});
      light.material.push_back(material);
    }
  }
  return light;
}

LitPlace LitByLamp(const GroupedLight& light) {
  LitPlace place;
  const auto n = static_cast<Eigen::Index>(light.places.size());
  place.lx_per_cd.resize(n);
  place.rays.resize(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Sensor& sensor = light.places[static_cast<size_t>(i)];
    const Eigen::Vector3d from = sensor.position - kDownlight;
    place.rays.row(i) = from.normalized().transpose().cast<float>();
    place.lx_per_cd[i] =
        static_cast<float>(std::max(0.0, -from.normalized().dot(sensor.normal)) / from.squaredNorm());
  }
  return place;
}

struct Found {
  double strength, floor, wall;  // g, albedos
};

Found SolveReweighed(const GroupedLight& light) {
  GroupEquations equations(light, 0);
  const LitPlace lamp = LitByLamp(light);
  const auto column = [&] {
    return Eigen::MatrixXd(LobeColumns(equations.Weighted(lamp), {Lobe{}}).cast<double>());
  };
  equations.Reweigh(column());
  const GroupEquations::Solution solution = equations.Solve(column()).solution;
  return {solution.strength[0], 1 / solution.other[0], 1 / solution.other[1]};
}

TEST(GroupEquations, SeparateDirectLightFromReflectance) {
  const Found found = SolveReweighed(FloorAndWall({0.3, 0.7}, [](int) { return false; }));
  EXPECT_NEAR(found.strength, kStrength, 1e-3 * kStrength);
  EXPECT_NEAR(found.floor, 0.3, 1e-3);
  EXPECT_NEAR(found.wall, 0.7, 1e-3);
}

// Furniture that the mesh lacks. Weighted by what is measured alone, dark places would say that there is hardly any light.
TEST(GroupEquations, LetDarkThingsOnAThirdOfTheFloorLoseTheirSay) {
  const Found found = SolveReweighed(FloorAndWall({0.3, 0.7}, [](int i) { return i % 3 == 0; }));
  EXPECT_NEAR(found.strength, kStrength, 0.05 * kStrength);
  EXPECT_NEAR(found.floor, 0.3, 0.02);
  EXPECT_NEAR(found.wall, 0.7, 0.02);
}

// A wall shows twice the light that it can reflect: something that the mesh lacks stands there.
TEST(GroupEquations, KnowThatNoSurfaceReflectsMoreThanItGets) {
  GroupedLight light = FloorAndWall({0.3, 0.7}, [](int) { return false; });
  for (size_t i = 0; i < light.places.size(); ++i)
    if (light.material[i] == 1) light.value(static_cast<Eigen::Index>(i), 0) *= 2;
  const Found found = SolveReweighed(light);
  EXPECT_LE(found.wall, 0.95 + 1e-12);
}

}  // namespace
}  // namespace luxfit
