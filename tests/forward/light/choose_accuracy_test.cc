// The choice of patch size, rays and bounces: its estimate against the true error, known from the light
// tracer.
#include "forward/light/choose_accuracy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "forward/light/light_tracer.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

LitScene Lit(Scene scene, const std::vector<double>& albedo, const std::vector<Luminaire>& luminaires,
             const std::vector<Sensor>& sensors) {
  LitScene lit;
  lit.scene = std::move(scene);
  lit.luminaires = luminaires;
  lit.albedo_rgb.resize(3, static_cast<Eigen::Index>(albedo.size()));
  for (size_t m = 0; m < albedo.size(); ++m)
    lit.albedo_rgb.col(static_cast<Eigen::Index>(m)).setConstant(albedo[m]);
  lit.sensors = sensors;
  return lit;
}

Luminaire Panel(const Eigen::Vector3d& position) {
  Luminaire panel;
  panel.position = position;
  panel.shape = LuminaireShape::kRectangle;
  panel.size_m = {0.6, 0.6};
  return panel;
}

// A cabinet by the wall, a desk's block in the middle.
LitScene Furnished() {
  Scene scene = support::ClosedRoom({4, 3, 2.7});
  support::AddBox(scene, {Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0.5, 2, 1.8)}, support::Facing::kOutward,
                  {"cabinet"});
  support::AddBox(scene, {Eigen::Vector3d(2, 1, 0), Eigen::Vector3d(3.2, 1.7, 0.7)},
                  support::Facing::kOutward, {"cabinet"});
  return Lit(scene, {0.6, 0.3}, {Panel({1.3, 1.5, 2.65}), Panel({3, 2, 2.65})},
             {{{1, 0.5, 0.01}, {0, 0, 1}, {}},
              {{2.5, 1.3, 0.75}, {0, 0, 1}, {}},
              {{3.6, 2.6, 0.01}, {0, 0, 1}, {}},
              {{0.3, 2.6, 0.8}, {0, 0, 1}, {}},
              {{2, 2.99, 1.2}, {0, -1, 0}, {}},
              {{1.6, 1.3, 0.3}, {1, 0, 0}, {}}});
}

// Half of the sensors stand behind a partition, in reflected light alone.
LitScene Divided() {
  Scene scene = support::ClosedRoom({5, 3, 2.7});
  support::AddBox(scene, {Eigen::Vector3d(2.95, 0, 0), Eigen::Vector3d(3.05, 2.2, 2)},
                  support::Facing::kOutward, {"partition"});
  return Lit(scene, {0.6, 0.4}, {Panel({1.5, 1.5, 2.6})},
             {{{4, 0.5, 0.01}, {0, 0, 1}, {}},
              {{4, 1.5, 0.8}, {0, 0, 1}, {}},
              {{3.5, 1, 0.8}, {0, 0, 1}, {}},
              {{1.5, 0.5, 0.01}, {0, 0, 1}, {}},
              {{2.5, 2.5, 0.8}, {0, 0, 1}, {}},
              {{0.5, 1, 0.8}, {1, 0, 0}, {}}});
}

struct Truth {
  Eigen::MatrixXd lx;
  double sigma_percent = 0;
};
Truth Trace(const LitScene& lit, int paths_per_sensor) {
  LightTracerOptions options;
  options.paths_per_sensor = paths_per_sensor;
  const TracedIlluminance traced = TraceIlluminance(lit.scene, RayScene(lit.scene), lit.luminaires,
                                                    lit.albedo_rgb.row(0).transpose(), lit.sensors, options);
  const Eigen::MatrixXd lx = traced.direct + traced.indirect;
  const Eigen::MatrixXd sigma =
      (traced.direct_sigma.array().square() + traced.indirect_sigma.array().square()).sqrt();
  return {lx, RelativeRmsPercent(lx + sigma, lx)};
}

class ChooseAccuracyInRoom : public testing::TestWithParam<bool> {
 protected:
  const LitScene lit_ = GetParam() ? Divided() : Furnished();
};

TEST_P(ChooseAccuracyInRoom, EstimateCoversTheTrueError) {
  const Truth truth = Trace(lit_, GetParam() ? 1 << 20 : 1 << 17);
  ASSERT_LT(truth.sigma_percent, 0.25) << "too noisy for the test to tell";
  int last_elements = 0;
  for (const double asked : {5.0, 1.0}) {
    AccuracyOptions options;
    options.error_percent = asked;
    const AccurateSceneLight accurate = ChooseAccuracy(lit_, options);
    const AccuracyChoice& choice = accurate.choice;
    const double error = RelativeRmsPercent(accurate.light.light.total.cast<double>(), truth.lx);
    std::printf("asked %g %%: estimated %.2f %%, true %.2f %% (± %.2f), %d patches\n", asked,
                choice.estimated_error_percent, error, truth.sigma_percent, choice.tried.back().patches);
    EXPECT_TRUE(choice.reached);
    EXPECT_LE(choice.estimated_error_percent, asked);
    EXPECT_LE(error, choice.estimated_error_percent + 3 * truth.sigma_percent);
    EXPECT_LE(error, asked);
    // A smaller error costs no less.
    EXPECT_GE(choice.tried.back().elements, last_elements);
    last_elements = choice.tried.back().elements;
    for (const std::string& because :
         {choice.patches_because, choice.rays_because, choice.sensors_because, choice.bounces_because})
      EXPECT_FALSE(because.empty());
  }
}

