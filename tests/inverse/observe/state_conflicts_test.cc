#include "inverse/observe/state_conflicts.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace luxfit {
namespace {

// Two luminaires 2 m apart; A is on in states 0 and 2, B in 1 and 2.
class StateConflicts : public testing::Test {
 protected:
  StateConflicts() : luminaires_(2) {
    luminaires_[0].position = {1, 1, 2.8};
    luminaires_[1].position = {3, 1, 2.8};
  }

  static SeenPlace Place(const Eigen::Vector3d& position, std::vector<int> states,
                         std::vector<int> dark_states) {
    SeenPlace place;
    place.position = position;
    place.sigma_m = 0.02;
    place.states = std::move(states);
    place.dark_states = std::move(dark_states);
    place.views = 3;
    return place;
  }

  // Returns "luminaire state bright" of each.
  std::vector<std::string> Found(const std::vector<SeenPlace>& seen) const {
    std::vector<std::string> words;
    for (const StateConflict& c : FindStateConflicts(seen, luminaires_, dimming_))
      words.push_back(std::to_string(c.luminaire) + " " + std::to_string(c.state) +
                      (c.is_bright ? " bright" : " dark"));
    return words;
  }

  std::vector<Luminaire> luminaires_;
  std::vector<Eigen::VectorXd> dimming_ = {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1),
                                           Eigen::Vector2d(0.5, 1)};
};

using Words = std::vector<std::string>;

TEST_F(StateConflicts, WhatTheTableSaysIsNone) {
  EXPECT_EQ(Found({Place({1.01, 1, 2.79}, {0, 2}, {1}), Place({3, 1.01, 2.8}, {1, 2}, {0})}), Words{});
  EXPECT_EQ(Found({}), Words{});
}

TEST_F(StateConflicts, BrightWhereItIsOffIsNamed) {
  EXPECT_EQ(Found({Place({1.01, 1, 2.79}, {0, 1, 2}, {})}), Words{"0 1 bright"});
}

TEST_F(StateConflicts, DarkWhereItIsOnIsNamed) {
  EXPECT_EQ(Found({Place({3, 1, 2.8}, {1}, {0, 2})}), Words{"1 2 dark"});
  // At half of its light, A may be too weak for the exposure.
  EXPECT_EQ(Found({Place({1, 1, 2.8}, {0}, {1, 2})}), Words{});
}

TEST_F(StateConflicts, PlacesOfOthersSayNothing) {
  EXPECT_EQ(Found({Place({1.5, 1, 2.8}, {0, 1, 2}, {})}), Words{}) << "0.5 m off, 0.02 m known";
  EXPECT_EQ(Found({Place({1, 1, 2.8}, {1}, {})}), Words{}) << "bright only where A is off: something else";
  luminaires_[1].position = {1.03, 1, 2.8};
  EXPECT_EQ(Found({Place({1.01, 1, 2.8}, {0, 1, 2}, {})}), Words{}) << "B hangs there, too";
  SeenPlace vague = Place({1, 1, 2.8}, {0, 1, 2}, {});
  vague.sigma_m = 0.3;
  luminaires_[1].position = {3, 1, 2.8};
  EXPECT_EQ(Found({vague}), Words{});
}

}  // namespace
}  // namespace luxfit
