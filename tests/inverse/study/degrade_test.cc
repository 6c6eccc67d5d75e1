#include "inverse/study/degrade.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

// Of 400 elements, 4 views and 3 states; 25 pixels each.
std::vector<Observation> Observations() {
  std::vector<Observation> observations;
  for (int view = 0; view < 4; ++view) {
    for (int state = 0; state < 3; ++state) {
      for (int element = 0; element < 400; ++element) {
        Observation o;
        o.element = element;
        o.view = view;
        o.state = state;
        o.pixels = 25;
        o.relative_luminance = 2;
        o.variance = 0.01;
        o.relative_rgb.setConstant(2);
        observations.push_back(o);
      }
    }
  }
  return observations;
}

TEST(Degrade, NoiseIsThatOfTheMeanOfPixels) {
  std::mt19937_64 rng = support::TestRng();
  constexpr double kPixelSigma = 0.1;
  double sum = 0, squares = 0;
  const std::vector<Observation> noisy = WithPixelNoise(Observations(), kPixelSigma, rng);
  for (const Observation& o : noisy) {
    const double relative = o.relative_luminance / 2 - 1;
    sum += relative;
    squares += relative * relative;
    // sqrt(25) = 5 times less than one pixel's, beside what was there.
    EXPECT_NEAR(o.variance, 0.01 + std::pow(2 * kPixelSigma / 5, 2), 1e-12);
    EXPECT_DOUBLE_EQ(o.relative_rgb[1], o.relative_luminance);
  }
  const double n = static_cast<double>(noisy.size());
  EXPECT_NEAR(sum / n, 0, 4 * kPixelSigma / 5 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), kPixelSigma / 5, 4 * kPixelSigma / 5 / std::sqrt(2 * n));
}

TEST(Degrade, AnExposureIsOfAWholePhoto) {
  std::mt19937_64 rng = support::TestRng();
  constexpr double kLogSigma = 0.1;
  constexpr int kDraws = 50, kPhotos = 12;
  double sum = 0, squares = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::map<std::pair<int, int>, std::set<double>> values;
    for (const Observation& o : WithExposureErrors(Observations(), kLogSigma, rng)) {
      values[{o.view, o.state}].insert(o.relative_luminance);
      EXPECT_DOUBLE_EQ(o.relative_rgb[1], o.relative_luminance);
    }
    ASSERT_EQ(values.size(), static_cast<size_t>(kPhotos));
    for (const auto& [photo, of_photo] : values) {
      ASSERT_EQ(of_photo.size(), 1u);
      const double log_gain = std::log(*of_photo.begin() / 2);
      sum += log_gain;
      squares += log_gain * log_gain;
    }
  }
  // Four standard errors of the mean and of the standard deviation.
  constexpr double kGains = kDraws * kPhotos;
  EXPECT_NEAR(sum / kGains, 0, 4 * kLogSigma / std::sqrt(kGains));
  EXPECT_NEAR(std::sqrt(squares / kGains), kLogSigma, 4 * kLogSigma / std::sqrt(2 * kGains));
}

TEST(Degrade, WhatIsDroppedIsGoneAndNothingElse) {
  std::mt19937_64 rng = support::TestRng();
  const std::vector<Observation> all = Observations();
  const std::vector<Observation> views = WithoutViews(all, 3, rng), states = WithoutStates(all, 1, rng);
  EXPECT_EQ(CountViews(all), 4);
  EXPECT_EQ(CountViews(views), 1);
  EXPECT_EQ(CountStates(views), 3);
  EXPECT_EQ(views.size(), all.size() / 4);
  EXPECT_EQ(CountStates(states), 2);
  EXPECT_EQ(CountViews(states), 4);
  EXPECT_EQ(WithoutViews(all, 0, rng).size(), all.size());
  EXPECT_THROW(WithoutViews(all, 5, rng), std::invalid_argument);
  EXPECT_THROW(WithoutStates(all, -1, rng), std::invalid_argument);
}

