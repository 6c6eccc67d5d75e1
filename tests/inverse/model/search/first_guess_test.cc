#include "inverse/model/internal/search/first_guess.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "forward/light/light_tracer.h"
#include "forward/luminaire/luminaire_parts.h"
#include "inverse/model/internal/measured_indirect.h"
#include "tests/support/closed_forms.h"
#include "tests/support/inverse/cube_photos.h"
#include "tests/support/inverse/plane_readings.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr double kFluxLm = 800;
const Eigen::Vector3d kLamp(0.33, -0.41, 1.27);  // on no grid

// Two planes of sensors 2 m wide under the lamp, in no room.
LightData ReadingsOf(double (*cd_per_lm)(double), double relative_noise,
                     const Eigen::Vector3d& lamp = kLamp) {
  std::mt19937_64 rng = support::TestRng();
  LightData data;
  data.dimming = {Eigen::VectorXd::Ones(1)};
  for (const double height : {0.0, 0.3}) {
    for (const Reading& reading : support::ReadAt(
             support::PlanePoints(7, 2, height),
             [&](const Eigen::Vector3d& p) { return support::PointLx(kFluxLm, cd_per_lm, lamp, p); },
             relative_noise, rng)) {
      data.readings.push_back(reading);
    }
  }
  return data;
}

// The last grid has steps of 0.4 / 2^3 m. The best of its places need not be the nearest, but is a neighbour
// of the truth.
const double kGridDiagonalM = std::sqrt(3.) * 0.05;

TEST(GuessLuminaires, FindsAnIsotropicPointAmongItsReadings) {
  const Room room = MakeRoom(Scene{});
  const FirstGuess guess = GuessLuminaires(room, ReadingsOf(support::IsotropicCdPerLm, 0));
  EXPECT_TRUE(guess.separable);
  ASSERT_EQ(guess.luminaires.size(), 1u);
  ASSERT_TRUE(guess.luminaires[0].found);
  EXPECT_LT((guess.luminaires[0].position - kLamp).norm(), kGridDiagonalM)
      << guess.luminaires[0].position.transpose();
  EXPECT_EQ(guess.luminaires[0].distribution, Distribution::kIsotropic);
}

TEST(GuessLuminaires, FindsALambertianPointAmongItsReadings) {
  const Room room = MakeRoom(Scene{});
  const FirstGuess guess = GuessLuminaires(room, ReadingsOf(support::LambertianCdPerLm, 0));
  ASSERT_EQ(guess.luminaires.size(), 1u);
  ASSERT_TRUE(guess.luminaires[0].found);
  EXPECT_LT((guess.luminaires[0].position - kLamp).norm(), kGridDiagonalM)
      << guess.luminaires[0].position.transpose();
  EXPECT_EQ(guess.luminaires[0].distribution, Distribution::kCosinePower);
  EXPECT_EQ(guess.luminaires[0].cosine_exponent, 1);
  // E goes with h^-2: the flux is off by twice the height's relative error, a diagonal at most.
  EXPECT_NEAR(guess.luminaires[0].flux / kFluxLm, 1, 2 * kGridDiagonalM / (kLamp.z() - 0.3));
}

// Wherever the lamp hangs in relation to the coarse grid, where a wrong lobe may win.
TEST(GuessLuminaires, FindsALambertianPointAnywhere) {
  const Room room = MakeRoom(Scene{});
  std::mt19937_64 rng = support::TestRng();
  std::uniform_real_distribution<double> offset(-0.7, 0.7);
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector3d lamp(offset(rng), offset(rng), 1.3 + 0.4 * offset(rng));
    const FirstGuess guess = GuessLuminaires(room, ReadingsOf(support::LambertianCdPerLm, 0, lamp));
    ASSERT_TRUE(guess.luminaires.at(0).found);
    EXPECT_LT((guess.luminaires[0].position - lamp).norm(), kGridDiagonalM) << lamp.transpose();
    EXPECT_EQ(guess.luminaires[0].cosine_exponent, 1);
  }
}

