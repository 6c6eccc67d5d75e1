#include "forward/radiosity/internal/hierarchical.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "forward/direct/internal/shadowed_light.h"
#include "forward/light/light_tracer.h"
#include "forward/light/room.h"
#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

struct LitScene {
  Scene scene;
  RayScene rays;
  Luminaire lamp;
  Eigen::VectorXd albedo;
  LitScene(Scene s, const Luminaire& l, const Eigen::VectorXd& a)
      : scene(std::move(s)), rays(scene), lamp(l), albedo(a) {}

  DirectLight Direct() const {
    return [this](const Eigen::Vector3d& p, const Eigen::Vector3d& normal) {
      return lamp.flux_lm * VisibleIlluminancePerLumen(rays, lamp, p, normal);
    };
  }
  HierarchicalSolution Solve(const HierarchicalOptions& options) const {
    return SolveHierarchical(scene, rays, albedo, Direct(), options);
  }
};

HierarchicalOptions Within(double error_percent) {
  HierarchicalOptions options;
  options.error_percent = error_percent;
  return options;
}

Luminaire CeilingPanel() {
  Luminaire lamp;
  lamp.position = {2.2, 1.4, 2.4};
  lamp.shape = LuminaireShape::kRectangle;
  lamp.size_m = {0.6, 0.6};
  lamp.flux_lm = 4000;
  return lamp;
}

// A room with a box, a shelf and a slanted triangle.
LitScene RoomWithOccluders() {
  Scene scene = support::ClosedRoom({4, 3, 2.5}, {"wall", "wall", "wall", "accent", "floor", "ceiling"});
  support::AddBox(scene, {Eigen::Vector3d(0.6, 0.5, 0), Eigen::Vector3d(1.4, 1.5, 1.1)},
                  support::Facing::kOutward, {"solid"});
  support::AddBox(scene, {Eigen::Vector3d(2.6, 1.0, 0.9), Eigen::Vector3d(3.3, 2.2, 1.0)},
                  support::Facing::kOutward, {"solid"});
  support::AddTriangle(scene, {3.2, 0.3, 0.4}, {0.5, 0, 0.2}, {0, 0.5, 0}, "accent");
  Eigen::VectorXd albedo(5);
  albedo << 0.7, 0.4, 0.25, 0.8, 0.5;
  return {std::move(scene), CeilingPanel(), albedo};
}

// Points spread over the scene by area, each on the leaf that holds it: pointwise rms of the difference from
// the light tracer, less the tracer's own noise, in percent of the mean.
struct Comparison {
  double rms_percent = 0, bias_percent = 0;
};
Comparison WithLightTracer(const LitScene& lit, const HierarchicalSolution& solution, int points,
                           std::mt19937_64& rng) {
  std::vector<double> area;
  for (const HierarchicalElement& element : solution.elements) area.push_back(element.area_m2);
  std::discrete_distribution<size_t> leaf(area.begin(), area.end());
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Sensor> sensors;
  std::vector<double> lux;
  for (int i = 0; i < points; ++i) {
    const HierarchicalElement& element = solution.elements[leaf(rng)];
    const Facet& facet = lit.scene.facets[static_cast<size_t>(element.facet)];
    double u = unit(rng), v = unit(rng);
    if (facet.kind == FacetKind::kTriangle && u + v > 1) u = 1 - u, v = 1 - v;
    sensors.push_back({element.origin + u * element.edge_u + v * element.edge_v, facet.Normal()});
    lux.push_back(element.illuminance_lx);
  }
  LightTracerOptions options;
  options.paths_per_sensor = 4096;
  const TracedIlluminance traced =
      TraceIlluminance(lit.scene, lit.rays, {lit.lamp}, lit.albedo, sensors, options);
  double squares = 0, sum = 0;
  int free = 0;
  for (int i = 0; i < points; ++i) {
    if (traced.direct(i, 0) + traced.indirect(i, 0) == 0) continue;  // inside a solid
    const double difference = lux[static_cast<size_t>(i)] - traced.direct(i, 0) - traced.indirect(i, 0);
    squares += difference * difference - std::pow(traced.direct_sigma(i, 0), 2) -
               std::pow(traced.indirect_sigma(i, 0), 2);
    sum += difference;
    ++free;
  }
  const double percent = 100 / solution.mean_illuminance_lx;
  return {percent * std::sqrt(std::max(0.0, squares / free)), percent * sum / free};
}

