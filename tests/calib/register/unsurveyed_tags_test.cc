// Tags that nobody surveyed: their places from their size and the photos.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "calib/register/registration.h"
#include "tests/support/calib/feature_room.h"
#include "tests/support/calib/position_sigmas.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::FeatureRoom;

RegisterViewsOptions OfSize(double size_m, double size_sigma) {
  RegisterViewsOptions options;
  options.tag_size_m = size_m;
  options.tag_size_sigma = size_sigma;
  return options;
}

std::vector<ViewDetections> DetectAllTags(const FeatureRoom& room, double noise_px, std::mt19937_64& rng) {
  std::vector<ViewDetections> views;
  for (std::size_t v = 0; v < room.poses.size(); ++v)
    views.push_back(support::DetectTagsOf(room, room.tags, v, noise_px, rng));
  return views;
}

// The truth in the frame that the registration chose: where the corners of all tags fit best, without scale.
FeatureRoom InFrameOf(const FeatureRoom& room, const Registration& registration) {
  Eigen::Matrix3Xd in_room(3, 4 * registration.placed_tags.size()), in_frame = in_room;
  Eigen::Index column = 0;
  for (const SurveyedTag& placed : registration.placed_tags) {
    for (std::size_t i = 0; i < 4; ++i, ++column) {
      in_frame.col(column) = TagCornersInWorld(placed)[i];
      in_room.col(column) = TagCornersInWorld(room.tags[static_cast<std::size_t>(placed.id)])[i];
    }
  }
  Eigen::Isometry3d room_from_frame(Eigen::umeyama(in_frame, in_room, false));
  FeatureRoom moved = room;
  for (Eigen::Isometry3d& pose : moved.poses) pose = pose * room_from_frame;
  for (SurveyedTag& tag : moved.tags) {
    tag.center_in_world = room_from_frame.inverse() * tag.center_in_world;
    tag.normal_in_world = room_from_frame.linear().transpose() * tag.normal_in_world;
    tag.up_in_world = room_from_frame.linear().transpose() * tag.up_in_world;
  }
  return moved;
}

void ExpectTheTruth(const Registration& registration, const FeatureRoom& truth) {
  for (const RegisteredView& view : registration.views) {
    const auto v = static_cast<std::size_t>(std::stoi(view.view.substr(1)));
    EXPECT_LT(support::NormalisedError(view, truth.poses[v]), 27.9) << view.view;
  }
}

TEST(UnsurveyedTagsTest, PlacesAreRecoveredWithoutNoise) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = support::MakeFeatureRoom(12, 16, 0, rng);
  const Registration registration =
      RegisterViews({room.camera}, {}, DetectAllTags(room, 0, rng), OfSize(0.2, 0));
  ASSERT_TRUE(registration.IsUsable()) << registration.message;
  ASSERT_EQ(registration.frame.substr(0, 4), "tag ");
  EXPECT_EQ(registration.views.size(), 12u);
  EXPECT_GE(registration.placed_tags.size(), 14u);
  const FeatureRoom truth = InFrameOf(room, registration);
  for (const RegisteredView& view : registration.views) {
    const auto v = static_cast<std::size_t>(std::stoi(view.view.substr(1)));
    EXPECT_LT(support::PoseError(view, truth.poses[v]).norm(), 1e-5);
  }
  for (const SurveyedTag& tag : registration.placed_tags) {
    const SurveyedTag& expected = truth.tags[static_cast<std::size_t>(tag.id)];
    EXPECT_LT((tag.center_in_world - expected.center_in_world).norm(), 1e-5);
    EXPECT_GT(tag.normal_in_world.dot(expected.normal_in_world), 1 - 1e-9);
    EXPECT_GT(tag.up_in_world.dot(expected.up_in_world), 1 - 1e-9);
    EXPECT_NEAR(tag.size_m, 0.2, 1e-6);
  }
}

// The scale is the size's: its sigma is in the poses' covariance.
TEST(UnsurveyedTagsTest, NoiseAndScaleAreInTheCovariance) {
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<double> normal(0, 1);
  const FeatureRoom room = support::MakeFeatureRoom(14, 40, 0, rng);
  double sum = 0;
  constexpr int kDraws = 12;
  for (int draw = 0; draw < kDraws; ++draw) {
    FeatureRoom printed = room;
    const double size_error = 0.005 * normal(rng);
    for (SurveyedTag& tag : printed.tags) tag.size_m *= 1 + size_error;
    const Registration registration =
        RegisterViews({room.camera}, {}, DetectAllTags(printed, 0.05, rng), OfSize(0.2, 0.005));
    ASSERT_GE(registration.views.size(), 12u) << registration.message;
    const FeatureRoom truth = InFrameOf(room, registration);
    const RegisteredView& last = registration.views.back();
    sum +=
        support::NormalisedError(last, truth.poses[static_cast<std::size_t>(std::stoi(last.view.substr(1)))]);
  }
  // Mean of 12 chi2 of 6 degrees of freedom: standard error sqrt(12 / 12) = 1; four.
  EXPECT_NEAR(sum / kDraws, 6, 4);
}

// One tag a view: tags alone connect nothing, features do.
TEST(UnsurveyedTagsTest, FeaturesConnectViewsThatShareNoTag) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = support::MakeFeatureRoom(10, 6, 300, rng);
  const std::vector<ViewDetections> detections = DetectAllTags(room, 0.05, rng);
  const FeatureModel features = support::FeaturesOfRoom(room, {0.3, 0, 0.003}, support::AnySimilarity(), rng);
  const Registration alone = RegisterViews({room.camera}, {}, detections, OfSize(0.2, 0));
  const Registration both = RegisterViews({room.camera}, {}, detections, features, OfSize(0.2, 0));
  ASSERT_EQ(both.views.size(), 10u) << both.message;
  EXPECT_LT(alone.placed_tags.size(), both.placed_tags.size());
  ExpectTheTruth(both, InFrameOf(room, both));
  support::ExpectPositionSigmasBelow(6.8, both);  // 4.5 mm
}

TEST(UnsurveyedTagsTest, WhatDoesNotConnectIsNamed) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = support::MakeFeatureRoom(12, 40, 0, rng);
  std::vector<ViewDetections> detections = DetectAllTags(room, 0.05, rng);
  // A tag that one view shows, alone.
  ViewDetections lone;
  lone.view = "lone";
  for (const ViewDetections& view : detections) {
    if (!view.tags.empty()) lone.tags = {view.tags.front()};
  }
  lone.tags[0].id = 99;
  detections.push_back(lone);
  const Registration registration = RegisterViews({room.camera}, {}, detections, OfSize(0.2, 0));
  EXPECT_TRUE(registration.IsUsable()) << registration.message;
  bool named = false;
  for (const RegistrationNote& note : registration.notes)
    named = named || (note.code == "tag_unplaced" && note.tag_id == 99);
  EXPECT_TRUE(named);
  EXPECT_FALSE(RegisterViews({room.camera}, {}, {}, OfSize(0.2, 0)).IsUsable());
}

}  // namespace
}  // namespace luxfit
