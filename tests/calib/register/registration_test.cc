#include "calib/register/registration.h"
#include "tests/support/calib/look_at.h"
#include "tests/support/calib/office_camera.h"
#include "tests/support/calib/position_sigmas.h"
#include "tests/support/test_rng.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <stdexcept>

namespace luxfit {
namespace {

Camera WideCamera() { return OfficeCamera({-0.112, 0.061, 4e-4, -7e-4, 0, 0, 0, 0}); }

SurveyedTag Tag(int id, const Eigen::Vector3d& center, const Eigen::Vector3d& normal,
                const Eigen::Vector3d& up) {
  SurveyedTag tag;
  tag.id = id;
  tag.size_m = 0.2;
  tag.center_in_world = center;
  tag.normal_in_world = normal;
  tag.up_in_world = up;
  return tag;
}

// The corner x = 0, y = 0 of a room: three tags on one wall, two on the other, one on the floor.
std::vector<SurveyedTag> RoomCorner() {
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ(), x = Eigen::Vector3d::UnitX(),
                        y = Eigen::Vector3d::UnitY();
  return {Tag(0, {0, 0.8, 1.5}, x, z), Tag(1, {0, 1.7, 1.1}, x, z), Tag(2, {0, 1.3, 1.9}, x, z),
          Tag(3, {0.9, 0, 1.4}, y, z), Tag(4, {1.8, 0, 1.8}, y, z), Tag(5, {1.0, 1.0, 0}, z, -x)};
}

using support::LookAt;

std::vector<Eigen::Isometry3d> FourPoses() {
  return {LookAt({3.2, 2.6, 1.6}, {0.4, 0.4, 1.3}), LookAt({2.6, 3.2, 1.2}, {0.3, 0.6, 1.2}),
          LookAt({3.4, 1.8, 1.9}, {0.3, 0.5, 1.2}), LookAt({2.2, 2.4, 1.5}, {0.3, 0.3, 1.2})};
}

struct Noise {
  double corner_px = 0;
  double sigma_px = 0.1;  // what the detections claim
};

// What a view sees of tags that really hang as `truth` says: those that face it and lie wholly in the
// picture.
ViewDetections Detect(const std::string& name, const Eigen::Isometry3d& cam_from_world,
                      const std::vector<SurveyedTag>& truth, const Noise& noise, std::mt19937_64& rng) {
  const Camera camera = WideCamera();
  std::normal_distribution<double> normal(0, 1);
  ViewDetections view;
  view.view = name;
  for (const SurveyedTag& tag : truth) {
    const Eigen::Vector3d from = cam_from_world.inverse().translation() - tag.center_in_world;
    if (from.normalized().dot(tag.normal_in_world) < 0.2) continue;
    TagDetection detection;
    detection.id = tag.id;
    detection.side_px = 742 * tag.size_m / from.norm();
    detection.corner_sigma_px = noise.sigma_px;
    bool inside = true;
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector2d pixel = Project(camera, cam_from_world * TagCornersInWorld(tag)[i]);
      inside = inside && pixel.allFinite() && pixel.minCoeff() > 0 && pixel.x() < 959 && pixel.y() < 719;
      detection.corners_px[i] = pixel + noise.corner_px * Eigen::Vector2d(normal(rng), normal(rng));
    }
    if (inside) view.tags.push_back(detection);
  }
  return view;
}

std::vector<ViewDetections> DetectAll(const std::vector<SurveyedTag>& truth, const Noise& noise,
                                      std::mt19937_64& rng) {
  std::vector<ViewDetections> views;
  for (const Eigen::Isometry3d& pose : FourPoses()) {
    views.push_back(Detect("v" + std::to_string(views.size()), pose, truth, noise, rng));
  }
  return views;
}

RegisterViewsOptions Exact() {
  RegisterViewsOptions options;
  options.survey_sigma_m = 0;
  options.tag_size_sigma = 0;
  return options;
}

// (rotation vector in world axes, camera centre), estimate against truth.
Eigen::Matrix<double, 6, 1> PoseError(const RegisteredView& view, const Eigen::Isometry3d& truth) {
  const Eigen::Isometry3d estimated = view.cam_from_world.inverse(), true_pose = truth.inverse();
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(estimated.linear() * true_pose.linear().transpose()));
  Eigen::Matrix<double, 6, 1> error;
  error << turn.angle() * turn.axis(), estimated.translation() - true_pose.translation();
  return error;
}