// Coarser tries are an eighth of the last or less: the choice costs little more than what it chose. Pairs
// of elements and patches count, not seconds.
TEST_P(ChooseAccuracyInRoom, CostsLittleMoreThanItsResult) {
  const AccuracyChoice choice = ChooseAccuracy(lit_).choice;
  double all = 0, last = 0;
  for (const TriedAccuracy& tried : choice.tried) {
    last = static_cast<double>(tried.elements) * (tried.patches + tried.rays_per_element);
    all += last;
  }
  EXPECT_LT(all, 3 * last);
}

INSTANTIATE_TEST_SUITE_P(Rooms, ChooseAccuracyInRoom, testing::Bool(),
                         [](const auto& room) { return room.param ? "Divided" : "Furnished"; });

TEST(ChooseAccuracy, TheResultIsThatOfItsOptions) {
  const LitScene lit = Furnished();
  AccuracyOptions asked;
  asked.error_percent = 5;
  const AccurateSceneLight accurate = ChooseAccuracy(lit, asked);
  const SceneLight again = ComputeSceneLight(lit, accurate.choice.options);
  EXPECT_EQ(again.light.total, accurate.light.light.total);
}

// What 400 sensors cost is their own light: a hundred of them choose, as if there were no others.
TEST(ChooseAccuracy, AHundredOfManySensorsChoose) {
  constexpr size_t kEvery = 4, kMany = 400;
  LitScene many = Furnished();
  many.sensors.clear();
  for (size_t i = 0; i < kMany; ++i) {
    const double turns = static_cast<double>(i) / kMany;
    many.sensors.push_back(
        {{2 + 1.9 * std::cos(20 * turns) * turns, 1.5 + 1.4 * std::sin(20 * turns) * turns, 1.9},
         {0, 0, 1},
         {}});
  }
  LitScene few = many;
  few.sensors.clear();
  for (size_t i = 0; i < kMany; i += kEvery) few.sensors.push_back(many.sensors[i]);
  AccuracyOptions asked;
  asked.error_percent = 5;
  const AccurateSceneLight of_many = ChooseAccuracy(many, asked), of_few = ChooseAccuracy(few, asked);
  ASSERT_EQ(of_many.choice.tried.size(), of_few.choice.tried.size());
  for (size_t i = 0; i < of_many.choice.tried.size(); ++i)
    EXPECT_EQ(of_many.choice.tried[i].change_percent, of_few.choice.tried[i].change_percent) << i;
  ASSERT_EQ(of_many.light.light.total.rows(), static_cast<Eigen::Index>(kMany));
  EXPECT_EQ(of_many.light.light.total, ComputeSceneLight(many, of_many.choice.options).light.total);
  for (size_t i = 0; i < few.sensors.size(); ++i)
    EXPECT_EQ(of_many.light.light.total.row(static_cast<Eigen::Index>(kEvery * i)),
              of_few.light.light.total.row(static_cast<Eigen::Index>(i)))
        << i;
}

// Triangles are cut alike in both directions, so that long ones have many narrow pieces: larger patches come first.
Scene OfLongTriangles(double twist_m) {
  Scene scene;
  for (const Facet& facet : support::ClosedRoom({4, 3, 2.7}).facets) {
    constexpr int kStrips = 12;
    // Corners of strip i, at one edge of the facet and at the other, which twists apart the two triangles between.
    const auto at = [&](int i, double v) {
      const double inward_m = i % kStrips == 0 || (i % 2 == 0) == (v == 0) ? 0 : twist_m;
      return Eigen::Vector3d(facet.PointAt(static_cast<double>(i) / kStrips, v) + inward_m * facet.Normal());
    };
    for (int i = 0; i < kStrips; ++i) {
      const Eigen::Vector3d near = at(i, 0), next = at(i + 1, 0), far = at(i, 1), corner = at(i + 1, 1);
      support::AddTriangle(scene, near, next - near, far - near, "wall");
      support::AddTriangle(scene, corner, far - corner, next - corner, "wall");
    }
  }
  return scene;
}

constexpr double kSmallMatrixBytes = 4e7;

AccuracyChoice ChoiceOfLongTriangles(double twist_m) {
  LitScene lit = Furnished();
  lit.scene = OfLongTriangles(twist_m);
  lit.albedo_rgb = Eigen::Matrix3Xd::Constant(3, 1, 0.5);
  AccuracyOptions options;
  options.error_percent = 5;
  options.max_matrix_bytes = kSmallMatrixBytes;
  return ChooseAccuracy(lit, options).choice;
}