TEST(Hierarchical, KeepsTheErrorThatIsAskedFor) {
  std::mt19937_64 rng = support::TestRng();
  const LitScene lit = RoomWithOccluders();
  double previous_percent = 100;
  for (const double asked : {20.0, 10.0}) {
    const HierarchicalSolution solution = lit.Solve(Within(asked));
    EXPECT_TRUE(solution.converged) << solution.message;
    EXPECT_LE(solution.error_percent, asked);
    const Comparison measured = WithLightTracer(lit, solution, 200, rng);
    std::printf(
        "asked %.0f %%: estimated %.2f, measured %.2f %% rms, %.2f %% bias; %zu elements, %lld links\n",
        asked, solution.error_percent, measured.rms_percent, measured.bias_percent, solution.elements.size(),
        static_cast<long long>(solution.link_count));
    EXPECT_LE(measured.rms_percent, asked);
    EXPECT_LT(measured.rms_percent, previous_percent);
    previous_percent = measured.rms_percent;
    double area_m2 = 0;
    for (const HierarchicalElement& element : solution.elements) area_m2 += element.area_m2;
    double facets_m2 = 0;
    for (const Facet& facet : lit.scene.facets) facets_m2 += facet.AreaM2();
    EXPECT_NEAR(area_m2, facets_m2, 1e-9 * facets_m2) << "leaves tile the facets";
  }
}

// A wall between bright and dark, floor and walls running on below it.
TEST(Hierarchical, PartitionKeepsLightOnItsSide) {
  std::mt19937_64 rng = support::TestRng();
  Scene scene = support::ClosedRoom({6, 4, 2.8});
  support::AddBox(scene, {Eigen::Vector3d(3.4, 0, 0), Eigen::Vector3d(3.5, 2.6, 2.8)},
                  support::Facing::kOutward, {"wall"});
  const LitScene lit(std::move(scene), CeilingPanel(), Eigen::VectorXd::Constant(1, 0.65));
  const HierarchicalSolution solution = lit.Solve(Within(10));
  EXPECT_TRUE(solution.converged) << solution.message;
  const Comparison measured = WithLightTracer(lit, solution, 300, rng);
  std::printf("estimated %.2f, measured %.2f %% rms, %.2f %% bias\n", solution.error_percent,
              measured.rms_percent, measured.bias_percent);
  EXPECT_LE(measured.rms_percent, 10);
  // Six standard errors of a mean over 300 points whose rms is 5 %.
  EXPECT_LE(std::abs(measured.bias_percent), 6 * 5 / std::sqrt(300.0));
}

// Elements of both on the same places: means of the dense solution over each material.
TEST(Hierarchical, AgreesWithTheDenseSolution) {
  const LitScene lit = RoomWithOccluders();
  const double asked = 10;
  const HierarchicalSolution solution = lit.Solve(Within(asked));
  RoomOptions options;
  options.patches.patch_size_m = 0.2;
  const Room room = MakeRoom(lit.scene, options);
  Eigen::MatrixXf at_elements(static_cast<Eigen::Index>(room.patches.elements.size()), 1);
  for (size_t e = 0; e < room.patches.elements.size(); ++e) {
    const Element& element = room.patches.elements[e];
    at_elements(static_cast<Eigen::Index>(e), 0) =
        static_cast<float>(lit.Direct()(element.center, element.normal));
  }
  const Eigen::MatrixXf direct = PatchMean(room.patches, at_elements);
  const Transport transport(room.transport, lit.albedo);
  const Eigen::VectorXf dense = direct + transport.Irradiance(transport.Exitance(direct));
  const Eigen::Index materials = lit.albedo.size();
  Eigen::VectorXd flux_lm = Eigen::VectorXd::Zero(materials), dense_lm = flux_lm, area_m2 = flux_lm;
  for (const HierarchicalElement& element : solution.elements) {
    const int m = lit.scene.facets[static_cast<size_t>(element.facet)].material;
    flux_lm[m] += element.area_m2 * element.illuminance_lx;
    area_m2[m] += element.area_m2;
  }
  for (size_t i = 0; i < room.patches.patches.size(); ++i) {
    const Patch& patch = room.patches.patches[i];
    dense_lm[patch.material] += patch.area_m2 * dense[static_cast<Eigen::Index>(i)];
  }
  // The bound, on means of surfaces too; 1 % for the dense solution (see office_forward_test).
  for (Eigen::Index m = 0; m < materials; ++m) {
    EXPECT_NEAR(flux_lm[m] / area_m2[m], dense_lm[m] / area_m2[m],
                0.01 * (asked + 1) * solution.mean_illuminance_lx)
        << lit.scene.materials[static_cast<size_t>(m)];
  }
}

// The mean over a closed room of one reflectance is Phi / (A (1 - rho)).
TEST(Hierarchical, CubeIsAnIntegratingSphere) {
  Luminaire lamp;
  lamp.position = {2, 2, 2};
  lamp.distribution = Distribution::kIsotropic;
  lamp.flux_lm = 10000;
  for (const double rho : {0.2, 0.5, 0.9}) {
    const LitScene lit(support::ClosedRoom({4, 4, 4}), lamp, Eigen::VectorXd::Constant(1, rho));
    const HierarchicalSolution solution = lit.Solve(Within(10));
    const double expected_lx = lamp.flux_lm / (96 * (1 - rho));
    EXPECT_TRUE(solution.converged) << solution.message;
    EXPECT_NEAR(solution.mean_illuminance_lx, expected_lx, 0.01 * solution.error_percent * expected_lx)
        << rho;
  }
}

