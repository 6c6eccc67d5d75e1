#include "forward/light/light_tracer.h"
#include "forward/mesh/mesh_file.h"
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

// Half of the peak at 10 degrees.
Luminaire SpotAt(const Eigen::Vector3d& position, const Eigen::Vector3d& aim, double flux_lm) {
  Luminaire spot = IsotropicAt(position, flux_lm);
  spot.distribution = Distribution::kCosinePower;
  spot.cosine_exponent = 45;
  spot.aim = aim.normalized();
  return spot;
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
  const std::vector<Luminaire> luminaires = {IsotropicAt({2, 1, 3}, 1000),
                                             SpotAt({2, 1, 3}, {0.6, 0.3, -0.5}, 1000)};
  const auto trace = [&](int paths, uint64_t seed) {
    return TraceIlluminance(scene, rays, luminaires, Eigen::VectorXd::Constant(1, 0.6), sensors,
                            WithPaths(paths, seed));
  };
  const TracedIlluminance reference = trace(1 << 19, 1000);
  constexpr int kSeeds = 64;
  Eigen::Array2d squares = Eigen::Array2d::Zero();
  for (int seed = 0; seed < kSeeds; ++seed) {
    const TracedIlluminance traced = trace(2048, static_cast<uint64_t>(seed));
    squares +=
        ((traced.indirect - reference.indirect).array() / traced.indirect_sigma.array()).square().transpose();
  }
  EXPECT_NEAR(squares[0] / kSeeds, 1, kSigmas * 0.19) << "isotropic";
  EXPECT_NEAR(squares[1] / kSeeds, 1, kSigmas * 0.19) << "spot";
}

// The pool on the floor, the only surface that reflects, as seen from the ceiling:
//   E = rho Phi int I(w) h^2 / (pi d^4) dw        h: height of the room, d: from the sensor to where w meets the floor
TEST(LightTracer, ASpotsPoolIsThatOfTheIntegral) {
  constexpr double kFluxLm = 500, kHeightM = 2.5, kLampM = 2.2, kRho = 0.4;
  const Scene scene =
      support::ClosedRoom({4, 4, kHeightM}, {"black", "black", "black", "black", "floor", "black"});
  const RayScene rays(scene);
  const Luminaire spot = SpotAt({1.7, 2.1, kLampM}, {0, 0, -1}, kFluxLm);
  const std::vector<Sensor> sensors = {{{1.5, 2.4, kHeightM - 1e-4}, {0, 0, -1}},
                                       {{3.6, 0.5, kHeightM - 1e-4}, {0, 0, -1}}};
  Eigen::VectorXd albedo(2);
  albedo << 0, kRho;
  const TracedIlluminance traced = TraceIlluminance(scene, rays, {spot}, albedo, sensors);
  for (Eigen::Index s = 0; s < 2; ++s) {
    constexpr int kSteps = 400;
    double expected_lx = 0;
    for (int i = 0; i < kSteps; ++i) {
      // The midpoint rule over cos(gamma): 1e-5. Within 40 degrees, all of it meets the floor; beyond lies 1e-5 of the light.
      const double cosine = 1 - (1 - std::cos(40 * support::kPi / 180)) * (i + 0.5) / kSteps;
      const double band_sr = (1 - std::cos(40 * support::kPi / 180)) * 2 * support::kPi / kSteps;
      const double radius_m = kLampM * std::tan(std::acos(cosine));
      for (int j = 0; j < kSteps; ++j) {
        const double turn = 2 * support::kPi * (j + 0.5) / kSteps;
        const Eigen::Vector3d y(1.7 + radius_m * std::cos(turn), 2.1 + radius_m * std::sin(turn), 0);
        const double d2 = (sensors[static_cast<size_t>(s)].position - y).squaredNorm();
        expected_lx += kRho * kFluxLm * IntensityPerLumen(spot, cosine).cd_per_lm * kHeightM * kHeightM /
                       (support::kPi * d2 * d2) * band_sr / kSteps;
      }
    }
    EXPECT_NEAR(traced.indirect(s, 0), expected_lx,
                kSigmas * traced.indirect_sigma(s, 0) + 1e-3 * expected_lx);
    EXPECT_LT(traced.indirect_sigma(s, 0), 1e-3 * expected_lx) << "too noisy for the test to tell";
  }
}

