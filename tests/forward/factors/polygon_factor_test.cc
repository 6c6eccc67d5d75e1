#include "forward/factors/internal/polygon_factor.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "tests/support/closed_forms.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using Eigen::Vector3d;
using support::kPi;

ConvexPolygon Plate(const Vector3d& origin, const Vector3d& u, const Vector3d& v) {
  return MakePolygon(origin, u, v, FacetKind::kParallelogram);
}

// Howell's catalogue C-11: identical, directly opposed a x b at distance c.
double OpposedRectangles(double a, double b, double c) {
  const double x = a / c, y = b / c, x2 = 1 + x * x, y2 = 1 + y * y;
  return 2 / (kPi * x * y) *
         (0.5 * std::log(x2 * y2 / (1 + x * x + y * y)) + x * std::sqrt(y2) * std::atan(x / std::sqrt(y2)) +
          y * std::sqrt(x2) * std::atan(y / std::sqrt(x2)) - x * std::atan(x) - y * std::atan(y));
}

// C-14: h x l and w x l at right angles with the common edge l; from w to h.
double PerpendicularRectangles(double height, double width, double length) {
  const double h = height / length, w = width / length, h2 = h * h, w2 = w * w;
  const double logs = std::log((1 + w2) * (1 + h2) / (1 + w2 + h2)) +
                      w2 * std::log(w2 * (1 + w2 + h2) / ((1 + w2) * (w2 + h2))) +
                      h2 * std::log(h2 * (1 + h2 + w2) / ((1 + h2) * (h2 + w2)));
  return (w * std::atan(1 / w) + h * std::atan(1 / h) -
          std::sqrt(h2 + w2) * std::atan(1 / std::sqrt(h2 + w2)) + 0.25 * logs) /
         (kPi * w);
}

TEST(PolygonToPolygon, IsTheCataloguesForOpposedRectangles) {
  const double sizes[][3] = {{1, 1, 1}, {2, 0.5, 0.7}, {0.1, 3, 0.02}, {1, 1, 30}};
  for (const auto& [a, b, c] : sizes) {
    const double factor =
        PolygonToPolygon(Plate({0, 0, 0}, {a, 0, 0}, {0, b, 0}), Plate({0, 0, c}, {0, b, 0}, {a, 0, 0}));
    EXPECT_NEAR(factor, OpposedRectangles(a, b, c), 1e-8) << a << " " << b << " " << c;
  }
}

TEST(PolygonToPolygon, IsTheCataloguesForPlatesThatTouch) {
  const double sizes[][3] = {{1, 1, 1}, {2.5, 0.3, 1}, {0.1, 0.1, 4}};
  for (const auto& [h, w, l] : sizes) {
    const ConvexPolygon floor = Plate({0, 0, 0}, {w, 0, 0}, {0, l, 0}),
                        wall = Plate({0, 0, 0}, {0, l, 0}, {0, 0, h});
    EXPECT_NEAR(PolygonToPolygon(floor, wall), PerpendicularRectangles(h, w, l), 1e-8)
        << h << " " << w << " " << l;
  }
}

TEST(PolygonToPolygon, OfTiltedStripsIsHottels) {
  // Two strips of equal width with a common edge, infinitely long: 1 - sin(angle / 2) (Hottel's crossed
  // strings). Ends take away a part proportional to 1 / length, which two lengths extrapolate away up to its
  // square.
  for (const double degrees : {20.0, 60.0, 90.0, 135.0}) {
    const double angle = degrees * kPi / 180;
    const auto factor = [&](double length) {
      return PolygonToPolygon(Plate({0, 0, 0}, {1, 0, 0}, {0, length, 0}),
                              Plate({0, 0, 0}, {0, length, 0}, {std::cos(angle), 0, std::sin(angle)}));
    };
    EXPECT_NEAR(2 * factor(200) - factor(100), 1 - std::sin(angle / 2), 1e-4) << degrees;
  }
}

TEST(PolygonToPolygon, OfCoaxialDiscsIsTheCatalogues) {
  // C-41, as fans of 120 triangles each, circumscribed so that areas are equal: shapes differ by (2 pi /
  // 120)^2 / 12 = 2e-4.
  constexpr int kSides = 120;
  const double turn = 2 * kPi / kSides;
  const double r1 = 0.8, r2 = 1.5, h = 1.1;
  const auto corner = [&](double r, int k, double z) {
    const double grown = r / std::sqrt(std::sin(turn) / turn);
    return Vector3d(grown * std::cos(k * turn), grown * std::sin(k * turn), z);
  };
  ConvexPolygon first;
  first.Add({0, 0, 0});
  first.Add(corner(r1, 0, 0));
  first.Add(corner(r1, 1, 0));
  double sum = 0;
  for (int k = 0; k < kSides; ++k) {
    ConvexPolygon second;
    second.Add({0, 0, h});
    second.Add(corner(r2, k + 1, h));
    second.Add(corner(r2, k, h));
    sum += PolygonToPolygon(first, second);
  }
  const double a = r1 / h, b = r2 / h, x = 1 + (1 + b * b) / (a * a);
  EXPECT_NEAR(sum, 0.5 * (x - std::sqrt(x * x - 4 * (b / a) * (b / a))), 2e-4);
}

