// The survey's accuracy against the photos: surveys worse than stated, as stated, and with one moved tag.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "calib/register/registration.h"
#include "tests/support/calib/feature_room.h"
#include "tests/support/calib/position_sigmas.h"
#include "tests/support/calib/survey_draws.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::FeatureRoom;
using support::LookAt;
using support::PoseErrors;
using support::SurveyOf;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr int kDraws = 20;
constexpr double kNoise_px = 0.1;

// The corner x = 0, y = 0 of a room: nine tags on two walls and the floor, seen by eight views that stand
// around it. The photos determine 21 of the tags' 27 displacements: all but the common rigid motion.
FeatureRoom CornerRoom() {
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ(), x = Eigen::Vector3d::UnitX(),
                        y = Eigen::Vector3d::UnitY();
  FeatureRoom room;
  room.camera = OfficeCamera({-0.112, 0.061, 4e-4, -7e-4, 0, 0, 0, 0});
  room.tags = {{0, 0.2, {0, 0.5, 1.0}, x, z}, {1, 0.2, {0, 1.4, 1.5}, x, z},  {2, 0.2, {0, 0.9, 2.0}, x, z},
               {3, 0.2, {0, 1.9, 0.9}, x, z}, {4, 0.2, {0.6, 0, 1.6}, y, z},  {5, 0.2, {1.3, 0, 1.1}, y, z},
               {6, 0.2, {1.8, 0, 1.8}, y, z}, {7, 0.2, {0.8, 0.7, 0}, z, -x}, {8, 0.2, {1.2, 0, 2.1}, y, z}};
  for (const Eigen::Vector3d& from :
       {Eigen::Vector3d(3.2, 2.6, 1.6), Eigen::Vector3d(2.6, 3.2, 1.2), Eigen::Vector3d(3.4, 1.8, 1.9),
        Eigen::Vector3d(2.4, 2.6, 1.5), Eigen::Vector3d(1.8, 3.3, 1.7), Eigen::Vector3d(3.5, 1.3, 1.4),
        Eigen::Vector3d(2.9, 2.9, 2.2), Eigen::Vector3d(2.7, 2.3, 0.9)})
    room.poses.push_back(LookAt(from, {0.4, 0.4, 1.1}));
  return room;
}

std::vector<ViewDetections> DetectAll(const FeatureRoom& room, std::mt19937_64& rng) {
  return support::DetectTagsInAll(room, room.tags, kNoise_px, rng);
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

void ExpectBlocksOfViews(const Registration& registration) {
  ASSERT_EQ(registration.pose_covariance.rows(), 6 * static_cast<Eigen::Index>(registration.views.size()));
  ASSERT_EQ(registration.pose_covariance.cols(), registration.pose_covariance.rows());
  for (std::size_t i = 0; i < registration.views.size(); ++i) {
    const auto at = 6 * static_cast<Eigen::Index>(i);
    const Eigen::MatrixXd block = registration.pose_covariance.block<6, 6>(at, at);
    EXPECT_EQ(block, Eigen::MatrixXd(registration.views[i].covariance));
  }
}

// Sums over draws: squared errors of camera centres over their variances, and e^T C^-1 e of all poses.
struct Score {
  double centre_squares = 0, coordinates = 0, joint = 0, parameters = 0;

  void Add(const Registration& registration, const FeatureRoom& room) {
    const Eigen::VectorXd errors = PoseErrors(registration, room);
    for (Eigen::Index i = 0; i < errors.size(); ++i) {
      if (i % 6 < 3) continue;
      centre_squares += errors[i] * errors[i] / registration.pose_covariance(i, i);
      ++coordinates;
    }
    joint += errors.dot(registration.pose_covariance.ldlt().solve(errors));
    parameters += static_cast<double>(errors.size());
  }
  double RmsZ() const { return std::sqrt(centre_squares / coordinates); }
  double Chi2PerParameter() const { return joint / parameters; }
};

// The eight views of a draw share the tags' common motion, six numbers: 20 draws leave some 120, so that z
// scatters by 7 % from them and by as much from the estimated sigma. The bounds are four times that.
TEST(SurveyAccuracyTest, AWorseSurveyShowsItsSigma) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = CornerRoom();
  constexpr double kSurvey_m = 0.01;
  Score score;
  double sigma_m = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Registration registration =
        RegisterViews({room.camera}, SurveyOf(room, kSurvey_m, rng), DetectAll(room, rng));
    ASSERT_TRUE(registration.IsUsable()) << registration.message;
    ASSERT_EQ(registration.views.size(), 8u);
    EXPECT_THAT(Codes(registration), ElementsAre("survey_less_accurate")) << draw;
    ExpectBlocksOfViews(registration);
    score.Add(registration, room);
    sigma_m += registration.survey_sigma_m / kDraws;
  }
  RecordProperty("rms_z", std::to_string(score.RmsZ()));
  RecordProperty("joint", std::to_string(score.Chi2PerParameter()));
  RecordProperty("sigma_m", std::to_string(sigma_m));
  EXPECT_GT(score.RmsZ(), 0.7);
  EXPECT_LT(score.RmsZ(), 1.4);
  EXPECT_GT(score.Chi2PerParameter(), 0.6);
  EXPECT_LT(score.Chi2PerParameter(), 1.6);
  EXPECT_GT(sigma_m, kSurvey_m / 1.5);
  EXPECT_LT(sigma_m, kSurvey_m * 1.5);
}

