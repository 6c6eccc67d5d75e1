// The guess of a room before its first photo, and what is advised by it.
#include "inverse/advise/room_guess.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scenes.h"

namespace luxfit {
namespace {

const Eigen::Vector3d kSize(6, 4, 2.8);

RoomKnowledge Nothing(const Room& room, const std::vector<std::string>& luminaires) {
  RoomKnowledge known;
  for (const std::string& id : luminaires) known.luminaires.emplace_back().luminaire.id = id;
  known.albedo.resize(room.scene.materials.size());
  return known;
}

const Assumption* Find(const RoomGuess& guess, const std::string& what) {
  for (const Assumption& one : guess.assumed) {
    if (one.what == what) return &one;
  }
  return nullptr;
}

TEST(RoomGuess, LuminairesHangSpreadUnderTheCeiling) {
  const Room room = MakeRoom(support::ClosedRoom(kSize));
  const RoomGuess guess = GuessRoom(room, Nothing(room, {"A", "B", "C", "D"}));
  ASSERT_EQ(guess.given.luminaires.size(), 4u);
  for (const Luminaire& l : guess.given.luminaires) {
    EXPECT_NEAR(l.position.z(), kSize.z() - kGuessedGapM, 1e-6) << "rays have single precision";
    EXPECT_GT(l.position.x(), 0.5);
    EXPECT_LT(l.position.x(), kSize.x() - 0.5);
    for (const Luminaire& other : guess.given.luminaires)
      EXPECT_TRUE(&l == &other || (l.position - other.position).norm() > 1) << l.id << other.id;
  }
  EXPECT_EQ(Find(guess, "place")->of, (std::vector<std::string>{"A", "B", "C", "D"}));
  const RoomGuess alone = GuessRoom(room, Nothing(room, {"A"}));
  EXPECT_NEAR((alone.given.luminaires[0].position.head<2>() - Eigen::Vector2d(3, 2)).norm(), 0, 1e-9);
}

TEST(RoomGuess, WhatIsKnownIsNotGuessed) {
  const Room room = MakeRoom(support::ClosedRoom(kSize));
  RoomKnowledge known = Nothing(room, {"A", "B"});
  known.luminaires[0].position_m = Eigen::Vector3d(1, 1, 2.5);
  known.luminaires[0].position_sigma_m = 0.2;
  known.luminaires[1].flux_lm = 1000;
  known.luminaires[1].flux_sigma_lm = 0;
  known.albedo[0] = 0.31;
  const RoomGuess guess = GuessRoom(room, known);
  EXPECT_EQ(guess.given.luminaires[0].position, Eigen::Vector3d(1, 1, 2.5));
  EXPECT_EQ(guess.given.luminaires[1].flux_lm, 1000);
  EXPECT_EQ(guess.given.albedo[0], 0.31);
  EXPECT_EQ(Find(guess, "place")->of, std::vector<std::string>{"B"});
  EXPECT_EQ(Find(guess, "flux")->of, std::vector<std::string>{"A"});
  const FitUncertainty& fit = guess.given.fit;
  EXPECT_NEAR(fit.Sigma({ParameterKind::kLuminaire, "A", LuminaireQuantity::kPositionX}), 0.2, 1e-12);
  for (const ParameterId& id : fit.parameters) {
    EXPECT_FALSE(id.kind == ParameterKind::kLogFlux && id.owner == "B") << "held";
    EXPECT_FALSE(id.kind == ParameterKind::kAlbedo && id.owner == room.scene.materials[0]) << "held";
  }
}

// Photos that tell luminaires apart come first, of each luminaire, and lumens need a reading.
TEST(RoomGuess, PhotosOfEachAloneComeFirstAndAReadingTellsLumens) {
  const Room room = MakeRoom(support::ClosedRoom(kSize));
  RoomGuess guess = GuessRoom(room, Nothing(room, {"A", "B"}));
  AdviceGiven& given = guess.given;
  given.dimming = {Eigen::Vector2d(1, 1), Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)};
  for (const AdviceView& view : ViewsToTake(room, GuessedCamera(), {})) {
    given.views.push_back(view);
    for (int state = 0; state < 3; ++state)
      given.photos.push_back({static_cast<int>(given.views.size()) - 1, state});
  }
  for (const Sensor& place : PlacesToRead(room)) given.readings.push_back({"", place, 0});
  AdviceOptions options;
  options.count = 8;
  const AdvicePlan plan = Advise(room, given, options);
  for (const SigmaChange& change : plan.now) EXPECT_FALSE(change.was_determined);
  ASSERT_GE(plan.steps.size(), 3u);
  EXPECT_TRUE(plan.steps[0].is_photo);
  EXPECT_NE(given.photos[plan.steps[0].candidate].state, 0) << "of both, it does not say which is which";
  bool has_reading = false;
  for (const AdviceStep& step : plan.steps) has_reading = has_reading || !step.is_photo;
  EXPECT_TRUE(has_reading);
  for (const SigmaChange& change : plan.steps.back().changes)
    EXPECT_TRUE(change.is_determined) << change.of.owner;
}

TEST(RoomGuess, ACountComesFromTheFloor) {
  const Room room = MakeRoom(support::ClosedRoom(kSize));
  EXPECT_EQ(GuessedCount(room, 12), 4);
  EXPECT_EQ(GuessedCount(room, 3), 3);
  EXPECT_EQ(GuessedCount(MakeRoom(Scene{}), 12), 1);
}

TEST(RoomGuess, BadInputIsRefused) {
  const Room room = MakeRoom(support::ClosedRoom(kSize));
  EXPECT_THROW(GuessRoom(MakeRoom(Scene{}), {}), std::invalid_argument);
  EXPECT_THROW(GuessRoom(room, Nothing(room, {})), std::invalid_argument);
  RoomKnowledge short_of_albedo = Nothing(room, {"A"});
  short_of_albedo.albedo.clear();
  EXPECT_THROW(GuessRoom(room, short_of_albedo), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
