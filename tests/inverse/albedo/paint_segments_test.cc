// Reflectances of elements in closed form: two paints on one plane or on two, noise, stains, an error of the light.
#include "inverse/albedo/paint_segments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <stdexcept>

#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using Eigen::Vector3d;

// Returns a rectangle of 2 m x 1 m that faces up, cut into 20 x 12 elements.
Facet Tabletop() {
  Facet facet;
  facet.origin = Vector3d::Zero();
  facet.edge_u = {2, 0, 0};
  facet.edge_v = {0, 1, 0};
  return facet;
}

Patches PatchesOf(const std::vector<Facet>& facets) {
  Scene scene;
  scene.materials = {"plane"};
  scene.facets = facets;
  return Subdivide(scene, RayScene(scene));
}

// `albedo_at`: of an element, without noise. `noise`: relative, independent.
template <typename AlbedoAt>
std::vector<ElementReflectance> Painted(const Patches& patches, const AlbedoAt& albedo_at, double noise,
                                        std::mt19937_64& rng) {
  std::normal_distribution<double> normal(0, noise);
  std::vector<ElementReflectance> reflectances;
  for (size_t e = 0; e < patches.elements.size(); ++e) {
    ElementReflectance r;
    r.element = static_cast<int>(e);
    r.albedo = albedo_at(patches.elements[e]) * std::exp(normal(rng));
    reflectances.push_back(r);
  }
  return reflectances;
}

PaintSegments Segments(const Patches& patches, const std::vector<ElementReflectance>& reflectances) {
  return SegmentPaints(patches, reflectances, 0, Eigen::VectorXd::Constant(1, 0.005));
}

double TwoPaints(const Element& e) { return e.center.x() < 1.2 ? 0.7 : 0.5; }

TEST(PaintSegments, TwoPaintsOnOnePlaneAreTwo) {
  std::mt19937_64 rng = support::TestRng();
  const Patches patches = PatchesOf({Tabletop()});
  const PaintSegments paints = Segments(patches, Painted(patches, TwoPaints, 0.01, rng));
  ASSERT_EQ(paints.segments.size(), 2U);
  const PaintSegment &left = paints.segments[0], &right = paints.segments[1];
  EXPECT_NEAR(left.area_m2, 1.2, 1e-9);
  EXPECT_NEAR(right.area_m2, 0.8, 1e-9);
  EXPECT_LT((left.center - Vector3d(0.6, 0.5, 0)).norm(), 1e-9);
  EXPECT_LT((left.normal - Vector3d(0, 0, 1)).norm(), 1e-9);
  // 144 and 96 elements of 1 %: three standard errors are 0.25 and 0.31 %.
  EXPECT_NEAR(left.albedo / 0.7, 1, 0.0025);
  EXPECT_NEAR(right.albedo / 0.5, 1, 0.0031);
  EXPECT_GT(left.sigma, 0.005 * left.albedo);  // what the fit says of all its materials
  EXPECT_NEAR(paints.element_sigma, 0.01, 0.002);
  EXPECT_TRUE(left.albedo_rgb.array().isNaN().all());
}

// A fourth of the plane is 4 % darker: the light of a fit may err so.
TEST(PaintSegments, OnePaintIsOneWhateverTheNoiseAndTheErrorOfTheLight) {
  std::mt19937_64 rng = support::TestRng();
  const Patches patches = PatchesOf({Tabletop()});
  for (const double noise : {0.001, 0.01, 0.05, 0.2}) {
    const auto uneven = [](const Element& e) { return e.center.x() < 0.5 ? 0.48 : 0.5; };
    const PaintSegments paints = Segments(patches, Painted(patches, uneven, noise, rng));
    ASSERT_EQ(paints.segments.size(), 1U) << noise;
    EXPECT_NEAR(paints.segments[0].area_m2, 2, 1e-9);
  }
}

TEST(PaintSegments, AStainIsNoPaintAndMovesNone) {
  std::mt19937_64 rng = support::TestRng();
  const Patches patches = PatchesOf({Tabletop()});
  const auto stained = [](const Element& e) {
    return (e.center - Vector3d(1, 0.5, 0)).lpNorm<Eigen::Infinity>() < 0.1 ? 0.05 : 0.5;
  };
  const PaintSegments paints = Segments(patches, Painted(patches, stained, 0.01, rng));
  ASSERT_EQ(paints.segments.size(), 1U);
  EXPECT_EQ(paints.segments[0].elements.size(), patches.elements.size());
  EXPECT_NEAR(paints.segments[0].albedo / 0.5, 1, 0.002);  // some 230 elements, three standard errors
}