TEST(Degrade, TheSameGeneratorGivesTheSame) {
  std::mt19937_64 a(7), b(7);
  const std::vector<Observation> first = WithPixelNoise(Observations(), 0.1, a),
                                 second = WithPixelNoise(Observations(), 0.1, b);
  for (size_t i = 0; i < first.size(); ++i)
    EXPECT_EQ(first[i].relative_luminance, second[i].relative_luminance);
}

TEST(Degrade, TagsMoveButDoNotTurn) {
  std::mt19937_64 rng = support::TestRng();
  std::vector<SurveyedTag> survey(500);
  for (SurveyedTag& tag : survey) {
    tag.center_in_world = {1, 2, 3};
    tag.normal_in_world = {1, 0, 0};
    tag.up_in_world = {0, 0, 1};
  }
  double squares = 0;
  for (const SurveyedTag& tag : WithMovedTags(survey, 0.01, rng)) {
    squares += (tag.center_in_world - Eigen::Vector3d(1, 2, 3)).squaredNorm();
    EXPECT_EQ(tag.normal_in_world, Eigen::Vector3d::UnitX());
  }
  EXPECT_NEAR(std::sqrt(squares / 1500), 0.01, 4 * 0.01 / std::sqrt(3000));
}

// A room with a table of two boards that touch, and a shelf by itself.
Scene Furnished() {
  Scene scene = support::ClosedRoom({4, 3, 2.5}, {"wall", "wall", "wall", "wall", "floor", "ceiling"});
  support::AddParallelogram(scene, {1, 1, 0.8}, {1, 0, 0}, {0, 1, 0}, "table");
  support::AddParallelogram(scene, {1, 1, 0.1}, {1, 0, 0}, {0, 0, 0.7}, "table");
  support::AddParallelogram(scene, {3, 2, 1.5}, {0.5, 0, 0}, {0, 0.5, 0}, "shelf");
  return scene;
}

TEST(Degrade, WhatIsRemovedTakesItsMaterialAlong) {
  std::mt19937_64 rng = support::TestRng();
  const Scene whole = Furnished(), bare = WithoutPieces(whole, 2, rng);
  EXPECT_EQ(bare.facets.size(), 6u);
  EXPECT_EQ(bare.materials, (std::vector<std::string>{"wall", "floor", "ceiling"}));
  for (size_t f = 0; f < bare.facets.size(); ++f) {
    EXPECT_EQ(bare.materials[static_cast<size_t>(bare.facets[f].material)],
              whole.materials[static_cast<size_t>(whole.facets[f].material)]);
  }
  EXPECT_THROW(WithoutPieces(whole, 3, rng), std::invalid_argument);
}

TEST(Degrade, TheNearestTwoLuminairesCloseIn) {
  std::vector<Luminaire> lamps(3);
  lamps[0].position = {0, 0, 2};
  lamps[1].position = {5, 0, 2};
  lamps[2].position = {3, 0, 2};
  const std::vector<Luminaire> moved = WithLuminairesTogether(lamps, 0.5);
  EXPECT_EQ(moved[0].position, lamps[0].position);
  EXPECT_NEAR((moved[1].position - Eigen::Vector3d(4.25, 0, 2)).norm(), 0, 1e-12);
  EXPECT_NEAR((moved[2].position - Eigen::Vector3d(3.75, 0, 2)).norm(), 0, 1e-12);
  lamps.resize(1);
  EXPECT_THROW(WithLuminairesTogether(lamps, 0.5), std::invalid_argument);
}

TEST(Degrade, AlbedoGoesTowardsWhiteAndNeverBeyond) {
  const Eigen::Vector3d albedo(0.1, 0.5, 0.97);
  EXPECT_NEAR((WithRaisedAlbedo(albedo, 0) - albedo).norm(), 0, 1e-12);
  EXPECT_NEAR((WithRaisedAlbedo(albedo, 1) - Eigen::Vector3d(0.95, 0.95, 0.97)).norm(), 0, 1e-12);
  EXPECT_THROW(WithRaisedAlbedo(albedo, 1.1), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