double AreaM2(const ConvexPolygon& polygon) {
  Vector3d twice_area = Vector3d::Zero();
  for (int k = 2; k < polygon.count; ++k)
    twice_area += (polygon[k - 1] - polygon[0]).cross(polygon[k] - polygon[0]);
  return twice_area.norm() / 2;
}

TEST(PolygonToPolygon, OfASphereToARectangleIsItsSolidAngle) {
  // A sphere sends a rectangle with a corner under it the share atan(a b / (h sqrt(a^2 + b^2 + h^2))) / (4
  // pi). Here the rectangle's share of the sphere, turned round by reciprocity; the sphere is 32 x 64
  // quadrangles cut into triangles, its area right to 2e-3 and taken as it is.
  const double a = 1.2, b = 0.7, h = 0.9, radius = 0.3;
  const ConvexPolygon plate = Plate({0, 0, -h}, {a, 0, 0}, {0, b, 0});
  double flow = 0, area = 0;
  const auto point = [&](int i, int k) {
    const double t = kPi * i / 32, p = 2 * kPi * k / 64;
    return Vector3d(radius * std::sin(t) * std::cos(p), radius * std::sin(t) * std::sin(p),
                    radius * std::cos(t));
  };
  const auto add = [&](const Vector3d& p, const Vector3d& q, const Vector3d& r) {
    ConvexPolygon piece;
    piece.Add(p);
    piece.Add(q);
    piece.Add(r);
    if (AreaM2(piece) < 1e-12) return;
    area += AreaM2(piece);
    flow += AreaM2(piece) * PolygonToPolygon(piece, plate);
  };
  for (int i = 0; i < 32; ++i) {
    for (int k = 0; k < 64; ++k) {
      add(point(i, k), point(i + 1, k), point(i + 1, k + 1));
      add(point(i, k), point(i + 1, k + 1), point(i, k + 1));
    }
  }
  const double expected = std::atan(a * b / (h * std::sqrt(a * a + b * b + h * h))) / (4 * kPi);
  EXPECT_NEAR(flow / area, expected, 2e-3 * expected);
}

TEST(PolygonToPolygon, IsReciprocalForPlatesThatCutEachOthersPlane) {
  std::mt19937_64 rng = support::TestRng();
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 30; ++trial) {
    const auto random = [&] { return Vector3d(uniform(rng), uniform(rng), uniform(rng)); };
    const ConvexPolygon a = MakePolygon(random(), random(), random(), FacetKind::kTriangle);
    const ConvexPolygon b =
        MakePolygon(random() + Vector3d(2.5, 0, 0), random(), random(), FacetKind::kParallelogram);
    EXPECT_NEAR(AreaM2(a) * PolygonToPolygon(a, b), AreaM2(b) * PolygonToPolygon(b, a), 1e-8);
  }
}

// Edges along no axis: their common line is rounded differently in either polygon.
TEST(PolygonToPolygon, ACommonEdgeMayRunAnywhere) {
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Matrix3d turn = Eigen::Quaterniond(normal(rng), normal(rng), normal(rng), normal(rng))
                                     .normalized()
                                     .toRotationMatrix();
    const Vector3d at(normal(rng), normal(rng), normal(rng)), x = turn.col(0), y = turn.col(1),
                                                              z = turn.col(2);
    // Howell's C-14: squares at a right angle with an edge in common.
    EXPECT_NEAR(PolygonToPolygon(Plate(at, x, y), Plate(at, y, z)), 0.200044, 1e-6);
  }
}

TEST(PointToPolygon, IsTheCataloguesForARectangleOverhead) {
  const Vector3d p(0.3, 0.2, 0);
  const ConvexPolygon plate = Plate({-0.5, -1, 1.3}, {0, 2, 0}, {1.5, 0, 0});
  EXPECT_NEAR(PointToPolygon(p, {0, 0, 1}, plate), support::RectangleFactor({0.25, 0, 1.3}, 1.5, 2, p),
              1e-12);
  EXPECT_EQ(PointToPolygon(p, {0, 0, -1}, plate), 0);              // faces away
  EXPECT_EQ(PointToPolygon({0.3, 0.2, 2}, {0, 0, -1}, plate), 0);  // sees its back
}

TEST(PointToPolygon, IsThePolygonsWhenThePolygonShrinks) {
  // A tilted plate that reaches below the horizon, against quadrature of the other's closed form over a small
  // receiver.
  const ConvexPolygon plate = Plate({1, -0.5, -0.4}, {0, 1, 0}, {0.3, 0, 1.1});
  const ConvexPolygon facing = Plate({1, -0.5, -0.4}, {0.3, 0, 1.1}, {0, 1, 0});
  const ConvexPolygon spot = Plate({-5e-4, -5e-4, 0}, {1e-3, 0, 0}, {0, 1e-3, 0});
  const double at_point = PointToPolygon({0, 0, 0}, {0, 0, 1}, facing);
  EXPECT_EQ(PointToPolygon({0, 0, 0}, {0, 0, 1}, plate), 0);
  EXPECT_GT(at_point, 0.01);
  EXPECT_NEAR(PolygonToPolygon(spot, facing), at_point, 1e-5);  // its variation over a millimetre
}

}  // namespace
}  // namespace luxfit
