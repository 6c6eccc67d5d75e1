#include "forward/light/light_tracer.h"
#include "forward/room/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "forward/light/illuminance.h"
#include "tests/support/closed_forms.h"
#include "tests/support/office_truth.h"
#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

// By chance one in 15 000 lies beyond; a seed that does not is no choice: errors are tested below.
constexpr double kSigmas = 4;

LightTracerOptions WithPaths(int paths, uint64_t seed = 1) {
  LightTracerOptions options;
  options.paths_per_sensor = paths;
  options.seed = seed;
  return options;
}

Luminaire IsotropicAt(const Eigen::Vector3d& position, double flux_lm) {
  Luminaire lamp;
  lamp.position = position;
  lamp.distribution = Distribution::kIsotropic;
  lamp.flux_lm = flux_lm;
  return lamp;
}

// The mean over the walls of a closed room of one reflectance is rho Phi / (A (1 - rho)); with the luminaire
// in the middle of a cube all six walls are alike.
TEST(LightTracer, CubeIsAnIntegratingSphere) {
  std::mt19937_64 rng = support::TestRng();
  constexpr int kSide = 12;
  constexpr double kFluxLm = 10000, kSizeM = 4;  // CIE 171:2006, test case 5.8
  const Scene scene = support::ClosedRoom({kSizeM, kSizeM, kSizeM});
  const RayScene rays(scene);
  std::vector<Sensor> sensors;
  std::uniform_real_distribution<double> within(0, 1);
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j)
      sensors.push_back(
          {{(i + within(rng)) * kSizeM / kSide, (j + within(rng)) * kSizeM / kSide, 0}, {0, 0, 1}});
  }
  for (const double rho : {0.2, 0.5, 0.9}) {
    const TracedIlluminance traced =
        TraceIlluminance(scene, rays, {IsotropicAt({2, 2, 2}, kFluxLm)}, Eigen::VectorXd::Constant(1, rho),
                         sensors, WithPaths(1024));
    const double expected_lx = rho * kFluxLm / (6 * kSizeM * kSizeM * (1 - rho));
    const double sigma_lx = traced.indirect_sigma.norm() / (kSide * kSide);
    // Jittered sensors: where in its cell a sensor lies moves it by less than 10 % of the mean, the mean of
    // 144 by 0.1 %.
    EXPECT_NEAR(traced.indirect.mean(), expected_lx, kSigmas * sigma_lx + 0.002 * expected_lx) << rho;
    EXPECT_LT(sigma_lx, 0.005 * expected_lx) << "too noisy for the test to tell";
  }
}

TEST(LightTracer, DirectLightIsThatOfTheClosedForms) {
  const Scene empty;
  const RayScene rays(empty);
  Luminaire panel;
  panel.position = {0.3, -0.2, 2.5};
  panel.shape = LuminaireShape::kRectangle;
  panel.size_m = {1.2, 0.6};
  panel.flux_lm = 3000;
  Luminaire disc = panel;
  disc.shape = LuminaireShape::kDisc;
  disc.size_m = {0.8, 0};
  const Luminaire point = IsotropicAt({1, 1, 2}, 1000);
  const std::vector<Sensor> sensors = {{{0, 0, 0}, {0, 0, 1}}, {{0.3, -0.2, 0.8}, {0, 0, 1}}};
  const TracedIlluminance traced =
      TraceIlluminance(empty, rays, {panel, disc, point}, Eigen::VectorXd(), sensors);
  for (Eigen::Index s = 0; s < 2; ++s) {
    const Eigen::Vector3d& p = sensors[static_cast<size_t>(s)].position;
    const double rectangle_lx = support::LambertianRectangleLx(3000, panel.position, 1.2, 0.6, p);
    EXPECT_NEAR(traced.direct(s, 0), rectangle_lx, kSigmas * traced.direct_sigma(s, 0));
    EXPECT_LT(traced.direct_sigma(s, 0), 1e-3 * rectangle_lx);
    EXPECT_NEAR(traced.direct(s, 2), support::PointLx(1000, support::IsotropicCdPerLm, point.position, p),
                1e-9);
  }
  // On the axis of a Lambertian disc of radius a at distance h: E = Phi / (pi (a^2 + h^2)).
  const double disc_lx = 3000 / (support::kPi * (0.4 * 0.4 + 1.7 * 1.7));
  EXPECT_NEAR(traced.direct(1, 1), disc_lx, kSigmas * traced.direct_sigma(1, 1));
  EXPECT_LT(traced.direct_sigma(1, 1), 1e-3 * disc_lx);
  EXPECT_EQ(traced.indirect.cwiseAbs().maxCoeff(), 0);
}

