#include "inverse/choose/internal/several_starts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "inverse/model/internal/search/first_guess.h"
#include "tests/support/closed_forms.h"
#include "tests/support/inverse/partition_readings.h"
#include "tests/support/inverse/plane_readings.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

const Eigen::Vector3d kLamp(0.7, -0.2, 0.9);
const Eigen::Vector3d kMirrored(0.7, -0.2, -0.9);

// Sensors on the plane z = 0 that look along +x and +y: light from above and from below is the same to them,
// E = Phi (n . d) / (4 pi r^3) for an isotropic point.
LightData SidewaysReadings(const std::vector<double>& heights) {
  LightData data;
  data.dimming = {Eigen::VectorXd::Ones(1)};
  for (const double height : heights) {
    for (Eigen::Vector3d p : support::PlanePoints(9, 2, height)) {
      p -= Eigen::Vector3d(1.5, 1.5, 0);
      for (const Eigen::Vector3d& n :
           {Eigen::Vector3d(Eigen::Vector3d::UnitX()), Eigen::Vector3d(Eigen::Vector3d::UnitY())}) {
        const Eigen::Vector3d d = kLamp - p;
        if (n.dot(d) <= 0.05) continue;
        const double lx = 800 * n.dot(d) / (4 * support::kPi * std::pow(d.norm(), 3));
        data.readings.push_back({{p, n, {}}, 0, lx, 0.01 * lx, true});
      }
    }
  }
  return data;
}

LightState StartAt(const Eigen::Vector3d& position) {
  LightState state = support::CosinePowerStart(position, 1);
  state.luminaires[0].distribution = Distribution::kIsotropic;
  state.free[0].exponent = false;
  return state;
}

Luminaire RivalAt(const Eigen::Vector3d& position) {
  Luminaire rival;
  rival.position = position;
  rival.distribution = Distribution::kIsotropic;
  return rival;
}

TEST(SeveralStarts, TheMirroredPlaceIsARival) {
  const Room room = MakeRoom(Scene{});
  const LightData data = SidewaysReadings({0});
  const FirstGuess guess = GuessLuminaires(room, data);
  ASSERT_TRUE(guess.luminaires.at(0).found);
  ASSERT_FALSE(guess.luminaires[0].rivals.empty());
  const SeveralStarts result =
      FitFromSeveralStarts(room, data, StartAt(guess.luminaires[0].position), {guess.luminaires[0].rivals});
  ASSERT_EQ(result.comparisons.size(), 1u);
  const StartComparison& c = result.comparisons[0];
  ASSERT_FALSE(c.rivals.empty());
  const Eigen::Vector3d kept = c.end[static_cast<size_t>(c.chosen)].position;
  const Eigen::Vector3d other = c.end[static_cast<size_t>(c.rivals[0])].position;
  EXPECT_EQ(result.state.luminaires[0].position, kept);
  const bool is_above = kept.z() > 0;
  EXPECT_LT((kept - (is_above ? kLamp : kMirrored)).norm(), 0.01) << kept.transpose();
  EXPECT_LT((other - (is_above ? kMirrored : kLamp)).norm(), 0.01) << other.transpose();
}

// A second plane of sensors: the mirrored place no longer explains the light.
TEST(SeveralStarts, StartsThatFindOnePlaceAgree) {
  const Room room = MakeRoom(Scene{});
  const LightData data = SidewaysReadings({0, 0.4});
  const SeveralStarts result =
      FitFromSeveralStarts(room, data, StartAt(kMirrored), {{RivalAt(kLamp), RivalAt({0.5, 0, 1.1})}});
  ASSERT_EQ(result.comparisons.size(), 1u);
  EXPECT_EQ(result.comparisons[0].agreeing, 3);
  EXPECT_TRUE(result.comparisons[0].rivals.empty());
  EXPECT_LT((result.state.luminaires[0].position - kLamp).norm(), 0.01);
  EXPECT_TRUE(GuessLuminaires(room, data).luminaires.at(0).rivals.empty());
}

// A start close behind a partition sees none of the light that was read and stays there.
TEST(SeveralStarts, TheBestIsKeptWhereOthersAreStuck) {
  const Room room = MakeRoom(support::PartitionScene(), {{1, 1}, {16}});
  const Eigen::Vector3d lamp(0.5, 0.2, 0.9);
  const LightData data = support::PartitionReadings(lamp, 800);
  LightState state = StartAt({-0.3, 0, 0.8});
  state.albedo = Eigen::VectorXd::Constant(3, 0.01);
  state.albedo_free.assign(3, false);
  SeveralStartsOptions options;
  options.max_outer_iterations = 4;
  const SeveralStarts result =
      FitFromSeveralStarts(room, data, state, {{RivalAt({0.7, 0.4, 1.1})}}, {}, {}, options);
  ASSERT_EQ(result.comparisons.size(), 1u);
  const StartComparison& c = result.comparisons[0];
  EXPECT_EQ(c.chosen, 1);
  EXPECT_EQ(c.agreeing, 1);
  EXPECT_TRUE(c.rivals.empty());
  EXPECT_LT(c.score[1] + c.standard_error[0], c.score[0]);
  EXPECT_LT((result.state.luminaires[0].position - lamp).norm(), 0.02);
  // Where photos show the first start, one that leaves a third less is still better.
  const ParameterPrior seen{ParameterKind::kLuminaire, 0, LuminaireQuantity::kPositionX, -0.3, 0.02};
  EXPECT_EQ(FitFromSeveralStarts(room, data, state, {{RivalAt({0.7, 0.4, 1.1})}}, {}, {seen}, options)
                .comparisons.at(0)
                .chosen,
            1);
}

TEST(SeveralStarts, WithoutRivalsNothingIsFitted) {
  const Room room = MakeRoom(Scene{});
  const LightState start = StartAt(kMirrored);
  const SeveralStarts result = FitFromSeveralStarts(room, SidewaysReadings({0}), start, {{}});
  EXPECT_TRUE(result.comparisons.empty());
  EXPECT_EQ(result.state.luminaires[0].position, kMirrored);
  EXPECT_THROW(FitFromSeveralStarts(room, SidewaysReadings({0}), start, {}), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