// e^T C^-1 e with 6 degrees of freedom: above kLikely once in 10 000.
constexpr double kLikely = 27.9;
double NormalisedError(const RegisteredView& view, const Eigen::Isometry3d& truth) {
  const Eigen::Matrix<double, 6, 1> error = PoseError(view, truth);
  return error.dot(view.covariance.ldlt().solve(error));
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

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(RegistrationTest, RecoversTheTruthWithoutNoise) {
  std::mt19937_64 rng = support::TestRng();
  const Registration registration =
      RegisterViews({WideCamera()}, RoomCorner(), DetectAll(RoomCorner(), {}, rng), Exact());
  ASSERT_TRUE(registration.IsUsable()) << registration.message;
  ASSERT_EQ(registration.views.size(), 4u);
  EXPECT_THAT(Codes(registration), IsEmpty());
  EXPECT_LT(registration.reprojection_rms_px, 1e-6);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(registration.views[i].view, "v" + std::to_string(i));
    EXPECT_LT(PoseError(registration.views[i], FourPoses()[i]).norm(), 1e-8);
    EXPECT_EQ(registration.views[i].corners_rejected, 0);
    EXPECT_GE(registration.views[i].tags_used, 4);
  }
}

// e^T C^-1 e has 6 degrees of freedom. Over 40 draws of four views the mean is 6 with a standard error of
// sqrt(12 / 160) = 0.27; reduced chi2 >= 1 can only lower it, by about its own scatter of 5 %. Five standard
// errors.
TEST(RegistrationTest, CovarianceEqualsMonteCarlo) {
  std::mt19937_64 rng = support::TestRng();
  double sum = 0;
  int count = 0;
  double rms2 = 0;
  constexpr int kDraws = 40;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Registration registration =
        RegisterViews({WideCamera()}, RoomCorner(), DetectAll(RoomCorner(), {0.1, 0.1}, rng), Exact());
    ASSERT_TRUE(registration.IsUsable());
    for (std::size_t i = 0; i < registration.views.size(); ++i) {
      sum += NormalisedError(registration.views[i], FourPoses()[i]);
      EXPECT_NEAR(registration.views[i].position_sigma_m.x(),
                  std::sqrt(registration.views[i].covariance(3, 3)), 1e-12);
      ++count;
    }
    rms2 += registration.reprojection_rms_px * registration.reprojection_rms_px / kDraws;
  }
  EXPECT_EQ(count, 4 * kDraws);
  EXPECT_NEAR(sum / count, 6, 1.35);
  // 2-D rms of 0.1 px per axis is 0.141, less what the poses take up.
  EXPECT_GT(std::sqrt(rms2), 0.11);
  EXPECT_LT(std::sqrt(rms2), 0.142);
}

// The survey itself is off by 2 mm and the print by 0.4 %: with both as unknowns the covariance still holds.
TEST(RegistrationTest, CovarianceCarriesSurveyAndPrint) {
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<double> normal(0, 1);
  RegisterViewsOptions options;
  options.survey_sigma_m = 0.002;
  options.tag_size_sigma = 0.005;
  double sum = 0, size_sum = 0;
  constexpr int kDraws = 60;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<SurveyedTag> truth = RoomCorner();
    const double size_error = options.tag_size_sigma * normal(rng);
    for (SurveyedTag& tag : truth) {
      tag.size_m *= 1 + size_error;
      tag.center_in_world += options.survey_sigma_m * Eigen::Vector3d(normal(rng), normal(rng), normal(rng));
    }
    const Registration registration =
        RegisterViews({WideCamera()}, RoomCorner(), DetectAll(truth, {0.05, 0.05}, rng), options);
    ASSERT_TRUE(registration.IsUsable()) << registration.message;
    ASSERT_EQ(registration.views.size(), 4u);
    EXPECT_THAT(Codes(registration), IsEmpty());
    // The four views share the survey's errors, so one of them speaks for all.
    sum += NormalisedError(registration.views[0], FourPoses()[0]);
    size_sum += std::pow((registration.tag_size_error - size_error) / registration.tag_size_error_sigma, 2);
  }
  // Mean of 60 chi2 with 6 (1) degrees of freedom: standard errors sqrt(12 / 60) = 0.45 and sqrt(2 / 60) =
  // 0.18; four.
  EXPECT_NEAR(sum / kDraws, 6, 1.8);
  EXPECT_NEAR(size_sum / kDraws, 1, 0.75);
}

// Claimed 0.05 px, really 0.2: the residuals tell, and the covariance grows with them.
TEST(RegistrationTest, UnderstatedSigmasAreScaledUp) {
  std::mt19937_64 rng = support::TestRng();
  std::mt19937_64 same = rng;
  const Registration honest =
      RegisterViews({WideCamera()}, RoomCorner(), DetectAll(RoomCorner(), {0.2, 0.2}, rng), Exact());
  const Registration bold =
      RegisterViews({WideCamera()}, RoomCorner(), DetectAll(RoomCorner(), {0.2, 0.05}, same), Exact());
  ASSERT_EQ(bold.views.size(), 4u);
  // The Huber loss weighs what it calls outliers down: 30 %.
  EXPECT_NEAR(bold.views[0].position_sigma_m.norm() / honest.views[0].position_sigma_m.norm(), 1, 0.3);
}

