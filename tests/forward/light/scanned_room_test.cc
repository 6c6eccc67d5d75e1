// The light of a scanned room beside that of the room itself.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstdio>
#include <random>
#include <vector>

#include "forward/light/choose_accuracy.h"
#include "forward/light/scene_light.h"
#include "tests/support/forward/scan_of.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

using Eigen::Vector3d;

LitScene Lit() {
  LitScene lit;
  lit.scene = support::ClosedRoom({5, 4, 2.5}, {kDefaultMaterial});
  support::AddBox(lit.scene, {Vector3d(1, 1, 0.7), Vector3d(2.6, 1.8, 0.74)}, support::Facing::kOutward,
                  {kDefaultMaterial});
  Luminaire panel;
  panel.id = "A", panel.position = {2.5, 2, 2.45}, panel.flux_lm = 3000;
  panel.shape = LuminaireShape::kRectangle, panel.size_m = {0.6, 0.6};
  lit.luminaires = {panel};
  lit.albedo_rgb = Eigen::Matrix3Xd::Constant(3, 1, 0.6);
  for (const double x : {0.5, 1.8, 4.2})
    for (const double y : {0.6, 1.4, 3.5}) lit.sensors.push_back({{x, y, 0.85}, {0, 0, 1}, {}});
  lit.sensors.push_back({{1.8, 1.4, 0.1}, {0, 0, 1}, {}});  // below the desk
  return lit;
}

Eigen::VectorXd LightOf(const LitScene& lit, const SceneLightOptions& options) {
  return ComputeSceneLight(lit, options).light.total.cast<double>().col(0);
}

TEST(ScannedRoom, HasTheLightOfTheRoom) {
  const LitScene truth = Lit();
  LitScene scanned = truth;
  std::mt19937_64 rng(11);
  scanned.scene = support::ScanOf(truth.scene, {}, rng);
  SceneLightOptions options;
  options.room.planes.emplace();
  const Eigen::VectorXd right = LightOf(truth, options), got = LightOf(scanned, options);
  const double rms = RelativeRmsPercent(got, right);
  std::printf("rms %.2f %%, worst %.2f %%\n", rms, 100 * (got.array() / right.array() - 1).abs().maxCoeff());
  EXPECT_LT(rms, 1.5);
}

// Light to an accuracy is that of the surface as it is given: triangles are merged only where they share a plane.
TEST(ScannedRoom, TrianglesOfOnePlaneAreMergedForAnAccuracy) {
  const LitScene truth = Lit();
  LitScene tiled = truth;
  support::ScanOptions exact;
  exact.bump_m = exact.jitter_m = exact.hole_share = 0;
  std::mt19937_64 rng(1);
  tiled.scene = support::ScanOf(truth.scene, exact, rng);
  AccuracyOptions accuracy;
  accuracy.error_percent = 1;
  const AccurateSceneLight got = ChooseAccuracy(tiled, accuracy);
  const AccurateSceneLight right = ChooseAccuracy(truth, accuracy);
  EXPECT_EQ(got.light.room.scene.facets.size(), 12U);
  EXPECT_LT(RelativeRmsPercent(got.light.light.total.cast<double>(), right.light.light.total.cast<double>()),
            1);
}

}  // namespace
}  // namespace luxfit
