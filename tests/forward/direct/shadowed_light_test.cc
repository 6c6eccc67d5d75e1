#include "forward/direct/internal/shadowed_light.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <random>

#include "forward/factors/internal/polygon_factor.h"
#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using Eigen::Vector3d;

Luminaire PanelAt(const Vector3d& position) {
  Luminaire lamp;
  lamp.position = position;
  lamp.shape = LuminaireShape::kRectangle;
  lamp.size_m = {0.8, 0.5};
  return lamp;
}

// A screen at z = 1 with its edge at x = edge, seen from the origin: it hides what lies beyond x = edge z of
// a panel at height z.
Scene ScreenBeyond(double edge) {
  Scene scene;
  support::AddParallelogram(scene, {edge, -5, 1}, {5, 0, 0}, {0, 10, 0}, "screen");
  return scene;
}

// What is left of a Lambertian panel that faces down, in closed form.
double VisiblePanelLx(const Luminaire& lamp, double edge) {
  const Vector3d half = 0.5 * Vector3d(lamp.size_m[0], lamp.size_m[1], 0);
  const Vector3d low = lamp.position - half;
  const double right = std::min(lamp.position.x() + half.x(), edge * lamp.position.z());
  ConvexPolygon visible =
      MakePolygon(low, {0, lamp.size_m[1], 0}, {right - low.x(), 0, 0}, FacetKind::kParallelogram);
  return PointToPolygon({0, 0, 0}, {0, 0, 1}, visible) / lamp.size_m.prod();
}

TEST(ShadowedLight, IsTheClosedFormOfWhatIsLeft) {
  const RayScene rays(ScreenBeyond(0.05));
  for (const double x : {-0.3, -0.1, 0.0, 0.2}) {
    const Luminaire lamp = PanelAt({x, 0.1, 2.5});
    // The shadow's edge is found to a cell of 1 / 64 of the panel's length.
    EXPECT_NEAR(VisibleIlluminancePerLumen(rays, lamp, {0, 0, 0}, {0, 0, 1}), VisiblePanelLx(lamp, 0.05),
                VisiblePanelLx(lamp, 10) / 64)
        << x;
  }
}

TEST(ShadowedLight, DerivativesAreThoseOfTheClosedForm) {
  const RayScene rays(ScreenBeyond(0.05));
  const Luminaire lamp = PanelAt({0.05, 0.1, 2.5});
  constexpr double kStep = 1e-4;  // truncation 1e-8 of the value
  const DirectIlluminance light = ShadowedIlluminancePerLumen(rays, lamp, {0, 0, 0}, {0, 0, 1});
  const auto slope = [&](const std::function<void(Luminaire&, double)>& move) {
    Luminaire up = lamp, down = lamp;
    move(up, kStep);
    move(down, -kStep);
    return (VisiblePanelLx(up, 0.05) - VisiblePanelLx(down, 0.05)) / (2 * kStep);
  };
  // The share that is seen, and with it what the flux per area takes away, is right to 1 / 64 of the panel;
  // per metre of a side of half a metre.
  const double tolerance = VisiblePanelLx(lamp, 10) / 64 / 0.5;
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(light.d_position[axis], slope([&](Luminaire& l, double h) { l.position[axis] += h; }),
                tolerance)
        << axis;
  }
  for (int side = 0; side < 2; ++side) {
    EXPECT_NEAR(light.d_size[side], slope([&](Luminaire& l, double h) { l.size_m[side] += h; }), tolerance)
        << side;
  }
  // With visibility frozen the motion along x would be off: the screen hides more of the panel as it goes.
  const DirectIlluminance open = DirectIlluminancePerLumen(lamp, {0, 0, 0}, {0, 0, 1});
  const double frozen = light.lx_per_lm / open.lx_per_lm * open.d_position.x();
  EXPECT_GT(std::abs(frozen - light.d_position.x()), 5 * tolerance);
}

