// What goes wrong with tags, surveys and views: found, named, and left out or refused.

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
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

class RegistrationFaultsTest : public testing::Test {
 protected:
  RegistrationFaultsTest() : rng_(support::TestRng()), room_(support::MakeFeatureRoom(8, 16, 0, rng_)) {}

  std::vector<ViewDetections> See(const std::vector<SurveyedTag>& truth) {
    std::vector<ViewDetections> views;
    for (std::size_t v = 0; v < room_.poses.size(); ++v)
      views.push_back(support::DetectTagsOf(room_, truth, v, 0.05, rng_));
    return views;
  }
  // The survey is as given, the tags hang as the room has them.
  Registration Register(const std::vector<SurveyedTag>& survey) {
    return RegisterViews({room_.camera}, survey, See(room_.tags));
  }
  const RegistrationNote* Find(const Registration& registration, const std::string& code) const {
    for (const RegistrationNote& note : registration.notes) {
      if (note.code == code) return &note;
    }
    return nullptr;
  }
  void ExpectRefused(const std::vector<SurveyedTag>& survey, const std::string& code,
                     const std::string& words) {
    const Registration registration = Register(survey);
    EXPECT_FALSE(registration.IsUsable());
    EXPECT_TRUE(registration.views.empty());
    const RegistrationNote* const note = Find(registration, code);
    ASSERT_NE(note, nullptr) << code;
    EXPECT_THAT(note->message, HasSubstr(words));
    EXPECT_FALSE(note->remedy.empty());
    EXPECT_EQ(registration.message, note->message);
  }
  // `most_sigma_mm`: of a camera's place. Views of few and distant tags have the largest.
  void ExpectGood(const Registration& registration, double most_sigma_mm) const {
    ASSERT_TRUE(registration.IsUsable()) << registration.message;
    for (const RegisteredView& view : registration.views) {
      const auto v = static_cast<std::size_t>(std::stoi(view.view.substr(1)));
      EXPECT_LT(support::NormalisedError(view, room_.poses[v]), 27.9) << view.view;
    }
    support::ExpectPositionSigmasBelow(most_sigma_mm, registration);
  }

  std::mt19937_64 rng_;
  FeatureRoom room_;
};

TEST_F(RegistrationFaultsTest, ARightSurveyHasNoFaults) {
  const Registration registration = Register(room_.tags);
  EXPECT_THAT(registration.notes, IsEmpty());
  EXPECT_EQ(registration.views.size(), 8u);
  ExpectGood(registration, 10.2);  // 6.8 mm
}

TEST_F(RegistrationFaultsTest, MirroredMapsAreRefused) {
  std::vector<SurveyedTag> mirrored = room_.tags, swapped = room_.tags;
  for (SurveyedTag& tag : mirrored) {
    for (Eigen::Vector3d* v : {&tag.center_in_world, &tag.normal_in_world, &tag.up_in_world})
      v->y() = -v->y();
  }
  for (SurveyedTag& tag : swapped) {
    for (Eigen::Vector3d* v : {&tag.center_in_world, &tag.normal_in_world, &tag.up_in_world})
      std::swap(v->x(), v->y());
  }
  ExpectRefused(mirrored, "map_mirrored", "mirror image");
  ExpectRefused(swapped, "map_mirrored", "mirror image");
}

TEST_F(RegistrationFaultsTest, NormalsIntoTheWallAreRefused) {
  std::vector<SurveyedTag> inward = room_.tags;
  for (SurveyedTag& tag : inward) tag.normal_in_world = -tag.normal_in_world;
  ExpectRefused(inward, "map_turned", "normals point into the walls");
}

// OpenCV's drawings of AprilTags are turned by 180 degrees.
TEST_F(RegistrationFaultsTest, AMapOfTurnedTagsIsRefused) {
  std::vector<SurveyedTag> turned = room_.tags;
  for (SurveyedTag& tag : turned) tag.up_in_world = -tag.up_in_world;
  ExpectRefused(turned, "map_turned", "turned by 180 degrees");
}