TEST(GuessLuminaires, StandsSomeNoise) {
  const Room room = MakeRoom(Scene{});
  const FirstGuess guess = GuessLuminaires(room, ReadingsOf(support::LambertianCdPerLm, 0.03));
  ASSERT_TRUE(guess.luminaires.at(0).found);
  EXPECT_LT((guess.luminaires[0].position - kLamp).norm(),
            0.4);  // the first grid: the valley that a fit starts from
}

// Two lamps, each read in its own and both together.
LightData TwoLamps(const std::vector<Eigen::VectorXd>& dimming) {
  std::mt19937_64 rng = support::TestRng();
  LightData data;
  data.dimming = dimming;
  const Eigen::Vector3d other(-0.62, 0.57, 1.41);
  for (size_t s = 0; s < dimming.size(); ++s) {
    const auto lux = [&](const Eigen::Vector3d& p) {
      return dimming[s][0] * support::PointLx(kFluxLm, support::LambertianCdPerLm, kLamp, p) +
             dimming[s][1] * support::PointLx(500, support::LambertianCdPerLm, other, p);
    };
    for (const double height : {0.0, 0.3}) {
      for (const Reading& r :
           support::ReadAt(support::PlanePoints(7, 2, height), lux, 0, rng, static_cast<int>(s))) {
        data.readings.push_back(r);
      }
    }
  }
  return data;
}

TEST(GuessLuminaires, SumsOfLampsAreTakenApart) {
  const Room room = MakeRoom(Scene{});
  const FirstGuess guess = GuessLuminaires(room, TwoLamps({Eigen::Vector2d(1, 1), Eigen::Vector2d(0.3, 1)}));
  EXPECT_TRUE(guess.separable);
  ASSERT_EQ(guess.luminaires.size(), 2u);
  ASSERT_TRUE(guess.luminaires[0].found && guess.luminaires[1].found);
  EXPECT_LT((guess.luminaires[0].position - kLamp).norm(), kGridDiagonalM);
  EXPECT_LT((guess.luminaires[1].position - Eigen::Vector3d(-0.62, 0.57, 1.41)).norm(), kGridDiagonalM);
}

// Nothing tells which is which; that there are two places is in the light itself.
TEST(GuessLuminaires, LampsThatAreAlwaysOnTogetherAreFoundTogether) {
  const Room room = MakeRoom(Scene{});
  const FirstGuess guess =
      GuessLuminaires(room, TwoLamps({Eigen::Vector2d(1, 1), Eigen::Vector2d(0.5, 0.5)}));
  EXPECT_TRUE(guess.separable);
  EXPECT_EQ(guess.groups, std::vector<std::vector<int>>({{0, 1}}));
  ASSERT_EQ(guess.luminaires.size(), 2u);
  ASSERT_TRUE(guess.luminaires[0].found && guess.luminaires[1].found);
  // In the order of x. Each is placed beside what the grid leaves of the other: twice the step.
  EXPECT_LT((guess.luminaires[0].position - Eigen::Vector3d(-0.62, 0.57, 1.41)).norm(), 2 * kGridDiagonalM);
  EXPECT_LT((guess.luminaires[1].position - kLamp).norm(), 2 * kGridDiagonalM);
}

TEST(GuessLuminaires, ASpentBudgetLeavesThePlacesThatPhotosShow) {
  const Room room = MakeRoom(Scene{});
  LightData data = TwoLamps({Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)});
  int searched = 0;
  data.checkpoint = [&](bool) {
    if (++searched > 1) throw FitStopped("its budget is spent");
  };
  const FirstGuess guess = GuessLuminaires(room, data);
  EXPECT_TRUE(guess.separable);
  EXPECT_TRUE(guess.luminaires.at(0).found);
  EXPECT_FALSE(guess.luminaires.at(1).found) << "no photo shows it";
  SeenPlace seen;
  seen.position = Eigen::Vector3d(-0.62, 0.57, 1.41);
  seen.states = {1};
  const FirstGuess with_photos = GuessLuminaires(room, data, {}, {seen});
  EXPECT_FALSE(with_photos.luminaires.at(0).found);
  ASSERT_TRUE(with_photos.luminaires.at(1).found);
  EXPECT_EQ(with_photos.luminaires[1].position, seen.position);
}