// The test that doubts a survey is wrong once in a hundred: twice in 20 draws with a probability of 2 %.
TEST(SurveyAccuracyTest, ASurveyAsStatedIsBelieved) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = CornerRoom();
  const double stated_m = RegisterViewsOptions().survey_sigma_m;
  Score score;
  int as_stated = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Registration registration =
        RegisterViews({room.camera}, SurveyOf(room, stated_m, rng), DetectAll(room, rng));
    ASSERT_EQ(registration.views.size(), 8u) << registration.message;
    EXPECT_THAT(Codes(registration), IsEmpty()) << draw;
    ExpectBlocksOfViews(registration);
    score.Add(registration, room);
    as_stated += registration.survey_sigma_m == stated_m ? 1 : 0;
  }
  EXPECT_GE(as_stated, 19);
  EXPECT_GT(score.RmsZ(), 0.7);
  EXPECT_LT(score.RmsZ(), 1.4);
  EXPECT_GT(score.Chi2PerParameter(), 0.6);
  EXPECT_LT(score.Chi2PerParameter(), 1.6);
}

TEST(SurveyAccuracyTest, OneMovedTagIsNamedAndTheOthersAreBelieved) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = CornerRoom();
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<SurveyedTag> survey = room.tags;
    survey[3].center_in_world += 0.05 * Eigen::Vector3d(0, 0.6, -0.8);
    const Registration registration = RegisterViews({room.camera}, survey, DetectAll(room, rng));
    ASSERT_TRUE(registration.IsUsable()) << registration.message;
    EXPECT_THAT(Codes(registration), ElementsAre("tag_disagrees")) << draw;
    EXPECT_EQ(registration.notes.at(0).tag_id, 3);
    EXPECT_EQ(registration.survey_sigma_m, RegisterViewsOptions().survey_sigma_m);
    for (const RegisteredView& view : registration.views) {
      const auto v = static_cast<std::size_t>(std::stoi(view.view.substr(1)));
      EXPECT_LT(support::NormalisedError(view, room.poses[v]), 27.9) << view.view;
    }
    // 2.6 mm from eight tags of 1 mm, which the survey's sigma rules.
    support::ExpectPositionSigmasBelow(4, registration);
  }
}

// One view shows the moved tag and one other, which cannot outvote it there. Leaving each tag out in turn
// tells which one was moved: by 12 mm, less than what a view's start accepts.
TEST(SurveyAccuracyTest, AMovedTagThatAViewCannotOutvoteIsNamed) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = CornerRoom();
  std::vector<SurveyedTag> survey = room.tags;
  survey[3].center_in_world += 0.012 * Eigen::Vector3d(0, 0.6, -0.8);
  std::vector<ViewDetections> detections = DetectAll(room, rng);
  std::vector<TagDetection> two;
  for (const TagDetection& tag : detections[0].tags) {
    if (tag.id == 3 || tag.id == 4) two.push_back(tag);
  }
  ASSERT_EQ(two.size(), 2u);
  detections[0].tags = two;
  const Registration registration = RegisterViews({room.camera}, survey, detections);
  ASSERT_TRUE(registration.IsUsable()) << registration.message;
  EXPECT_EQ(registration.survey_sigma_m, RegisterViewsOptions().survey_sigma_m);
  const auto note = std::find_if(registration.notes.begin(), registration.notes.end(),
                                 [](const RegistrationNote& other) { return other.code == "tag_disagrees"; });
  ASSERT_NE(note, registration.notes.end());
  EXPECT_EQ(note->tag_id, 3);
}

TEST(SurveyAccuracyTest, AnExactSurveyStaysExact) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = CornerRoom();
  RegisterViewsOptions options;
  options.survey_sigma_m = 0;
  const Registration registration = RegisterViews({room.camera}, room.tags, DetectAll(room, rng), options);
  EXPECT_EQ(registration.survey_sigma_m, 0);
  EXPECT_THAT(Codes(registration), IsEmpty());
  ExpectBlocksOfViews(registration);
}

// The error of a focal length that the tags showed is common to all views.
TEST(SurveyAccuracyTest, BlocksHoldTheFocalLengthsUncertainty) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = CornerRoom();
  const Registration registration =
      RegisterViews({WithFocalScale(room.camera, 1.02)}, room.tags, DetectAll(room, rng));
  ASSERT_TRUE(registration.IsUsable()) << registration.message;
  ASSERT_NE(registration.focal_scale.at(0), 1);
  ExpectBlocksOfViews(registration);
  EXPECT_EQ(registration.survey_sigma_m, RegisterViewsOptions().survey_sigma_m);
}

TEST(SurveyAccuracyTest, ViewsLeaveWithTheirRows) {
  Registration registration;
  registration.views.resize(3);
  const Eigen::MatrixXd any = Eigen::MatrixXd::Random(18, 18);
  registration.pose_covariance = any + any.transpose();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto at = 6 * static_cast<Eigen::Index>(i);
    registration.views[i].covariance = registration.pose_covariance.block<6, 6>(at, at);
  }
  const Eigen::MatrixXd between = registration.pose_covariance.block<6, 6>(12, 0);
  EXPECT_THROW(KeepViews({true}, registration), std::invalid_argument);
  KeepViews({true, false, true}, registration);
  ASSERT_EQ(registration.views.size(), 2u);
  ExpectBlocksOfViews(registration);
  const Eigen::MatrixXd kept_between = registration.pose_covariance.block<6, 6>(6, 0);
  EXPECT_EQ(kept_between, between);
  KeepViews({false, false}, registration);
  EXPECT_TRUE(registration.views.empty());
  EXPECT_EQ(registration.pose_covariance.size(), 0);
}

}  // namespace
}  // namespace luxfit