// Random occluders; the truth by many rays to fixed points of the surface, moved both ways.
class RandomShadows : public testing::Test {
 protected:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng_); }

  Scene Triangles() {
    Scene scene;
    for (int k = 0; k < 3; ++k) {
      const Vector3d origin(uniform(-0.5, 0.3), uniform(-0.5, 0.3), uniform(0.8, 1.4));
      support::AddTriangle(scene, origin, {uniform(0.2, 0.5), uniform(-0.2, 0.2), uniform(-0.1, 0.1)},
                           {uniform(-0.2, 0.2), uniform(0.2, 0.5), uniform(-0.1, 0.1)}, "leaf");
    }
    return scene;
  }

  static double ByManyRays(const RayScene& rays, const Luminaire& lamp) {
    constexpr int kSide = 800;
    const LuminaireAxes axes = AxesOf(lamp);
    double sum = 0;
    for (int i = 0; i < kSide; ++i) {
      for (int j = 0; j < kSide; ++j) {
        const Eigen::Vector2d place((i + 0.5) / kSide - 0.5, (j + 0.5) / kSide - 0.5);
        const Vector3d point =
            lamp.position + place[0] * lamp.size_m[0] * axes.along + place[1] * lamp.size_m[1] * axes.across;
        if (rays.Occluded({0, 0, 1e-5}, point)) continue;
        const double r = point.norm();
        sum += IntensityPerLumen(lamp, axes, -point / r).cd_per_lm * point.z() / (r * r * r);
      }
    }
    return sum / (kSide * kSide);
  }

  std::mt19937_64 rng_ = support::TestRng();
};

TEST_F(RandomShadows, DerivativesFollowTheirEdges) {
  ShadowOptions fine;
  fine.grid = 16;
  fine.outline_pieces = 100;
  int partly = 0;
  for (int trial = 0; trial < 3; ++trial) {
    const RayScene rays(Triangles());
    Luminaire lamp = PanelAt({uniform(-0.2, 0.2), uniform(-0.2, 0.2), uniform(2, 2.5)});
    lamp.distribution = Distribution::kCosinePower;
    lamp.cosine_exponent = uniform(0.8, 3);
    lamp.aim = Vector3d(uniform(-0.2, 0.2), uniform(-0.2, 0.2), -1).normalized();
    const DirectIlluminance light = ShadowedIlluminancePerLumen(rays, lamp, {0, 0, 0}, {0, 0, 1}, fine);
    const double whole = DirectIlluminancePerLumen(lamp, {0, 0, 0}, {0, 0, 1}).lx_per_lm;
    partly += light.lx_per_lm > 0 && light.lx_per_lm < 0.999 * whole ? 1 : 0;
    // Over 4 cm, so that the rays' grid of 1 mm resolves the change to 2 %; the truth bends by (4 cm / 2
    // m)^2.
    constexpr double kStep = 0.02;
    const auto slope = [&](const std::function<void(Luminaire&, double)>& move) {
      Luminaire up = lamp, down = lamp;
      move(up, kStep);
      move(down, -kStep);
      return (ByManyRays(rays, up) - ByManyRays(rays, down)) / (2 * kStep);
    };
    const double tolerance = 0.04 * whole;  // per metre or radian
    EXPECT_NEAR(light.lx_per_lm, ByManyRays(rays, lamp), 0.005 * whole);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(light.d_position[axis], slope([&](Luminaire& l, double h) { l.position[axis] += h; }),
                  tolerance)
          << axis;
    }
    for (int side = 0; side < 2; ++side) {
      EXPECT_NEAR(light.d_size[side], slope([&](Luminaire& l, double h) { l.size_m[side] += h; }), tolerance)
          << side;
    }
    const LuminaireAxes axes = AxesOf(lamp);
    const auto turn = [&](const Vector3d& axis) {
      return slope([&](Luminaire& l, double h) {
        const Eigen::AngleAxisd rotation(h, axis);
        l.aim = rotation * l.aim;
        l.heading = rotation * axes.along;
      });
    };
    EXPECT_NEAR(light.d_tilt[0], turn(axes.across), tolerance);
    EXPECT_NEAR(light.d_tilt[1], turn(-axes.along), tolerance);
    EXPECT_NEAR(light.d_heading, turn(lamp.aim), tolerance);
    EXPECT_NEAR(light.d_exponent, slope([&](Luminaire& l, double h) { l.cosine_exponent += h; }), tolerance);
  }
  EXPECT_GE(partly, 2);
}

TEST(ShadowedLight, IsTheUnoccludedLightWhereNothingHides) {
  const RayScene open{Scene{}};
  Luminaire disc = PanelAt({0.3, 0.2, 2});
  disc.shape = LuminaireShape::kDisc;
  const DirectIlluminance expected = DirectIlluminancePerLumen(disc, {0, 0, 0}, {0, 0, 1});
  const DirectIlluminance light = ShadowedIlluminancePerLumen(open, disc, {0, 0, 0}, {0, 0, 1});
  EXPECT_DOUBLE_EQ(light.lx_per_lm, expected.lx_per_lm);
  EXPECT_EQ(light.d_position, expected.d_position);
  Luminaire point = disc;
  point.shape = LuminaireShape::kPoint;
  EXPECT_EQ(VisibleShare(open, point, {0, 0, 0}, {0, 0, -1}), 0);
}

}  // namespace
}  // namespace luxfit
