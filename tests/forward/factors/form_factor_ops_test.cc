#include "forward/factors/form_factors.h"

#include <gtest/gtest.h>

#include <optional>
#include <set>
#include <stdexcept>
#include <string>

namespace luxfit {
namespace {

constexpr auto kLastMethod = FormFactorMethod::kWallace;  // of the enumeration

TEST(FormFactorOps, EveryMethodHasOneRow) {
  const int count = static_cast<int>(kLastMethod) + 1;
  ASSERT_EQ(FormFactorMethods().size(), static_cast<size_t>(count));
  for (int value = 0; value < count; ++value) {
    const auto method = static_cast<FormFactorMethod>(value);
    EXPECT_EQ(OpsOf(method).method, method);
  }
  EXPECT_THROW(OpsOf(static_cast<FormFactorMethod>(count)), std::invalid_argument);
}

TEST(FormFactorOps, NamesLeadBackToTheirMethods) {
  std::set<std::string> names;
  for (const FormFactorOps& ops : FormFactorMethods()) {
    EXPECT_EQ(ToString(ops.method), ops.name);
    EXPECT_EQ(FormFactorMethodFrom(ops.name), ops.method);
    EXPECT_TRUE(names.insert(ops.name).second) << ops.name;
  }
  EXPECT_EQ(FormFactorMethodFrom("no such method"), std::nullopt);
  EXPECT_EQ(FormFactorMethodFrom("Hybrid"), std::nullopt);
  EXPECT_EQ(FormFactorMethodFrom(""), std::nullopt);
}

TEST(FormFactorOps, AMethodCastsRaysOverTheHemisphereOrWeighsPairs) {
  for (const FormFactorOps& ops : FormFactorMethods())
    EXPECT_NE(ops.directions == nullptr, ops.by_pairs == nullptr) << ops.name;
}

TEST(FormFactorOps, DirectionsCoverTheHemisphere) {
  constexpr int kCount = 1024;
  for (const FormFactorOps& ops : FormFactorMethods()) {
    if (!ops.directions) continue;
    const Directions set = ops.directions(kCount, 7);
    ASSERT_EQ(set.unit.cols(), set.weight.size()) << ops.name;
    EXPECT_NEAR(static_cast<double>(set.unit.cols()), kCount, 0.1 * kCount) << ops.name;  // cells of a grid
    EXPECT_GT(set.unit.row(2).minCoeff(), 0) << ops.name;
    EXPECT_LT((set.unit.colwise().norm().array() - 1).abs().maxCoeff(), 1e-6f) << ops.name;  // float rounding
    EXPECT_GT(set.weight.minCoeff(), 0) << ops.name;
    // Uniform rays: sigma of the mean of 2 cos(theta) is 1 / sqrt(3 count) = 1.8 %. The plane leaves out
    // 0.8 %.
    EXPECT_NEAR(set.weight.cast<double>().sum(), 1, 3 * 0.018) << ops.name;
  }
}

TEST(FormFactorOps, DirectionsFollowTheirSeedAlone) {
  for (const FormFactorOps& ops : FormFactorMethods()) {
    if (!ops.directions) continue;
    EXPECT_EQ(ops.directions(64, 3).unit, ops.directions(64, 3).unit) << ops.name;
    // One set for all receivers has no seed.
    EXPECT_EQ(ops.directions(64, 3).unit == ops.directions(64, 4).unit, ops.direction_sets == 1) << ops.name;
  }
}

}  // namespace
}  // namespace luxfit