// The first of two that are always on together is known: the other is found beside it.
TEST(GuessLuminaires, AKnownPlaceIsKept) {
  const Room room = MakeRoom(Scene{});
  const FirstGuess guess = GuessLuminaires(room, TwoLamps({Eigen::Vector2d(1, 1)}), {kLamp, std::nullopt});
  ASSERT_TRUE(guess.luminaires.at(0).found && guess.luminaires.at(1).found);
  EXPECT_EQ(guess.luminaires[0].position, kLamp);
  EXPECT_LT((guess.luminaires[1].position - Eigen::Vector3d(-0.62, 0.57, 1.41)).norm(), kGridDiagonalM);
}

TEST(GuessLuminaires, StatesThatNobodyReadDoNotHelp) {
  const Room room = MakeRoom(Scene{});
  LightData data = TwoLamps({Eigen::Vector2d(1, 1)});
  data.dimming.push_back(Eigen::Vector2d(1, 0));
  EXPECT_EQ(GuessLuminaires(room, data).groups, std::vector<std::vector<int>>({{0, 1}}));
  EXPECT_FALSE(GuessLuminaires(room, {}).separable);
}

// Three sums of three lamps in which two are told apart by nothing but the third.
TEST(GuessLuminaires, SumsThatDoNotTellGroupsApartAreNamed) {
  const Room room = MakeRoom(Scene{});
  const FirstGuess guess = GuessLuminaires(room, TwoLamps({Eigen::Vector2d(1, 0.5)}));
  EXPECT_EQ(guess.groups.size(), 1u);  // one state: one proportion
  LightData data = TwoLamps({Eigen::Vector2d(1, 1)});
  data.dimming = {Eigen::Vector4d(1, 0, 1, 0), Eigen::Vector4d(0, 1, 0, 1), Eigen::Vector4d(1, 1, 0, 0),
                  Eigen::Vector4d(0, 0, 1, 1)};
  for (Reading& reading : std::vector<Reading>(data.readings)) {
    for (int s = 1; s < 4; ++s) {
      data.readings.push_back(reading);
      data.readings.back().state = s;
    }
  }
  const FirstGuess crossed = GuessLuminaires(room, data);
  EXPECT_FALSE(crossed.separable);
  EXPECT_NE(crossed.message, "");
  for (const LuminaireGuess& luminaire : crossed.luminaires) EXPECT_FALSE(luminaire.found);
}

// Photos by the light tracer, which shares no patch with the form factors.
LightData TracedPhotos(const Room& cube, const Luminaire& lamp, double rho) {
  std::vector<Sensor> sensors;
  for (const Element& element : cube.patches.elements)
    sensors.push_back({element.center, element.normal, {}});
  LightTracerOptions options;
  options.paths_per_sensor = 1024;  // 1 % of the indirect light
  const TracedIlluminance traced =
      TraceIlluminance(cube.scene, cube.rays, {lamp}, Eigen::VectorXd::Constant(1, rho), sensors, options);
  LightData data;
  data.dimming = {Eigen::VectorXd::Ones(1)};
  for (size_t e = 0; e < sensors.size(); ++e) {
    const auto row = static_cast<Eigen::Index>(e);
    Observation o;
    o.element = static_cast<int>(e);
    o.relative_luminance = rho / support::kPi * (traced.direct(row, 0) + traced.indirect(row, 0));
    data.observations.push_back(o);
  }
  return WithMeasuredIndirect(cube, data);
}

class GuessInCube : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    cube_ = new Room(support::CubeRoom());
    lamp_.position = {1.23, 0.81, 1.37};
    lamp_.distribution = Distribution::kIsotropic;
    photos_ = TracedPhotos(*cube_, lamp_, kRho);
  }
  static void TearDownTestSuite() { delete cube_; }

  static SeenPlace SeenAt(const Eigen::Vector3d& p, const std::vector<int>& states = {0}) {
    SeenPlace place;
    place.position = p;
    place.states = states;
    return place;
  }

  static constexpr double kRho = 0.6;
  static Room* cube_;
  static Luminaire lamp_;
  static LightData photos_;
};
Room* GuessInCube::cube_ = nullptr;
Luminaire GuessInCube::lamp_;
LightData GuessInCube::photos_;

