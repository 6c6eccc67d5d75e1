// Focal lengths that the surveyed tags contradict, on pictures that OpenCV projected.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "calib/register/registration.h"
#include "tests/support/calib/feature_room.h"
#include "tests/support/calib/position_sigmas.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::FeatureRoom;

constexpr double kLikely = 27.9;  // e^T C^-1 e of 6 degrees of freedom: above it once in 10 000
constexpr double kNoisePx = 0.1;

std::vector<ViewDetections> DetectAll(const FeatureRoom& room, std::mt19937_64& rng) {
  std::vector<ViewDetections> views;
  for (std::size_t v = 0; v < room.poses.size(); ++v)
    views.push_back(support::DetectTagsOf(room, room.tags, v, kNoisePx, rng));
  return views;
}

// What a survey of that sigma would have written down.
std::vector<SurveyedTag> Surveyed(std::vector<SurveyedTag> tags, double sigma_m, std::mt19937_64& rng) {
  std::normal_distribution<double> normal(0, sigma_m);
  for (SurveyedTag& tag : tags) tag.center_in_world += Eigen::Vector3d(normal(rng), normal(rng), normal(rng));
  return tags;
}

TEST(FocalLengthTest, WrongOnesAreFoundAndTheirUncertaintyCarried) {
  for (const double off : {0.7, 0.8, 0.98, 0.995, 1.01, 1.1, 1.3}) {
    std::mt19937_64 rng = support::TestRng();
    const FeatureRoom room = support::MakeFeatureRoom(8, 24, 0, rng);
    const Registration registration = RegisterViews({WithFocalScale(room.camera, off)},
                                                    Surveyed(room.tags, 1e-3, rng), DetectAll(room, rng));
    ASSERT_EQ(registration.views.size(), 8u) << off;
    const double scale = registration.focal_scale.at(0), sigma = registration.focal_scale_sigma.at(0);
    EXPECT_GT(sigma, 0) << off;
    EXPECT_LT(sigma, 9e-4) << off;  // the normal equations of these tags give 5.8e-4
    EXPECT_LT(std::abs(scale * off - 1), 4 * sigma) << off;
    for (std::size_t v = 0; v < 8; ++v)
      EXPECT_LT(support::NormalisedError(registration.views[v], room.poses[v]), kLikely) << off << " " << v;
    std::printf("focal length off by %g: sigma of the scale %.2e\n", off, sigma);
    support::ExpectPositionSigmasBelow(14, registration);  // 9.4 mm, most of it by the focal length
  }
}

// 30 surveys: 4 sigma are passed by chance once in 500 such tests.
TEST(FocalLengthTest, RightOnesAreLeftAlone) {
  std::mt19937_64 rng = support::TestRng();
  for (int draw = 0; draw < 30; ++draw) {
    const FeatureRoom room = support::MakeFeatureRoom(6, 16, 0, rng);
    const Registration registration =
        RegisterViews({room.camera}, Surveyed(room.tags, 1e-3, rng), DetectAll(room, rng));
    EXPECT_EQ(registration.focal_scale.at(0), 1) << draw;
    EXPECT_EQ(registration.focal_scale_sigma.at(0), 0) << draw;
  }
}

// Two cameras, one of them wrong.
TEST(FocalLengthTest, EachCameraHasItsOwn) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = support::MakeFeatureRoom(8, 24, 0, rng);
  std::vector<ViewDetections> views = DetectAll(room, rng);
  for (std::size_t v = 0; v < 8; ++v) views[v].camera = v % 2 == 0 ? 0 : 1;
  const Registration registration =
      RegisterViews({room.camera, WithFocalScale(room.camera, 1.03)}, room.tags, views);
  EXPECT_EQ(registration.focal_scale.at(0), 1);
  const double sigma = registration.focal_scale_sigma.at(1);
  std::printf("sigma of the second camera's scale %.2e\n", sigma);
  EXPECT_NEAR(registration.focal_scale.at(1) * 1.03, 1, 4 * sigma);
  EXPECT_LT(sigma, 1e-3);  // the normal equations of the four views' tags give 6.7e-4
}

// Tags of one wall, a millimetre off its plane as surveys are: every view has a pose.
TEST(FocalLengthTest, FlatSurveysWithErrorsRegisterEveryView) {
  std::mt19937_64 rng = support::TestRng();
  for (int draw = 0; draw < 10; ++draw) {
    const FeatureRoom room = support::MakeFeatureRoom(8, 24, 0, rng);
    const Registration registration =
        RegisterViews({room.camera}, Surveyed(room.tags, 2e-3, rng), DetectAll(room, rng));
    EXPECT_EQ(registration.views.size(), 8u) << draw;
  }
}

}  // namespace
}  // namespace luxfit
