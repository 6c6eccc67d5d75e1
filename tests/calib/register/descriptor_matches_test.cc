#include "calib/register/internal/descriptor_matches.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

// Few bins are large, as in SIFT's; norm 512 but for rounding.
DescriptorColumns RandomDescriptors(Eigen::Index count, std::mt19937_64& rng) {
  std::exponential_distribution<float> bin(1);
  DescriptorColumns descriptors(kDescriptorSize, count);
  for (float& value : descriptors.reshaped()) value = bin(rng) * bin(rng);
  for (auto descriptor : descriptors.colwise())
    descriptor = (512 * descriptor.normalized()).cwiseMin(255.F).array().round();
  return descriptors;
}

DescriptorColumns WithNoise(const DescriptorColumns& descriptors, float sigma, std::mt19937_64& rng) {
  std::normal_distribution<float> noise(0, sigma);
  DescriptorColumns noisy = descriptors;
  for (float& value : noisy.reshaped()) value = std::round(std::clamp(value + noise(rng), 0.F, 255.F));
  return noisy;
}

// One way of matching by the definition, in double precision: index in `to` or -1.
std::vector<Eigen::Index> OneWay(const DescriptorColumns& from, const DescriptorColumns& to) {
  std::vector<Eigen::Index> matches;
  for (Eigen::Index i = 0; i < from.cols(); ++i) {
    std::vector<std::pair<double, Eigen::Index>> angles;
    for (Eigen::Index j = 0; j < to.cols(); ++j) {
      const double product = from.col(i).cast<double>().dot(to.col(j).cast<double>());
      angles.push_back({std::acos(std::min(1.0, product / (512.0 * 512.0))), j});
    }
    std::sort(angles.begin(), angles.end());
    const bool is_match = angles[0].first <= 0.7 && angles[0].first < 0.8 * angles[1].first;
    matches.push_back(is_match ? angles[0].second : -1);
  }
  return matches;
}

TEST(DescriptorMatchesTest, AreThoseOfTheDefinition) {
  std::mt19937_64 rng = support::TestRng();
  const DescriptorColumns a = RandomDescriptors(150, rng);
  DescriptorColumns b(kDescriptorSize, 200);
  // Some bins of noise leave most matches, much leaves few: both sides of each limit occur.
  b << WithNoise(a.leftCols(50), 5, rng), WithNoise(a.middleCols(50, 50), 25, rng),
      WithNoise(a.rightCols(50), 50, rng), RandomDescriptors(50, rng);
  const std::vector<Eigen::Index> forth = OneWay(a, b), back = OneWay(b, a);
  std::vector<std::uint32_t> expected;
  for (Eigen::Index i = 0; i < a.cols(); ++i) {
    const Eigen::Index j = forth[static_cast<std::size_t>(i)];
    if (j < 0 || back[static_cast<std::size_t>(j)] != i) continue;
    expected.push_back(static_cast<std::uint32_t>(i));
    expected.push_back(static_cast<std::uint32_t>(j));
  }
  ASSERT_GT(expected.size(), 100);
  ASSERT_LT(expected.size(), 290);
  EXPECT_EQ(MatchDescriptors(a, b), expected);
}

TEST(DescriptorMatchesTest, WhatOccursTwiceHasNoMatch) {
  std::mt19937_64 rng = support::TestRng();
  const DescriptorColumns a = RandomDescriptors(3, rng);
  DescriptorColumns twice(kDescriptorSize, 4);
  twice << a, a.col(1);
  EXPECT_THAT(MatchDescriptors(a, twice), testing::ElementsAre(0, 0, 2, 2));
  EXPECT_THAT(MatchDescriptors(twice, a), testing::ElementsAre(0, 0, 2, 2));
}

TEST(DescriptorMatchesTest, NothingMatchesNothing) {
  std::mt19937_64 rng = support::TestRng();
  const DescriptorColumns a = RandomDescriptors(3, rng), none(kDescriptorSize, 0);
  EXPECT_TRUE(MatchDescriptors(a, none).empty());
  EXPECT_TRUE(MatchDescriptors(none, a).empty());
  const DescriptorColumns zeros = DescriptorColumns::Zero(kDescriptorSize, 2);
  EXPECT_TRUE(MatchDescriptors(a, zeros).empty());
  EXPECT_TRUE(MatchDescriptors(zeros, zeros).empty());
}

}  // namespace
}  // namespace luxfit