TEST(Hierarchical, ElementsAreSmallerAtShadowEdges) {
  const LitScene lit = RoomWithOccluders();
  const HierarchicalSolution solution = lit.Solve(Within(15));
  // Of the floor, where the shelf's shadow falls and where none does.
  double smallest_m2 = 1, largest_m2 = 0;
  for (const HierarchicalElement& element : solution.elements) {
    if (element.facet != 4) continue;
    smallest_m2 = std::min(smallest_m2, element.area_m2);
    largest_m2 = std::max(largest_m2, element.area_m2);
  }
  EXPECT_GT(largest_m2, 30 * smallest_m2);
}

// Boxes of 6 to 14 cm, so small and many that most of their light goes by way of clusters.
LitScene RoomWithClutter(int boxes, std::mt19937_64& rng) {
  Scene scene = support::ClosedRoom({6, 4, 2.8}, {"wall", "wall", "wall", "wall", "floor", "ceiling"});
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < boxes; ++i) {
    const Eigen::Vector3d corner(0.1 + 5.6 * unit(rng), 0.1 + 3.6 * unit(rng), 0.1 + 0.6 * unit(rng));
    const Eigen::Vector3d size =
        Eigen::Vector3d::Constant(0.06) + 0.08 * Eigen::Vector3d(unit(rng), unit(rng), unit(rng));
    support::AddBox(scene, {corner, corner + size}, support::Facing::kOutward, {"box"});
  }
  Eigen::VectorXd albedo(4);
  albedo << 0.7, 0.3, 0.8, 0.5;
  return {std::move(scene), CeilingPanel(), albedo};
}

TEST(Hierarchical, ClustersKeepTheErrorAmongManyFacets) {
  std::mt19937_64 rng = support::TestRng();
  const LitScene lit = RoomWithClutter(60, rng);
  const HierarchicalSolution solution = lit.Solve(Within(25));
  EXPECT_TRUE(solution.converged) << solution.message;
  EXPECT_GT(solution.cluster_link_count, solution.link_count / 10);
  const int64_t facets = static_cast<int64_t>(lit.scene.facets.size());
  EXPECT_LT(solution.link_count, facets * facets / 4);
  const Comparison measured = WithLightTracer(lit, solution, 200, rng);
  std::printf(
      "%lld facets: estimated %.2f, measured %.2f %% rms, %.2f %% bias; %zu elements, %lld links, %lld of "
      "clusters\n",
      static_cast<long long>(facets), solution.error_percent, measured.rms_percent, measured.bias_percent,
      solution.elements.size(), static_cast<long long>(solution.link_count),
      static_cast<long long>(solution.cluster_link_count));
  EXPECT_LE(measured.rms_percent, 25);
  EXPECT_LE(std::abs(measured.bias_percent), 5);
}

TEST(Hierarchical, LimitsAreReported) {
  const LitScene lit = RoomWithOccluders();
  HierarchicalOptions options = Within(1);
  options.min_element_m = 0.3;
  const HierarchicalSolution coarse = lit.Solve(options);
  EXPECT_FALSE(coarse.converged);
  EXPECT_NE(coarse.message.find("min_element_m"), std::string::npos) << coarse.message;
  options = Within(5);
  options.max_links = 2000;
  const HierarchicalSolution few = lit.Solve(options);
  EXPECT_FALSE(few.converged);
  EXPECT_NE(few.message.find("max_links"), std::string::npos) << few.message;
}

TEST(Hierarchical, DarknessAndEmptinessAreNoError) {
  const LitScene lit = RoomWithOccluders();
  const DirectLight dark = [](const Eigen::Vector3d&, const Eigen::Vector3d&) { return 0.0; };
  const HierarchicalSolution solution = SolveHierarchical(lit.scene, lit.rays, lit.albedo, dark);
  EXPECT_TRUE(solution.converged);
  for (const HierarchicalElement& element : solution.elements) EXPECT_EQ(element.illuminance_lx, 0);
  const Scene nothing;
  EXPECT_TRUE(SolveHierarchical(nothing, RayScene(nothing), Eigen::VectorXd(), dark).elements.empty());
}

TEST(Hierarchical, OptionsAreChecked) {
  const LitScene lit = RoomWithOccluders();
  EXPECT_THROW(lit.Solve(Within(0)), std::invalid_argument);
  HierarchicalOptions options;
  options.min_element_m = 1;
  EXPECT_THROW(lit.Solve(options), std::invalid_argument);
  EXPECT_THROW(SolveHierarchical(lit.scene, lit.rays, Eigen::VectorXd::Constant(5, 1.0), lit.Direct()),
               std::invalid_argument);
  EXPECT_THROW(SolveHierarchical(lit.scene, lit.rays, lit.albedo.head(4), lit.Direct()),
               std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