// Whatever the distribution, the mean over all walls of what is reflected is rho Phi / (A (1 - rho)).
TEST(LightTracer, ASpotsLightIsKept) {
  std::mt19937_64 rng = support::TestRng();
  constexpr int kSide = 8;
  constexpr double kFluxLm = 1000, kSizeM = 4, kRho = 0.6;
  const Scene scene = support::ClosedRoom({kSizeM, kSizeM, kSizeM});
  const RayScene rays(scene);
  std::uniform_real_distribution<double> within(0, 1);
  std::vector<Sensor> sensors;
  for (const Facet& facet : scene.facets) {
    for (int i = 0; i < kSide * kSide; ++i)
      sensors.push_back({facet.PointAt((i / kSide + within(rng)) / kSide, (i % kSide + within(rng)) / kSide),
                         facet.Normal()});
  }
  const TracedIlluminance traced =
      TraceIlluminance(scene, rays, {SpotAt({1.5, 1.2, 3}, {0.7, 0.2, -0.6}, kFluxLm)},
                       Eigen::VectorXd::Constant(1, kRho), sensors, WithPaths(1024));
  const double expected_lx = kRho * kFluxLm / (6 * kSizeM * kSizeM * (1 - kRho));
  const double sigma_lx = traced.indirect_sigma.norm() / static_cast<double>(sensors.size());
  // Where in its cell a sensor lies: as for the isotropic luminaire.
  EXPECT_NEAR(traced.indirect.mean(), expected_lx, kSigmas * sigma_lx + 0.002 * expected_lx);
  EXPECT_LT(sigma_lx, 0.002 * expected_lx) << "too noisy for the test to tell";
}

// A black plate hides the pool from the sensor; one over the pool keeps the light from the floor; its back reflects nothing.
TEST(LightTracer, PlatesHideASpotsPool) {
  const auto indirect_lx = [](const Eigen::Vector3d& corner, const std::string& material) {
    Scene scene = support::ClosedRoom({4, 4, 2.5}, {"black", "black", "black", "black", "floor", "black"});
    support::MaterialIndex(scene, "plate");
    // It faces down.
    support::AddParallelogram(scene, corner, {0, 1.6, 0}, {1.6, 0, 0}, material);
    Eigen::VectorXd albedo(3);
    albedo << 0, 0.5, 0.9;
    return TraceIlluminance(scene, RayScene(scene), {SpotAt({1, 2, 2.3}, {0, 0, -1}, 500)}, albedo,
                            {{{3.2, 2, 2.4999}, {0, 0, -1}}}, WithPaths(8192))
        .indirect(0, 0);
  };
  EXPECT_GT(indirect_lx({0.2, 1.2, 2.45}, "black"), 1) << "a plate above the luminaire";
  EXPECT_LT(indirect_lx({2.4, 1.2, 2.4}, "black"), 1e-6)
      << "a plate below the sensor, as large as hides the room";
  EXPECT_LT(indirect_lx({0.2, 1.2, 1}, "plate"), 0.02) << "a plate below the luminaire";
}

// There densities round to 0.
TEST(LightTracer, PlacesInAnEdgeHaveANumber) {
  const Scene scene = support::ClosedRoom({4, 4, 4});
  std::vector<Sensor> sensors;
  for (const double off_m : {0.0, 1e-12, 1e-9, 1e-7, 1e-5}) sensors.push_back({{off_m, 1.3, 0}, {0, 0, 1}});
  const TracedIlluminance traced = TraceIlluminance(
      scene, RayScene(scene), {IsotropicAt({2, 1, 3}, 1000), SpotAt({2, 1, 3}, {-0.6, 0.3, -0.5}, 1000)},
      Eigen::VectorXd::Constant(1, 0.6), sensors, WithPaths(4096));
  EXPECT_TRUE(traced.indirect.allFinite());
  EXPECT_TRUE(traced.indirect_sigma.allFinite());
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