TEST_F(RegistrationFaultsTest, SizesThatAreAllWrongAreRefused) {
  for (const double factor : {0.5, 0.8, 1.25, 2.0}) {
    std::vector<SurveyedTag> wrong = room_.tags;
    for (SurveyedTag& tag : wrong) tag.size_m /= factor;
    ExpectRefused(wrong, "tag_sizes_wrong", "times as large");
  }
  std::vector<SurveyedTag> millimetres = room_.tags;
  for (SurveyedTag& tag : millimetres) tag.size_m *= 1000;
  ExpectRefused(millimetres, "tag_sizes_wrong", "0.001 times as large");
}

// The same numbers taken as those of a fisheye: no view fits, and the reason is in words of photos.
TEST_F(RegistrationFaultsTest, IntrinsicsOfAnotherLensAreTheReason) {
  const std::vector<ViewDetections> seen = See(room_.tags);
  Camera other = room_.camera;
  other.lens = LensModel::kFisheye;
  const Registration registration = RegisterViews({other}, room_.tags, seen);
  EXPECT_FALSE(registration.IsUsable());
  EXPECT_EQ(Find(registration, "tag_sizes_wrong"), nullptr);
  EXPECT_THAT(registration.message, HasSubstr("the intrinsics may be of another lens model"));
}

TEST_F(RegistrationFaultsTest, SizesThatAreSlightlyWrongAreNamed) {
  std::vector<SurveyedTag> wrong = room_.tags;
  for (SurveyedTag& tag : wrong) tag.size_m /= 1.03;
  const Registration registration = Register(wrong);
  const RegistrationNote* const note = Find(registration, "tag_sizes_wrong");
  ASSERT_NE(note, nullptr);
  EXPECT_THAT(note->message, HasSubstr("% larger than surveyed"));
  EXPECT_NEAR(registration.tag_size_error, 0.03, 0.002);
  ExpectGood(registration, 14);  // 9.5 mm
}

TEST_F(RegistrationFaultsTest, OneTagOfAnotherSizeIsLeftOut) {
  std::vector<SurveyedTag> wrong = room_.tags;
  wrong[5].size_m = 0.15;
  const Registration registration = Register(wrong);
  const RegistrationNote* const note = Find(registration, "tag_disagrees");
  ASSERT_NE(note, nullptr);
  EXPECT_EQ(note->tag_id, 5);
  ExpectGood(registration, 14);  // 9.6 mm
}

TEST_F(RegistrationFaultsTest, ATagThatWasMovedIsLeftOut) {
  for (const double moved_m : {0.02, 0.2, 1.0}) {
    std::vector<SurveyedTag> before = room_.tags;
    before[6].center_in_world.z() += moved_m;
    const Registration registration = Register(before);
    const RegistrationNote* const note = Find(registration, "tag_disagrees");
    ASSERT_NE(note, nullptr) << moved_m;
    EXPECT_EQ(note->tag_id, 6);
    ExpectGood(registration, 16.5);  // 10.9 mm
  }
}

// No view shows both copies: each view alone is sound, and only together do they tell.
TEST_F(RegistrationFaultsTest, AnIdThatHangsInTwoPlacesIsNamed) {
  std::vector<SurveyedTag> truth = room_.tags;
  SurveyedTag copy = truth[0];  // on the wall x = 0; its copy on the wall opposite
  copy.center_in_world = {support::kRoomSize[0], 1.2, 1.5};
  copy.normal_in_world = -copy.normal_in_world;
  truth.push_back(copy);
  const Registration registration = RegisterViews({room_.camera}, room_.tags, See(truth));
  const RegistrationNote* const note = Find(registration, "tag_duplicated");
  ASSERT_NE(note, nullptr);
  EXPECT_EQ(note->tag_id, 0);
  EXPECT_THAT(note->message, AllOf(HasSubstr("hangs in two places"), HasSubstr("(6.0")));
  ExpectGood(registration, 13.5);  // 9.0 mm
}