TEST_F(GuessInCube, FindsPlaceAndReflectanceInPhotos) {
  const FirstGuess guess = GuessLuminaires(*cube_, photos_);
  ASSERT_TRUE(guess.luminaires.at(0).found);
  // The first grid is 2 / 8 m here, the last a sixteenth of that.
  EXPECT_LT((guess.luminaires[0].position - lamp_.position).norm(), std::sqrt(3.) * 0.25 / 16);
  EXPECT_EQ(guess.luminaires[0].distribution, Distribution::kIsotropic);
  // Of a place half a step off, the direct light is wrong by a few percent.
  EXPECT_NEAR(guess.albedo[0], kRho, 0.03);
  EXPECT_NEAR(guess.luminaires[0].flux, 1, 0.1);  // both share that error
  EXPECT_EQ(guess.luminaires[0].seen_candidates, 0);
  EXPECT_TRUE(guess.luminaires[0].was_searched);
}

// Washed-out spots on the floor and the walls are bright in as many photos; the light tells them apart.
TEST_F(GuessInCube, APlaceSeenInPhotosIsUsedWhereItExplainsTheLight) {
  const Eigen::Vector3d seen = lamp_.position + Eigen::Vector3d(0.01, -0.01, 0.01);
  const std::vector<SeenPlace> places = {SeenAt({1, 1, 0.01}), SeenAt({0.4, 1.99, 1.2}), SeenAt(seen),
                                         SeenAt({1.6, 0.3, 0.74})};
  const FirstGuess guess = GuessLuminaires(*cube_, photos_, {}, places);
  ASSERT_TRUE(guess.luminaires.at(0).found);
  EXPECT_EQ(guess.luminaires[0].seen, 2);
  EXPECT_EQ(guess.luminaires[0].seen_candidates, 4);
  EXPECT_FALSE(guess.luminaires[0].was_searched);
  EXPECT_EQ(guess.luminaires[0].position, seen);
  EXPECT_EQ(guess.luminaires[0].distribution, Distribution::kIsotropic);
  EXPECT_NEAR(guess.albedo[0], kRho, 0.03);
}

// Nothing but what is no luminaire was seen: as if nothing had been.
TEST_F(GuessInCube, PlacesThatAreNoLuminairesDoNotLeadAstray) {
  const FirstGuess alone = GuessLuminaires(*cube_, photos_);
  for (const Eigen::Vector3d& wrong :
       {Eigen::Vector3d(1, 1, 0.01), Eigen::Vector3d(0.4, 1.99, 1.2), Eigen::Vector3d(1.23, 0.81, 1.9)}) {
    const FirstGuess guess = GuessLuminaires(*cube_, photos_, {}, {SeenAt(wrong)});
    ASSERT_TRUE(guess.luminaires.at(0).found);
    EXPECT_FALSE(guess.luminaires[0].seen.has_value()) << wrong.transpose();
    EXPECT_TRUE(guess.luminaires[0].was_searched);
    EXPECT_EQ(guess.luminaires[0].position, alone.luminaires.at(0).position) << wrong.transpose();
  }
}

// Two luminaires at one place, one aimed up and one down, explain a pendant's light. Of two that are on together, a place
// that photos show is one.
TEST_F(GuessInCube, OnePlaceThatIsSeenIsOneLuminaire) {
  Luminaire pendant = lamp_;
  pendant.distribution = Distribution::kMeasured;
  pendant.table = std::make_shared<IntensityTable>(TwoSidedTable(0.3));
  LightData data = TracedPhotos(*cube_, pendant, kRho);
  data.dimming = {Eigen::VectorXd::Ones(2)};
  const FirstGuess guess = GuessLuminaires(*cube_, data, {}, {SeenAt(pendant.position)});
  ASSERT_EQ(guess.luminaires.size(), 2u);
  EXPECT_FALSE(guess.luminaires[0].seen && guess.luminaires[1].seen);
}

TEST_F(GuessInCube, WhatIsBrightWithoutALuminaireIsNotIt) {
  LightData data = photos_;
  data.dimming.push_back(Eigen::VectorXd::Zero(1));
  const FirstGuess guess = GuessLuminaires(*cube_, data, {}, {SeenAt(lamp_.position, {0, 1})});
  EXPECT_EQ(guess.luminaires.at(0).seen_candidates, 0);
}

}  // namespace
}  // namespace luxfit