TEST(PaintSegments, WallsOfOnePaintAreOneAcrossTheirEdge) {
  std::mt19937_64 rng = support::TestRng();
  Facet wall = Tabletop();  // stands on the long edge y = 1 m and faces the tabletop
  wall.origin = {0, 1, 0};
  wall.edge_v = {0, 0, 1};
  const Patches patches = PatchesOf({Tabletop(), wall});
  const PaintSegments alike = Segments(patches, Painted(
                                                    patches, [](const Element&) { return 0.5; }, 0.01, rng));
  ASSERT_EQ(alike.segments.size(), 1U);
  EXPECT_NEAR(alike.segments[0].normal.norm(), std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(alike.segments[0].high_m, 23 / 24., 1e-9);
  const auto unlike = [](const Element& e) { return e.normal.z() > 0.5 ? 0.5 : 0.6; };
  EXPECT_EQ(Segments(patches, Painted(patches, unlike, 0.01, rng)).segments.size(), 2U);
}

TEST(PaintSegments, FacesOfAThinPlateDoNotAdjoin) {
  std::mt19937_64 rng = support::TestRng();
  Facet below = Tabletop();
  below.origin.z() = -0.02;
  std::swap(below.edge_u, below.edge_v);
  const Patches patches = PatchesOf({Tabletop(), below});
  const PaintSegments paints = Segments(patches, Painted(
                                                     patches, [](const Element&) { return 0.5; }, 0.01, rng));
  EXPECT_EQ(paints.segments.size(), 2U);
}

// A strip that no photo shows parts the plane.
TEST(PaintSegments, PartsOfOnePlaneWithOnePaintAreOne) {
  std::mt19937_64 rng = support::TestRng();
  const Patches patches = PatchesOf({Tabletop()});
  std::vector<ElementReflectance> seen;
  for (const ElementReflectance& r : Painted(
           patches, [](const Element&) { return 0.5; }, 0.01, rng)) {
    if (std::abs(patches.elements[static_cast<size_t>(r.element)].center.x() - 1) > 0.2) seen.push_back(r);
  }
  EXPECT_EQ(Segments(patches, seen).segments.size(), 1U);
}

TEST(PaintSegments, ColoursAreThoseOfTheElements) {
  std::mt19937_64 rng = support::TestRng();
  const Patches patches = PatchesOf({Tabletop()});
  std::vector<ElementReflectance> red = Painted(patches, TwoPaints, 0.01, rng);
  for (ElementReflectance& r : red) r.albedo_rgb = r.albedo * Vector3d(1.3, 0.9, 0.5);
  for (const PaintSegment& segment : Segments(patches, red).segments)
    EXPECT_LT((segment.albedo_rgb / segment.albedo - Vector3d(1.3, 0.9, 0.5)).norm(), 1e-9);
}

// Errors of 2 % that the elements of a patch share, on many planes.
TEST(PaintSegments, SigmaIsWhatItSays) {
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<double> normal(0, 0.02);
  const Patches patches = PatchesOf({Tabletop()});
  double sum = 0;
  constexpr int kPlanes = 200;
  for (int plane = 0; plane < kPlanes; ++plane) {
    std::vector<double> error;
    for (size_t p = 0; p < patches.patches.size(); ++p) error.push_back(std::exp(normal(rng)));
    const auto painted = [&](const Element& e) { return 0.5 * error[static_cast<size_t>(e.patch)]; };
    const PaintSegments paints =
        SegmentPaints(patches, Painted(patches, painted, 0.005, rng), 0, Eigen::VectorXd::Zero(1));
    ASSERT_EQ(paints.segments.size(), 1U);
    sum += std::pow((paints.segments[0].albedo - 0.5) / paints.segments[0].sigma, 2);
  }
  std::printf("mean z^2 %.2f of %zu patches\n", sum / kPlanes, patches.patches.size());
  // Student's t of n - 1 degrees of freedom has the variance (n - 1) / (n - 3); 0.3: 2.5 standard errors of the mean.
  const auto n = static_cast<double>(patches.patches.size());
  EXPECT_NEAR(sum / kPlanes, (n - 1) / (n - 3), 0.3);
}

TEST(PaintSegments, NothingSeenIsNoSegment) {
  const Patches patches = PatchesOf({Tabletop()});
  EXPECT_TRUE(Segments(patches, {}).segments.empty());
}

TEST(PaintSegments, RefusesAReflectanceThatIsNone) {
  const Patches patches = PatchesOf({Tabletop()});
  ElementReflectance black;
  EXPECT_THROW(Segments(patches, {black}), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
