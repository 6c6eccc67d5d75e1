#include "forward/views/internal/vertex_interpolation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr double kFloat = 2e-5;  // weights and values are floats, of some units

double Linear(const Eigen::Vector3d& p) { return 3 + 0.7 * p.x() - 1.1 * p.y() + 0.4 * p.z(); }

struct Ready {
  explicit Ready(const Scene& s) : scene(s), patches(Subdivide(s, RayScene(s), {0.5, 0.25})) {
    interpolation = MakeVertexInterpolation(scene, patches);
  }
  template <typename Function>
  Eigen::MatrixXf AtElements(const Function& f) const {
    Eigen::MatrixXf values(static_cast<Eigen::Index>(patches.elements.size()), 1);
    for (Eigen::Index e = 0; e < values.rows(); ++e)
      values(e, 0) = static_cast<float>(f(patches.elements[static_cast<size_t>(e)]));
    return values;
  }
  Scene scene;
  Patches patches;
  VertexInterpolation interpolation;
};

// A sheared parallelogram, a scalene triangle, a strip one element wide and a single small element, all
// apart.
Scene FourFacets() {
  Scene scene;
  support::AddParallelogram(scene, {0, 0, 0}, {2.3, 0, 0}, {0.4, 1.7, 0.2}, "a");
  support::AddTriangle(scene, {5, 0, 0}, {1.9, 0.3, 0}, {0.2, 1.4, 0.5}, "b");
  return scene;
}

TEST(VertexInterpolation, ReproducesALinearFieldUpToTheBorders) {
  const Ready room(FourFacets());
  const Eigen::MatrixXf at_vertices =
      AtVertices(room.interpolation, room.AtElements([](const Element& e) { return Linear(e.center); }));
  std::mt19937_64 rng = support::TestRng();
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 1000; ++i) {
    const int facet = i % 2;
    double u = unit(rng), v = unit(rng);
    if (facet == 1 && u + v > 1) u = 1 - u, v = 1 - v;
    const Eigen::Vector3d p = room.scene.facets[static_cast<size_t>(facet)].PointAt(u, v);
    EXPECT_NEAR(Interpolate(room.interpolation, at_vertices, facet, u, v)[0], Linear(p), kFloat);
  }
}

TEST(VertexInterpolation, AStripOfOneElementIsConstantAcrossAndLinearAlong) {
  Scene scene;
  support::AddParallelogram(scene, {0, 0, 0}, {2, 0, 0}, {0, 0.2, 0}, "a");
  support::AddParallelogram(scene, {0, 3, 0}, {0.2, 0, 0}, {0, 0.2, 0}, "a");
  const Ready room(scene);
  const Eigen::MatrixXf at_vertices =
      AtVertices(room.interpolation, room.AtElements([](const Element& e) { return 2 + e.center.x(); }));
  for (const double u : {0.0, 0.3, 1.0}) {
    for (const double v : {0.0, 0.9}) {
      EXPECT_NEAR(Interpolate(room.interpolation, at_vertices, 0, u, v)[0], 2 + 2 * u, kFloat);
      EXPECT_NEAR(Interpolate(room.interpolation, at_vertices, 1, u, v)[0], 2.1, kFloat);
    }
  }
}

// Values that differ from element to element.
double Rough(const Element& e) {
  return std::sin(7 * e.center.x()) + std::cos(5 * e.center.y() + 3 * e.center.z());
}

TEST(VertexInterpolation, InnerVerticesAreTheMeanOfTheirElements) {
  Scene scene;
  support::AddParallelogram(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, "a");  // 4 x 4 elements
  const Ready room(scene);
  const Eigen::MatrixXf values = room.AtElements(Rough);
  double mean = 0;
  for (const auto& [u, v] : {std::pair{0.4, 0.4}, {0.6, 0.4}, {0.4, 0.6}, {0.6, 0.6}})
    mean += values(room.patches.ElementAt(0, u, v), 0) / 4;
  EXPECT_NEAR(Interpolate(room.interpolation, AtVertices(room.interpolation, values), 0, 0.5, 0.5)[0], mean,
              1e-6);
}

double Jump(const Scene& scene, double u0, double v0, double u1, double v1) {
  const Ready room(scene);
  const Eigen::MatrixXf at_vertices = AtVertices(room.interpolation, room.AtElements(Rough));
  EXPECT_NEAR((scene.facets[0].PointAt(u0, v0) - scene.facets[1].PointAt(u1, v1)).norm(), 0, 1e-9);
  return std::abs(Interpolate(room.interpolation, at_vertices, 0, u0, v0)[0] -
                  Interpolate(room.interpolation, at_vertices, 1, u1, v1)[0]);
}

Scene TwoSquares(const Eigen::Vector3d& edge_of_second, const std::string& material) {
  Scene scene;
  support::AddParallelogram(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, "a");
  support::AddParallelogram(scene, {1, 0, 0}, edge_of_second, {0, 1, 0}, material);
  return scene;
}

TEST(VertexInterpolation, IsContinuousWithinAPlaneAndAMaterialOnly) {
  for (const double v : {0.1, 0.37, 0.8}) {
    EXPECT_NEAR(Jump(TwoSquares({1, 0, 0}, "a"), 1, v, 0, v), 0, 1e-6);
    EXPECT_GT(Jump(TwoSquares({1, 0, 0}, "b"), 1, v, 0, v), 0.01);
    EXPECT_GT(Jump(TwoSquares({0, 0, 1}, "a"), 1, v, 0, v), 0.01);
  }
  Scene triangles;  // a square cut along its diagonal
  support::AddTriangle(triangles, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, "a");
  support::AddTriangle(triangles, {1, 1, 0}, {-1, 0, 0}, {0, -1, 0}, "a");
  for (const double u : {0.11, 0.5, 0.93}) EXPECT_NEAR(Jump(triangles, u, 1 - u, 1 - u, u), 0, 1e-6);
}

TEST(VertexInterpolation, NothingComesFromUnderASolid) {
  Scene scene = support::ClosedRoom({2, 2, 2});
  support::AddBox(scene, {Eigen::Vector3d(0.5, 0.5, 0), Eigen::Vector3d(1.5, 1.5, 1)},
                  support::Facing::kOutward, {"box"});
  const Ready room(scene);
  const Eigen::MatrixXf at_vertices =
      AtVertices(room.interpolation, room.AtElements([](const Element&) { return 1; }));
  EXPECT_NEAR(Interpolate(room.interpolation, at_vertices, 4, 0.24, 0.4)[0], 1, kFloat);
  EXPECT_EQ(Interpolate(room.interpolation, at_vertices, 4, 0.5, 0.5)[0], 0);  // no vertex is near
}

}  // namespace
}  // namespace luxfit