// Errors over sigma: mean square 1 if sigmas are right and nothing is biased. 64 seeds: its own sigma is
// sqrt(2 / 64) = 0.18, a little more for sigmas from 64 runs.
TEST(LightTracer, StandardErrorsAreHonest) {
  const Scene scene = support::ClosedRoom({4, 4, 4});
  const RayScene rays(scene);
  const std::vector<Sensor> sensors = {{{1, 1.3, 0}, {0, 0, 1}}};
  const auto trace = [&](int paths, uint64_t seed) {
    return TraceIlluminance(scene, rays, {IsotropicAt({2, 1, 3}, 1000)}, Eigen::VectorXd::Constant(1, 0.6),
                            sensors, WithPaths(paths, seed));
  };
  const double reference_lx = trace(1 << 19, 1000).indirect(0, 0);
  constexpr int kSeeds = 64;
  double squares = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const TracedIlluminance traced = trace(2048, static_cast<uint64_t>(seed));
    squares += std::pow((traced.indirect(0, 0) - reference_lx) / traced.indirect_sigma(0, 0), 2);
  }
  EXPECT_NEAR(squares / kSeeds, 1, kSigmas * 0.19);
}

TEST(LightTracer, RepeatsForASeedAndOnlyForIt) {
  const Scene scene = support::ClosedRoom({3, 3, 3});
  const RayScene rays(scene);
  const auto trace = [&](uint64_t seed) {
    return TraceIlluminance(scene, rays, {IsotropicAt({1, 1, 2}, 1000)}, Eigen::VectorXd::Constant(1, 0.5),
                            {{{1, 1, 0}, {0, 0, 1}}}, WithPaths(1024, seed));
  };
  EXPECT_EQ(trace(5).indirect, trace(5).indirect);
  EXPECT_NE(trace(5).indirect, trace(6).indirect);
}

// Patches, form factors and shares of visibility against none of these. 1 %: 256 rays an element and elements
// of 0.1 m, as in office_forward_test.
TEST(LightTracer, AgreesWithRadiosityInTheOffice) {
  const nlohmann::json truth = support::OfficeTruth();
  std::vector<Luminaire> lamps;
  for (const nlohmann::json& lamp : truth.at("lamps")) lamps.push_back(support::OfficeLuminaire(lamp));
  const std::vector<Sensor> sensors = support::OfficeSensors(support::OfficeTable("luxmeter.csv"), 8);
  const Room room = MakeRoom(ReadScene(support::kOfficeFolder + "room.obj"));
  Eigen::VectorXd albedo(static_cast<Eigen::Index>(room.scene.materials.size()));
  for (Eigen::Index m = 0; m < albedo.size(); ++m)
    albedo[m] = truth.at("materials").at(room.scene.materials[static_cast<size_t>(m)]).at(1);
  const Receivers receivers = MakeReceivers(room, {}, sensors);
  const Illuminance radiosity =
      ComputeIlluminance(room, receivers, ComputeVisibility(room, receivers, lamps), lamps, albedo);
  const TracedIlluminance traced = TraceIlluminance(room.scene, room.rays, lamps, albedo, sensors);
  double worst_percent = 0, largest_sigma_percent = 0;
  for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(lamps.size()); ++k) {
    const double flux_lm = lamps[static_cast<size_t>(k)].flux_lm;
    for (Eigen::Index s = 0; s < 8; ++s) {
      const double total_lx = flux_lm * radiosity.total(s, k), direct_lx = flux_lm * radiosity.direct(s, k);
      const double indirect_sigma = traced.indirect_sigma(s, k), direct_sigma = traced.direct_sigma(s, k);
      EXPECT_NEAR(traced.indirect(s, k), total_lx - direct_lx, kSigmas * indirect_sigma + 0.01 * total_lx)
          << lamps[static_cast<size_t>(k)].id << " L" << s + 1;
      EXPECT_NEAR(traced.direct(s, k) + traced.indirect(s, k), total_lx,
                  kSigmas * std::hypot(indirect_sigma, direct_sigma) + 0.01 * total_lx)
          << lamps[static_cast<size_t>(k)].id << " L" << s + 1;
      // Less than what patches may cost, or the paths would not tell.
      EXPECT_LT(std::hypot(indirect_sigma, direct_sigma), 0.009 * total_lx)
          << "too noisy for the test to tell";
      largest_sigma_percent =
          std::max(largest_sigma_percent, 100 * std::hypot(indirect_sigma, direct_sigma) / total_lx);
      worst_percent = std::max(worst_percent,
                               100 * std::abs((traced.direct(s, k) + traced.indirect(s, k)) / total_lx - 1));
    }
  }
  std::printf("worst difference of radiosity from the light tracer %.2f %%, whose largest sigma is %.2f %%\n",
              worst_percent, largest_sigma_percent);
}

TEST(LightTracer, OptionsAreChecked) {
  const Scene scene = support::ClosedRoom({3, 3, 3});
  const RayScene rays(scene);
  const auto trace = [&](double rho, const LightTracerOptions& options) {
    return TraceIlluminance(scene, rays, {}, Eigen::VectorXd::Constant(1, rho), {}, options);
  };
  EXPECT_NO_THROW(trace(0.5, {}));
  EXPECT_THROW(trace(1, {}), std::invalid_argument);
  EXPECT_THROW(trace(std::nan(""), {}), std::invalid_argument);
  EXPECT_THROW(trace(0.5, WithPaths(10)), std::invalid_argument);
  EXPECT_THROW(TraceIlluminance(scene, rays, {}, Eigen::VectorXd(), {}), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