TEST(RegistrationTest, NoTagsIsANoteNotAnError) {
  std::mt19937_64 rng = support::TestRng();
  std::vector<ViewDetections> detections = DetectAll(RoomCorner(), {0.1, 0.1}, rng);
  detections[1].tags.clear();
  const Registration registration = RegisterViews({WideCamera()}, RoomCorner(), detections);
  EXPECT_TRUE(registration.IsUsable());
  EXPECT_EQ(registration.views.size(), 3u);
  EXPECT_THAT(Codes(registration), ElementsAre("no_tags"));
  EXPECT_EQ(registration.notes[0].view, "v1");

  for (ViewDetections& view : detections) view.tags.clear();
  const Registration nothing = RegisterViews({WideCamera()}, RoomCorner(), detections);
  EXPECT_FALSE(nothing.IsUsable());
  EXPECT_FALSE(nothing.message.empty());
  EXPECT_EQ(nothing.notes.size(), 4u);
  EXPECT_FALSE(RegisterViews({WideCamera()}, RoomCorner(), {}).IsUsable());
}

TEST(RegistrationTest, UnknownTagsAreNamedOnce) {
  std::mt19937_64 rng = support::TestRng();
  std::vector<SurveyedTag> truth = RoomCorner();
  truth.push_back(Tag(77, {0, 1.2, 1.3}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ()));
  const Registration registration =
      RegisterViews({WideCamera()}, RoomCorner(), DetectAll(truth, {0.1, 0.1}, rng), Exact());
  EXPECT_EQ(registration.views.size(), 4u);
  EXPECT_THAT(Codes(registration), ElementsAre("tag_unknown"));
  EXPECT_EQ(registration.notes[0].tag_id, 77);
}

TEST(RegistrationTest, ATagSeenTwiceIsLeftOutOfThatView) {
  std::mt19937_64 rng = support::TestRng();
  std::vector<ViewDetections> detections = DetectAll(RoomCorner(), {0.1, 0.1}, rng);
  TagDetection copy = detections[0].tags[0];
  for (Eigen::Vector2d& corner_px : copy.corners_px) corner_px.x() += 150;
  detections[0].tags.push_back(copy);
  const Registration registration = RegisterViews({WideCamera()}, RoomCorner(), detections, Exact());
  ASSERT_EQ(registration.views.size(), 4u);
  EXPECT_THAT(Codes(registration), ElementsAre("tag_duplicated"));
  EXPECT_EQ(registration.notes[0].view, "v0");
  EXPECT_EQ(registration.notes[0].tag_id, copy.id);
  EXPECT_LT(NormalisedError(registration.views[0], FourPoses()[0]), kLikely);
  support::ExpectPositionSigmasBelow(6.4, registration);  // 4.3 mm: view 0, without its first tag
}

// A gross change is caught by the start, a small one (1 cm: a twentieth of the tag) by the adjustment.
TEST(RegistrationTest, MovedTagsAreNamedAndLeftOut) {
  std::mt19937_64 rng = support::TestRng();
  for (const double moved_m : {0.3, 0.05, 0.01}) {
    std::vector<SurveyedTag> truth = RoomCorner();
    truth[1].center_in_world.y() += moved_m;
    const Registration registration =
        RegisterViews({WideCamera()}, RoomCorner(), DetectAll(truth, {0.05, 0.05}, rng));
    ASSERT_TRUE(registration.IsUsable()) << moved_m;
    ASSERT_EQ(registration.views.size(), 4u) << moved_m;
    EXPECT_THAT(Codes(registration), ElementsAre("tag_disagrees")) << moved_m;
    ASSERT_FALSE(registration.notes.empty());
    EXPECT_EQ(registration.notes[0].tag_id, 1);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_LT(NormalisedError(registration.views[i], FourPoses()[i]), kLikely) << moved_m;
    }
    support::ExpectPositionSigmasBelow(4.8, registration);  // 3.2 mm by the five tags left
  }
}

TEST(RegistrationTest, ATagOfTheWrongSizeIsNamedAndLeftOut) {
  std::mt19937_64 rng = support::TestRng();
  std::vector<SurveyedTag> truth = RoomCorner();
  truth[3].size_m = 0.15;
  const Registration registration =
      RegisterViews({WideCamera()}, RoomCorner(), DetectAll(truth, {0.05, 0.05}, rng));
  ASSERT_EQ(registration.views.size(), 4u);
  EXPECT_THAT(Codes(registration), ElementsAre("tag_disagrees"));
  EXPECT_EQ(registration.notes[0].tag_id, 3);
}

