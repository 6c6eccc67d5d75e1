// Three states of two luminaires over a wall, by closed forms: P, Q and both; a third, R, on the switch of Q where a test says so. Photos of four views, 0.3 % of noise.
#include "inverse/observe/as_if/states_as_if.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using testing::HasSubstr;

constexpr int kElements = 200;

Patches Wall() {
  Patches patches;
  patches.elements.resize(kElements);
  for (int e = 0; e < kElements; ++e) patches.elements[static_cast<size_t>(e)].patch = e / 10;
  return patches;
}

// Light of luminaire k, 2 m before the wall, on element e: h^2 / (h^2 + d^2)^2.
double Light(int e, int k) {
  const double h = 2, d = 0.02 * e - std::array{1.0, 3.0, 2.0}.at(static_cast<size_t>(k));
  return h * h / std::pow(h * h + d * d, 2);
}

// `lit`: what was on, by state.
std::vector<Observation> Photos(const std::vector<Eigen::VectorXd>& lit) {
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<double> normal;
  std::vector<Observation> observations;
  for (int v = 0; v < 4; ++v) {
    for (size_t s = 0; s < lit.size(); ++s) {
      for (int e = 0; e < kElements; ++e) {
        Observation o;
        o.element = e;
        o.view = v;
        o.state = static_cast<int>(s);
        double light = 0;
        for (Eigen::Index k = 0; k < lit[s].size(); ++k) light += lit[s][k] * Light(e, static_cast<int>(k));
        // Gloss and cameras differ from view to view: light adds in each.
        o.relative_luminance = (1 + 0.1 * v) * light * (1 + 0.003 * normal(rng));
        o.variance = std::pow(0.003 * o.relative_luminance, 2);
        observations.push_back(o);
      }
    }
  }
  return observations;
}

const std::vector<Eigen::VectorXd> kRight{Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1),
                                          Eigen::Vector2d(1, 1)};

StateTable Table(const std::vector<Eigen::VectorXd>& dimming) {
  return {{"p", "q", "all"}, {"P", "Q"}, dimming};
}

TEST(StatesAsIf, ARightTableIsLeftAlone) {
  EXPECT_TRUE(FindStatesAsIf(Wall(), Photos(kRight), Table(kRight)).empty());
  EXPECT_TRUE(FindStatesAsIf(Wall(), {}, Table(kRight)).empty());
}

TEST(StatesAsIf, TheOtherLuminaireIsMissing) {
  std::vector<Eigen::VectorXd> given = kRight;
  given[2] = Eigen::Vector2d(0, 1);
  const std::vector<StateExplanation> found = FindStatesAsIf(Wall(), Photos(kRight), Table(given));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].as_if, "P was on at 1.00 in state all, where [states] has it off");
  EXPECT_NEAR(found[0].dimming[2][0], 1, 0.01);  // 0.3 % of noise in each of many photos
  EXPECT_EQ(found[0].dimming[0], kRight[0]);
  EXPECT_LT(found[0].difference, 0.005);
  EXPECT_THAT(found[0].remedy, HasSubstr("for P in all of [states]"));
}

TEST(StatesAsIf, NoValueIsAboveAllThatALuminaireGives) {
  std::vector<Eigen::VectorXd> given = kRight;
  given[0] = Eigen::Vector2d(1, 1);  // Q was off in p; with Q at 2 in all it would add up, too
  const std::vector<StateExplanation> found = FindStatesAsIf(Wall(), Photos(kRight), Table(given));
  ASSERT_EQ(found.size(), 1u) << InWords(found);
  EXPECT_EQ(found[0].as_if, "Q was off in state p, where [states] has 1.00");
}

TEST(StatesAsIf, DimmersAreNoMoreExactThanATenth) {
  std::vector<Eigen::VectorXd> lit = kRight;
  lit[2] = Eigen::Vector2d(0.93, 1);
  EXPECT_TRUE(FindStatesAsIf(Wall(), Photos(lit), Table(kRight)).empty());
  EXPECT_FALSE(StatesByThemselves(Wall(), Photos(lit), Table(kRight)));
}

// No value of Q and R alike explains that R alone is off with P.
TEST(StatesAsIf, WhatNoValueExplainsIsSaid) {
  const std::vector<Eigen::VectorXd> table{Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 1),
                                           Eigen::Vector3d(1, 1, 1)};
  std::vector<Eigen::VectorXd> lit = table;
  lit[2] = Eigen::Vector3d(1, 1, 0);
  const StateTable given{{"p", "qr", "all"}, {"P", "Q", "R"}, table};
  EXPECT_TRUE(FindStatesAsIf(Wall(), Photos(lit), given).empty());
  const std::optional<StateExplanation> found = StatesByThemselves(Wall(), Photos(lit), given);
  ASSERT_TRUE(found);
  EXPECT_GT(found->difference_as_given, 0.05);
  EXPECT_THAT(InWords({*found}), HasSubstr("no value of the table explains that"));
  EXPECT_EQ(found->dimming[1], Eigen::Vector3d(0, 1, 0)) << "each state by itself";
  EXPECT_FALSE(StatesByThemselves(Wall(), Photos(table), given));
}

TEST(StatesAsIf, TablesOfOtherSizesAreRefused) {
  StateTable table = Table(kRight);
  table.luminaires.push_back("R");
  EXPECT_THROW(FindStatesAsIf(Wall(), Photos(kRight), table), std::invalid_argument);
  table = Table({kRight[0], kRight[1]});
  table.states.pop_back();
  EXPECT_THROW(FindStatesAsIf(Wall(), Photos(kRight), table), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