TEST(ChooseAccuracy, LongTrianglesStartWithLargerPatches) {
  const AccuracyChoice choice = ChoiceOfLongTriangles(0.05);
  EXPECT_GT(choice.tried.front().patch_size_m, AccuracyOptions{}.coarsest_patch_m);
  // Patches that lie partly behind others are halved, which the first size does not count.
  EXPECT_LE(8.0 * choice.tried.front().patches * choice.tried.front().elements * sizeof(float),
            1.2 * kSmallMatrixBytes);
  EXPECT_TRUE(choice.reached);
}

// Those of one plane are one facet, which is cut evenly.
TEST(ChooseAccuracy, LongTrianglesOfOnePlaneCostWhatTheFacetWould) {
  const AccuracyChoice choice = ChoiceOfLongTriangles(0);
  EXPECT_EQ(choice.tried.front().patch_size_m, AccuracyOptions{}.coarsest_patch_m);
  EXPECT_LT(choice.tried.front().patches, 150);
  EXPECT_TRUE(choice.reached);
}

TEST(ChooseAccuracy, DarkRoomsNeedFewBounces) {
  LitScene lit = Furnished();
  lit.albedo_rgb.setConstant(0.02);
  const AccuracyChoice dark = ChooseAccuracy(lit).choice;
  EXPECT_FALSE(dark.all_bounces);
  EXPECT_LE(dark.options.solver.bounces, 3);  // 0.02^3: far below a tenth of a percent
  EXPECT_LE(dark.bounces_error_percent, 0.1);
  EXPECT_TRUE(ChooseAccuracy(Furnished()).choice.all_bounces);
}

TEST(ChooseAccuracy, SaysWhenMemoryEndsIt) {
  AccuracyOptions options;
  options.error_percent = 0.01;
  options.max_patches = 2000;
  options.max_rays = 64;
  options.max_rays_per_sensor = 4096;
  const AccuracyChoice choice = ChooseAccuracy(Divided(), options).choice;
  EXPECT_FALSE(choice.reached);
  EXPECT_GT(choice.estimated_error_percent, 0.01);
  EXPECT_LE(choice.tried.back().patches, 2 * options.max_patches);  // splits beside solids come on top
  EXPECT_NE(choice.patches_because.find("memory"), std::string::npos);
}

// As if the mesh had a hundred thousand facets: no dense matrix, the same light.
TEST(SceneLight, IsTheSameFromThePairsThatRaysFind) {
  const LitScene lit = Furnished();
  SceneLightOptions options;
  options.room.patches = PatchesOfSize(0.4);
  options.room.form_factors = {256, FormFactorMethod::kMalley};
  const SceneLight dense = ComputeSceneLight(lit, options);
  options.room.max_matrix_bytes = 0;
  const SceneLight sparse = ComputeSceneLight(lit, options);
  ASSERT_FALSE(dense.room.sparse);
  ASSERT_TRUE(sparse.room.sparse);
  EXPECT_EQ(sparse.room.form_factors.element_to_patch.size(), 0);
  EXPECT_EQ(sparse.light.solver, RadiositySolver::kConjugateGradient);
  // Indirect light is constant over patches there, not over elements.
  EXPECT_LT(RelativeRmsPercent(sparse.light.total.cast<double>(), dense.light.total.cast<double>()), 0.3);
  EXPECT_NEAR(sparse.room.form_factors.escaped_fraction, dense.room.form_factors.escaped_fraction, 1e-6);
  EXPECT_THROW(Transport(sparse.room.transport, Eigen::Vector2d(0.5, 0.5)), std::invalid_argument);
}

TEST(ChooseAccuracy, WithoutSurfacesLightIsDirect) {
  const AccuracyChoice choice =
      ChooseAccuracy(Lit({}, {}, {Panel({0, 0, 2})}, {{{0, 0, 0}, {0, 0, 1}, {}}})).choice;
  EXPECT_EQ(choice.estimated_error_percent, 0);
  EXPECT_TRUE(choice.reached);
}

TEST(ChooseAccuracy, RefusesErrorsThatAreNone) {
  AccuracyOptions options;
  for (const double error : {0.0, -1.0, std::nan("")}) {
    options.error_percent = error;
    EXPECT_THROW(ChooseAccuracy(Furnished(), options), std::invalid_argument);
  }
}

TEST(RelativeRms, WeighsDarkPlacesByTheMean) {
  const Eigen::Vector2d reference(0, 200), value(1, 202);
  // Against 1 % of the mean 100 lx: 100 %; and 1 %.
  EXPECT_NEAR(RelativeRmsPercent(value, reference), std::sqrt((100.0 * 100 + 1) / 2), 1e-9);
  EXPECT_THROW(RelativeRmsPercent(value, Eigen::Vector3d::Zero()), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