// Wrong in one view only (a misread id): that view loses the tag, the others keep it.
TEST(RegistrationTest, OneBadDetectionDoesNotBreakAView) {
  std::mt19937_64 rng = support::TestRng();
  std::vector<ViewDetections> detections = DetectAll(RoomCorner(), {0.05, 0.05}, rng);
  for (Eigen::Vector2d& corner_px : detections[2].tags[0].corners_px) corner_px += Eigen::Vector2d(60, -40);
  const Registration registration = RegisterViews({WideCamera()}, RoomCorner(), detections, Exact());
  ASSERT_EQ(registration.views.size(), 4u);
  EXPECT_THAT(Codes(registration), IsEmpty());
  EXPECT_EQ(registration.views[2].corners_rejected, 4);
  EXPECT_EQ(registration.views[2].tags_used, static_cast<int>(detections[2].tags.size()) - 1);
  EXPECT_LT(NormalisedError(registration.views[2], FourPoses()[2]), kLikely);
  support::ExpectPositionSigmasBelow(2.6, registration);  // 1.7 mm
}

TEST(RegistrationTest, TwoTagsThatContradictEachOtherAreNoPose) {
  std::mt19937_64 rng = support::TestRng();
  ViewDetections view = Detect("v", FourPoses()[0], {RoomCorner()[0], RoomCorner()[3]}, {0.05, 0.05}, rng);
  ASSERT_EQ(view.tags.size(), 2u);
  for (Eigen::Vector2d& corner_px : view.tags[0].corners_px) corner_px += Eigen::Vector2d(80, 50);
  const Registration registration = RegisterViews({WideCamera()}, RoomCorner(), {view});
  EXPECT_FALSE(registration.IsUsable());
  EXPECT_THAT(Codes(registration), ElementsAre("view_disagrees"));
}

TEST(RegistrationTest, OneObliqueTagIsEnough) {
  std::mt19937_64 rng = support::TestRng();
  const std::vector<SurveyedTag> one = {RoomCorner()[0]};
  const Eigen::Isometry3d pose = LookAt({0.8, 1.7, 1.9}, {0, 0.8, 1.5});
  const Registration registration =
      RegisterViews({WideCamera()}, one, {Detect("v", pose, one, {0.03, 0.03}, rng)}, Exact());
  ASSERT_TRUE(registration.IsUsable());
  ASSERT_EQ(registration.views.size(), 1u);
  EXPECT_LT(NormalisedError(registration.views[0], pose), kLikely);
  // 0.77 mm; the reduced chi2 of two degrees of freedom exceeds 4, and doubles it, in one of 55 draws.
  support::ExpectPositionSigmasBelow(1.6, registration);
}

// A far frontal tag: two tilts fit, or the one that fits is loose. Either way there is a note and no pose.
TEST(RegistrationTest, OneFrontalTagIsNoPose) {
  std::mt19937_64 rng = support::TestRng();
  const std::vector<SurveyedTag> one = {RoomCorner()[0]};
  for (int draw = 0; draw < 10; ++draw) {
    const Eigen::Isometry3d pose = LookAt({4.0, 0.85, 1.5}, {0, 0.8, 1.5});
    const Registration registration =
        RegisterViews({WideCamera()}, one, {Detect("v", pose, one, {0.1, 0.1}, rng)});
    EXPECT_FALSE(registration.IsUsable());
    EXPECT_THAT(Codes(registration), Contains(testing::AnyOf("pose_ambiguous", "pose_uncertain")));
  }
}

TEST(RegistrationTest, RefusesWhatHasNoMeaning) {
  std::mt19937_64 rng = support::TestRng();
  std::vector<ViewDetections> detections = DetectAll(RoomCorner(), {}, rng);
  std::vector<SurveyedTag> twice = RoomCorner();
  twice.push_back(twice[0]);
  EXPECT_THROW(RegisterViews({WideCamera()}, twice, detections), std::invalid_argument);
  EXPECT_THROW(RegisterViews({}, RoomCorner(), detections), std::invalid_argument);
  RegisterViewsOptions options;
  options.huber_sigmas = 0;
  EXPECT_THROW(RegisterViews({WideCamera()}, RoomCorner(), detections, options), std::invalid_argument);
  detections[0].tags[0].corner_sigma_px = 0;
  EXPECT_THROW(RegisterViews({WideCamera()}, RoomCorner(), detections), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