// The same ids hang elsewhere in the other room: no two of its tags agree with this survey.
TEST_F(RegistrationFaultsTest, AViewOfAnotherRoomIsLeftOut) {
  std::mt19937_64 other_rng(7);
  const FeatureRoom other = support::MakeFeatureRoom(8, 16, 0, other_rng);
  std::vector<ViewDetections> detections = See(room_.tags);
  detections[3] = support::DetectTagsOf(other, other.tags, 3, 0.05, rng_);
  detections[3].view = "v3";
  ASSERT_GE(detections[3].tags.size(), 3u);
  const Registration registration = RegisterViews({room_.camera}, room_.tags, detections);
  const RegistrationNote* const note = Find(registration, "view_disagrees");
  ASSERT_NE(note, nullptr);
  EXPECT_EQ(note->view, "v3");
  EXPECT_EQ(registration.views.size(), 7u);
  ExpectGood(registration, 12.5);  // 8.2 mm
}

// A view of one tag of another room cannot be told by tags. Features can: they put it elsewhere.
TEST_F(RegistrationFaultsTest, OneTagOfAnotherRoomIsTakenBackByFeatures) {
  FeatureRoom room = support::MakeFeatureRoom(8, 16, 250, rng_);
  std::vector<ViewDetections> detections;
  for (std::size_t v = 0; v < 8; ++v)
    detections.push_back(support::DetectTagsOf(room, room.tags, v, 0.05, rng_));
  FeatureRoom elsewhere = room;
  elsewhere.poses[2] = room.poses[2] * Eigen::Translation3d(0.4, -0.3, 0.2);
  ViewDetections strange = support::DetectTagsOf(elsewhere, room.tags, 2, 0.05, rng_);
  ASSERT_FALSE(strange.tags.empty());
  strange.tags.resize(1);
  detections[2] = strange;
  const FeatureModel features =
      support::FeaturesOfRoom(room, {0.3, 0, 0.005}, support::AnySimilarity(), rng_);
  const Registration registration = RegisterViews({room.camera}, room.tags, detections, features);
  ASSERT_EQ(registration.views.size(), 8u) << registration.message;
  EXPECT_EQ(registration.views[2].tags_used, 0);
  EXPECT_EQ(registration.views[2].corners_rejected, 4);
  EXPECT_LT(support::NormalisedError(registration.views[2], room.poses[2]), 27.9);
  support::ExpectPositionSigmasBelow(9.5, registration);  // 6.4 mm: view 2, by features alone
}

// A small far tag has two poses; a wrong one is never given without a note.
TEST_F(RegistrationFaultsTest, PlanarFlipsAreNotTaken) {
  int given = 0;
  for (int draw = 0; draw < 60; ++draw) {
    std::uniform_real_distribution<double> uniform(0, 1);
    FeatureRoom far = room_;
    far.tags.resize(1);
    far.tags[0] = {0, 0.2, {0, 2, 1.4}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ()};
    const double angle = 1.2 * (uniform(rng_) - 0.5), distance_m = 1.5 + 2.5 * uniform(rng_);
    const Eigen::Vector3d from =
        far.tags[0].center_in_world + distance_m * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.1);
    far.poses = {support::LookAt(from, far.tags[0].center_in_world)};
    const ViewDetections view = support::DetectTagsOf(far, far.tags, 0, 0.1, rng_);
    if (view.tags.empty()) continue;
    const Registration registration = RegisterViews({far.camera}, far.tags, {view});
    if (registration.views.empty()) {
      EXPECT_FALSE(registration.notes.empty());
      continue;
    }
    ++given;
    EXPECT_LT(support::PoseError(registration.views[0], far.poses[0]).head<3>().norm(), 0.05);
  }
  EXPECT_GT(given, 5);  // the near and oblique ones are
}

}  // namespace
}  // namespace luxfit
