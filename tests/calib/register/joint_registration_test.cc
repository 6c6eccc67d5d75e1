// Tags and features in one adjustment, on pictures that OpenCV projected.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "calib/register/registration.h"
#include "tests/support/calib/feature_room.h"
#include "tests/support/calib/position_sigmas.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::AnySimilarity;
using support::FeatureRoom;
using testing::Contains;
using testing::IsEmpty;

constexpr double kLikelyChi2 = 27.9;  // e^T C^-1 e of 6 degrees of freedom: above it once in 10 000

std::vector<ViewDetections> DetectAll(const FeatureRoom& room, double noise_px, std::mt19937_64& rng) {
  std::vector<ViewDetections> views;
  for (std::size_t v = 0; v < room.poses.size(); ++v)
    views.push_back(support::DetectTagsOf(room, room.tags, v, noise_px, rng));
  return views;
}

std::vector<std::string> Codes(const Registration& registration) {
  std::vector<std::string> codes;
  for (const RegistrationNote& note : registration.notes) {
    EXPECT_FALSE(note.message.empty());
    EXPECT_FALSE(note.remedy.empty());
    codes.push_back(note.code);
  }
  return codes;
}

RegisterViewsOptions Exact() {
  RegisterViewsOptions options;
  options.survey_sigma_m = 0;
  options.tag_size_sigma = 0;
  return options;
}

TEST(JointRegistrationTest, RecoversTheTruthWithoutNoise) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = support::MakeFeatureRoom(8, 8, 200, rng);
  const Registration registration =
      RegisterViews({room.camera}, room.tags, DetectAll(room, 0, rng),
                    support::FeaturesOfRoom(room, {0, 0, 0.01}, AnySimilarity(), rng), Exact());
  ASSERT_TRUE(registration.IsUsable()) << registration.message;
  EXPECT_THAT(Codes(registration), IsEmpty());
  ASSERT_EQ(registration.views.size(), 8u);
  EXPECT_GT(registration.points, 100);
  for (std::size_t v = 0; v < 8; ++v) {
    EXPECT_LT(support::PoseError(registration.views[v], room.poses[v]).norm(), 1e-7);
    EXPECT_GT(registration.views[v].points_used, 10);
  }
}

TEST(JointRegistrationTest, ViewsWithoutTagsComeInThroughFeatures) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = support::MakeFeatureRoom(10, 8, 300, rng);
  std::vector<ViewDetections> detections = DetectAll(room, 0.05, rng);
  for (const std::size_t blind : {1, 4, 7}) detections[blind].tags.clear();
  const FeatureModel features = support::FeaturesOfRoom(room, {0.3, 0, 0.005}, AnySimilarity(), rng);
  const Registration alone = RegisterViews({room.camera}, room.tags, detections, Exact());
  EXPECT_LE(alone.views.size(), 7u);
  const Registration both = RegisterViews({room.camera}, room.tags, detections, features, Exact());
  ASSERT_TRUE(both.IsUsable()) << both.message;
  EXPECT_THAT(Codes(both), IsEmpty());
  ASSERT_EQ(both.views.size(), 10u);
  EXPECT_NEAR(both.point_sigma_px, 0.3, 0.03);
  for (std::size_t v = 0; v < 10; ++v) {
    EXPECT_EQ(both.views[v].tags_used == 0, v == 1 || v == 4 || v == 7);
    EXPECT_LT(support::NormalisedError(both.views[v], room.poses[v]), kLikelyChi2) << v;
  }
  support::ExpectPositionSigmasBelow(6.5, both);  // 4.3 mm: view 7, blind
}

// A wrong similarity, views that share one tag only, one that shows it so frontally that tags alone refuse
// it.
TEST(JointRegistrationTest, OneTagSharedByTwoViewsIsEnough) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = support::MakeFeatureRoom(10, 1, 300, rng);
  const std::vector<ViewDetections> detections = DetectAll(room, 0.05, rng);
  const Registration both =
      RegisterViews({room.camera}, room.tags, detections,
                    support::FeaturesOfRoom(room, {0.3, 0, 0.005}, AnySimilarity(), rng), Exact());
  ASSERT_TRUE(both.IsUsable()) << both.message;
  ASSERT_EQ(both.views.size(), 10u);
  for (std::size_t v = 0; v < 10; ++v)
    EXPECT_LT(support::NormalisedError(both.views[v], room.poses[v]), kLikelyChi2) << v;
  // 24 mm: one tag of 0.2 m turns a room of 6 m by 4.5 mrad.
  support::ExpectPositionSigmasBelow(37, both);
}

// e^T C^-1 e has 6 degrees of freedom; views of one draw share the tags' errors, so one speaks for all. Over
// 40 draws the mean's standard error is sqrt(12 / 40) = 0.55, and the estimated sigmas of points and corners
// carry some percents of their own: four standard errors.
TEST(JointRegistrationTest, CovarianceEqualsMonteCarlo) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = support::MakeFeatureRoom(6, 8, 120, rng);
  std::normal_distribution<double> normal(0, 1);
  RegisterViewsOptions options;
  options.survey_sigma_m = 0.002;
  options.tag_size_sigma = 0.005;
  double with_tags = 0, blind = 0;
  constexpr int kDraws = 40;
  for (int draw = 0; draw < kDraws; ++draw) {
    FeatureRoom hung = room;
    const double size_error = options.tag_size_sigma * normal(rng);
    for (SurveyedTag& tag : hung.tags) {
      tag.size_m *= 1 + size_error;
      tag.center_in_world += options.survey_sigma_m * Eigen::Vector3d(normal(rng), normal(rng), normal(rng));
    }
    std::vector<ViewDetections> detections = DetectAll(hung, 0.05, rng);
    detections[3].tags.clear();
    const Registration registration =
        RegisterViews({room.camera}, room.tags, detections,
                      support::FeaturesOfRoom(room, {0.3, 0, 0.003}, AnySimilarity(), rng), options);
    ASSERT_EQ(registration.views.size(), 6u) << registration.message;
    with_tags += support::NormalisedError(registration.views[0], room.poses[0]) / kDraws;
    blind += support::NormalisedError(registration.views[3], room.poses[3]) / kDraws;
  }
  RecordProperty("with_tags", std::to_string(with_tags));
  RecordProperty("blind", std::to_string(blind));
  EXPECT_NEAR(with_tags, 6, 2.2);
  EXPECT_NEAR(blind, 6, 2.2);
}

TEST(JointRegistrationTest, OutliersAmongFeaturesDoNoHarm) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = support::MakeFeatureRoom(8, 8, 300, rng);
  std::vector<ViewDetections> detections = DetectAll(room, 0.05, rng);
  detections[2].tags.clear();
  const Registration registration =
      RegisterViews({room.camera}, room.tags, detections,
                    support::FeaturesOfRoom(room, {0.3, 0.2, 0.005}, AnySimilarity(), rng), Exact());
  ASSERT_EQ(registration.views.size(), 8u) << registration.message;
  for (std::size_t v = 0; v < 8; ++v)
    EXPECT_LT(support::NormalisedError(registration.views[v], room.poses[v]), kLikelyChi2) << v;
  support::ExpectPositionSigmasBelow(8.8, registration);  // 5.9 mm from the four fifths that are no outliers
}

// The model has one view in another place than its tags say: the tags are believed, and it is named.
TEST(JointRegistrationTest, AViewThatFeaturesMisplaceKeepsItsTags) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = support::MakeFeatureRoom(8, 12, 300, rng);
  FeatureRoom wrong = room;
  wrong.poses[5].translation() += Eigen::Vector3d(0.5, 0.1, 0.3);
  const std::vector<ViewDetections> detections = DetectAll(room, 0.05, rng);
  ASSERT_GE(detections[5].tags.size(), 2u);
  const Registration registration =
      RegisterViews({room.camera}, room.tags, detections,
                    support::FeaturesOfRoom(wrong, {0.3, 0, 0.005}, AnySimilarity(), rng), Exact());
  EXPECT_THAT(Codes(registration), Contains("features_disagree"));
  ASSERT_EQ(registration.views.size(), 8u);
  EXPECT_EQ(registration.views[5].points_used, 0);
  for (std::size_t v = 0; v < 8; ++v)
    EXPECT_LT(support::PoseError(registration.views[v], room.poses[v]).tail<3>().norm(), 0.005) << v;
}

// Repeated things (desks in a row) put a view farther back or nearer, where some of its tags still seem to fit.
TEST(JointRegistrationTest, AViewIsNotWhereSomeOfItsTagsContradictIt) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = support::MakeFeatureRoom(8, 24, 300, rng);
  const std::vector<ViewDetections> detections = DetectAll(room, 0.1, rng);
  ASSERT_GE(detections[5].tags.size(), 4u);
  RegisterViewsOptions options;
  options.survey_sigma_m = 0.001;
  for (const double shift_m : {-0.1, 0.1, 0.2}) {
    FeatureRoom wrong = room;
    wrong.poses[5].translation() += Eigen::Vector3d(0.1 * shift_m, 0, shift_m);
    const Registration registration =
        RegisterViews({room.camera}, room.tags, detections,
                      support::FeaturesOfRoom(wrong, {0.3, 0, 0.005}, AnySimilarity(), rng), options);
    ASSERT_EQ(registration.views.size(), 8u) << shift_m;
    EXPECT_LT(support::PoseError(registration.views[5], room.poses[5]).tail<3>().norm(), 0.02) << shift_m;
  }
}

// The reconstruction of another room: it fits the tags nowhere, and tags alone go on.
TEST(JointRegistrationTest, FeaturesOfAnotherRoomAreRefusedByName) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = support::MakeFeatureRoom(8, 12, 100, rng);
  FeatureRoom other = room;
  for (std::size_t v = 0; v < 8; ++v) other.poses[v] = room.poses[(3 * v + 1) % 8];
  const Registration registration =
      RegisterViews({room.camera}, room.tags, DetectAll(room, 0.05, rng),
                    support::FeaturesOfRoom(other, {0.3, 0, 0.005}, AnySimilarity(), rng), Exact());
  EXPECT_THAT(Codes(registration), Contains("features_unaligned"));
  EXPECT_TRUE(registration.IsUsable());
  EXPECT_EQ(registration.points, 0);
  for (const RegisteredView& view : registration.views) EXPECT_EQ(view.points_used, 0);
}

}  // namespace
}  // namespace luxfit
