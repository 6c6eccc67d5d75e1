// Surveys with errors of a centimetre: the surfaces of the scene hold the frame, where tags agree with them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "calib/register/internal/survey/tag_surfaces.h"
#include "calib/register/registration.h"
#include "tests/support/calib/feature_room.h"
#include "tests/support/calib/position_sigmas.h"
#include "tests/support/calib/survey_draws.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::FeatureRoom;
using support::LookAt;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kDraws = 6;
constexpr double kNoise_px = 0.03;  // of refined corners
constexpr double kSurvey_m = 0.01;
constexpr double kSticker_m = 0.001;

const Eigen::Vector3d kX = Eigen::Vector3d::UnitX(), kY = Eigen::Vector3d::UnitY(),
                      kZ = Eigen::Vector3d::UnitZ();

// As many tags as in fixtures/office: four on x-walls, five on y-walls, three on the floor. Eight views.
FeatureRoom TaggedRoom() {
  FeatureRoom room;
  room.camera = OfficeCamera({-0.112, 0.061, 4e-4, -7e-4, 0, 0, 0, 0});
  room.tags = {
      {0, 0.2, {0, 0.9, 1.5}, kX, kZ},  {1, 0.2, {0, 3.1, 1.2}, kX, kZ},  {2, 0.2, {6, 1.2, 1.3}, -kX, kZ},
      {3, 0.2, {6, 2.9, 1.6}, -kX, kZ}, {4, 0.2, {1.2, 0, 1.4}, kY, kZ},  {5, 0.2, {3.1, 0, 1.1}, kY, kZ},
      {6, 0.2, {4.9, 0, 1.6}, kY, kZ},  {7, 0.2, {1.9, 4, 1.5}, -kY, kZ}, {8, 0.2, {4.2, 4, 1.2}, -kY, kZ},
      {9, 0.2, {2.0, 1.6, 0}, kZ, kX},  {10, 0.2, {3.8, 2.3, 0}, kZ, kX}, {11, 0.2, {2.9, 1.1, 0}, kZ, kX}};
  const std::array<std::array<Eigen::Vector3d, 2>, 8> looks{{{{{0.6, 0.6, 1.8}, {3.6, 2.3, 0.7}}},
                                                             {{{5.4, 0.6, 1.5}, {2.4, 2.3, 0.8}}},
                                                             {{{5.4, 3.4, 1.9}, {2.4, 1.7, 0.6}}},
                                                             {{{0.6, 3.4, 1.6}, {3.6, 1.7, 0.8}}},
                                                             {{{3.0, 0.5, 1.7}, {3.0, 3.0, 0.7}}},
                                                             {{{3.0, 3.5, 1.4}, {3.0, 1.0, 0.8}}},
                                                             {{{0.5, 2.0, 1.7}, {4.0, 2.0, 0.6}}},
                                                             {{{5.5, 2.0, 1.6}, {2.0, 2.0, 0.7}}}}};
  for (const auto& [from, at] : looks) room.poses.push_back(LookAt(from, at));
  return room;
}

// A square about `center`, of two triangles.
void AddSquare(const Eigen::Vector3d& center, const Eigen::Vector3d& half_a, const Eigen::Vector3d& half_b,
               TriangleSurface& surface) {
  const auto first = static_cast<int>(surface.vertices_m.cols());
  surface.vertices_m.conservativeResize(Eigen::NoChange, first + 4);
  surface.vertices_m.rightCols<4>() << center - half_a - half_b, center + half_a - half_b,
      center + half_a + half_b, center - half_a + half_b;
  surface.triangles.conservativeResize(Eigen::NoChange, surface.triangles.cols() + 2);
  surface.triangles.rightCols<2>() << first, first, first + 1, first + 2, first + 2, first + 3;
}

// The room's walls, floor and ceiling, wound as they come.
TriangleSurface Walls(const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) {
  TriangleSurface surface;
  const Eigen::Vector3d size(support::kRoomSize[0], support::kRoomSize[1], support::kRoomSize[2]);
  for (int axis = 0; axis < 3; ++axis) {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    for (const double side : {0.0, 1.0}) {
      Eigen::Vector3d center = size / 2;
      center[axis] = side * size[axis];
      AddSquare(center + shift, size[a] / 2 * Eigen::Vector3d::Unit(a),
                size[b] / 2 * Eigen::Vector3d::Unit(b), surface);
    }
  }
  return surface;
}

// The tags as they really hang: stickers that are off the surface by the sigma assumed.
std::vector<SurveyedTag> Hung(const FeatureRoom& room, std::mt19937_64& rng) {
  std::normal_distribution<double> normal(0, kSticker_m);
  std::vector<SurveyedTag> hung = room.tags;
  for (SurveyedTag& tag : hung) tag.center_in_world += normal(rng) * tag.normal_in_world;
  return hung;
}

RegisterViewsOptions On(const TriangleSurface& surface) {
  RegisterViewsOptions options;
  options.surface = surface;
  return options;
}

double SquaredCentreErrors(const Eigen::VectorXd& pose_errors) {
  double sum = 0;
  for (Eigen::Index at = 0; at < pose_errors.size(); at += 6)
    sum += pose_errors.segment<3>(at + 3).squaredNorm();
  return sum;
}

// Of all poses together: 6 parameters for each view.
double Chi2(const Registration& registration, const FeatureRoom& room) {
  const Eigen::VectorXd errors = support::PoseErrors(registration, room);
  return errors.dot(registration.pose_covariance.ldlt().solve(errors));
}

constexpr double kMostChi2 = 93.2;  // 99.99 % of the 48 parameters

void ExpectSamePoses(const Registration& one, const Registration& other) {
  ASSERT_EQ(one.views.size(), other.views.size());
  for (std::size_t i = 0; i < one.views.size(); ++i)
    EXPECT_EQ(one.views[i].cam_from_world.matrix(), other.views[i].cam_from_world.matrix());
  EXPECT_EQ(one.pose_covariance, other.pose_covariance);
}

// The normal equations of this room predict errors of 3.4 mm without surfaces and 0.8 mm with them, a ratio of
// 4.2. Twenty draws of six common parameters scatter either by 6 %. The joint chi2 has 960 parameters.
TEST(TagsOnSurfacesTest, TheFrameIsHeldByTheSurfaces) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = TaggedRoom();
  double squared_by_survey = 0, squared_on_surfaces = 0, joint = 0, parameters = 0, sigma_m = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const std::vector<SurveyedTag> survey = support::SurveyOf(room, kSurvey_m, rng);
    const std::vector<ViewDetections> views = support::DetectTagsInAll(room, Hung(room, rng), kNoise_px, rng);
    const Registration by_survey = RegisterViews({room.camera}, survey, views);
    const Registration on_surfaces = RegisterViews({room.camera}, survey, views, On(Walls()));
    ASSERT_EQ(by_survey.views.size(), room.poses.size()) << by_survey.message;
    ASSERT_EQ(on_surfaces.views.size(), room.poses.size()) << on_surfaces.message;
    EXPECT_THAT(by_survey.tags_on_surfaces.reason, IsEmpty());
    const TagsOnSurfaces& laid = on_surfaces.tags_on_surfaces;
    EXPECT_EQ(laid.seen, 12);
    EXPECT_GE(laid.used, 9) << laid.reason;  // few are surveyed beyond reach of their surface
    EXPECT_THAT(laid.reason, HasSubstr("agree with 1.0 mm"));
    ASSERT_FALSE(on_surfaces.notes.empty());
    EXPECT_THAT(on_surfaces.notes.back().message, HasSubstr("of 12 tags lie on surfaces of the mesh"));
    squared_by_survey += SquaredCentreErrors(support::PoseErrors(by_survey, room));
    squared_on_surfaces += SquaredCentreErrors(support::PoseErrors(on_surfaces, room));
    joint += Chi2(on_surfaces, room);
    parameters += static_cast<double>(6 * on_surfaces.views.size());
    sigma_m += on_surfaces.survey_sigma_m / kDraws;
  }
  const double gain = std::sqrt(squared_by_survey / squared_on_surfaces);
  RecordProperty("gain", std::to_string(gain));
  RecordProperty("joint", std::to_string(joint / parameters));
  RecordProperty("sigma_m", std::to_string(sigma_m));
  EXPECT_GT(gain, 2.5);
  EXPECT_GT(joint / parameters, 0.5);
  EXPECT_LT(joint / parameters, 1.6);
  EXPECT_GT(sigma_m, kSurvey_m / 1.5);
  EXPECT_LT(sigma_m, kSurvey_m * 1.5);
}

TEST(TagsOnSurfacesTest, AnExactSurveyTriesNoSurface) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = TaggedRoom();
  const std::vector<ViewDetections> views = support::DetectTagsInAll(room, room.tags, kNoise_px, rng);
  const Registration by_survey = RegisterViews({room.camera}, room.tags, views);
  for (const double mesh_error_m : {0.0, 0.05}) {
    const TriangleSurface walls = Walls(mesh_error_m * Eigen::Vector3d::Ones());
    const Registration registration = RegisterViews({room.camera}, room.tags, views, On(walls));
    EXPECT_THAT(registration.tags_on_surfaces.reason, IsEmpty());
    EXPECT_EQ(registration.tags_on_surfaces.used, 0);
    EXPECT_EQ(registration.survey_sigma_m, RegisterViewsOptions().survey_sigma_m);
    ExpectSamePoses(registration, by_survey);
  }
}

// The surveyor measured the wall behind the board.
TEST(TagsOnSurfacesTest, ATagOnABoardLeavesTheWall) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = TaggedRoom();
  constexpr std::size_t kOnBoard = 5;
  for (int draw = 0; draw < 5; ++draw) {
    std::vector<SurveyedTag> survey = support::SurveyOf(room, kSurvey_m, rng);
    survey[kOnBoard].center_in_world.y() = 0.002;
    std::vector<SurveyedTag> hung = Hung(room, rng);
    hung[kOnBoard].center_in_world.y() = 0.015;
    const Registration registration = RegisterViews(
        {room.camera}, survey, support::DetectTagsInAll(room, hung, kNoise_px, rng), On(Walls()));
    ASSERT_EQ(registration.views.size(), room.poses.size()) << registration.message;
    const TagsOnSurfaces& laid = registration.tags_on_surfaces;
    EXPECT_EQ(laid.used, laid.candidates - 1) << laid.reason;
    EXPECT_THAT(laid.reason, HasSubstr("off theirs by more than 4 sigma: 1"));
    EXPECT_LT(Chi2(registration, room), kMostChi2);
    support::ExpectPositionSigmasBelow(2.9, registration);  // 1.9 mm without the tag on the board
  }
}

// A mesh that was drawn by eye: a piece of wall behind each tag, each at another depth.
TEST(TagsOnSurfacesTest, SurfacesThatTheTagsContradictAreRefused) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = TaggedRoom();
  const std::array<double, 12> depths_m{0.014, -0.016, 0.015, -0.013, 0.016,  -0.017,
                                        0.014, -0.015, 0.016, 0.015,  -0.016, -0.014};
  TriangleSurface pieces;
  for (std::size_t t = 0; t < depths_m.size(); ++t) {
    const SurveyedTag& tag = room.tags[t];
    AddSquare(tag.center_in_world + depths_m[t] * tag.normal_in_world, 0.3 * tag.up_in_world,
              0.3 * tag.up_in_world.cross(tag.normal_in_world), pieces);
  }
  const std::vector<SurveyedTag> survey = support::SurveyOf(room, kSurvey_m, rng);
  const std::vector<ViewDetections> views = support::DetectTagsInAll(room, room.tags, kNoise_px, rng);
  const Registration registration = RegisterViews({room.camera}, survey, views, On(pieces));
  EXPECT_EQ(registration.tags_on_surfaces.used, 0);
  EXPECT_GE(registration.tags_on_surfaces.candidates, 6);
  EXPECT_FALSE(registration.tags_on_surfaces.reason.empty());
  ASSERT_FALSE(registration.notes.empty());
  EXPECT_THAT(registration.notes.back().message, HasSubstr("surfaces of the mesh do not help"));
  ExpectSamePoses(registration, RegisterViews({room.camera}, survey, views));
}

// Two tags hang on a wall that the mesh has too far out. They leave it, or all tags keep their surveyed places.
TEST(TagsOnSurfacesTest, AWallThatTheMeshHasWrongMovesNoCamera) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = TaggedRoom();
  TriangleSurface walls = Walls();
  constexpr int kFirstOfFarWall = 4;  // vertices of the wall x = 6
  walls.vertices_m.block<1, 4>(0, kFirstOfFarWall).array() += 0.025;
  for (int draw = 0; draw < 8; ++draw) {
    const Registration registration =
        RegisterViews({room.camera}, support::SurveyOf(room, kSurvey_m, rng),
                      support::DetectTagsInAll(room, Hung(room, rng), kNoise_px, rng), On(walls));
    ASSERT_EQ(registration.views.size(), room.poses.size()) << registration.message;
    EXPECT_LT(Chi2(registration, room), kMostChi2) << registration.tags_on_surfaces.reason;
    // 2.1 mm where the two tags leave their wall, 6.1 mm by the survey alone.
    support::ExpectPositionSigmasBelow(registration.tags_on_surfaces.used > 0 ? 3.2 : 9.2, registration);
  }
}

class SurfaceUnderTagTest : public testing::Test {
 protected:
  // A desk of 40 mm at a height of 0.7 m.
  SurfaceUnderTagTest() {
    AddSquare({1, 1, 0.74}, 0.5 * kX, 0.5 * kY, desk_);
    AddSquare({1, 1, 0.70}, 0.5 * kY, 0.5 * kX, desk_);
  }

  static SurveyedTag TagAt(const Eigen::Vector3d& center, double tilt_rad = 0) {
    const Eigen::AngleAxisd tilt(tilt_rad, kX);
    return {7, 0.2, center, tilt * kZ, tilt * kY};
  }

  TriangleSurface desk_;
};

TEST_F(SurfaceUnderTagTest, FindsTheSurfaceOfEitherWinding) {
  const std::optional<SurfacePlane> top = SurfaceUnderTag(TagAt({1.1, 1.2, 0.755}), desk_, {});
  ASSERT_TRUE(top);
  EXPECT_TRUE(top->normal.isApprox(kZ));
  EXPECT_TRUE(top->on_surface.isApprox(Eigen::Vector3d(1.1, 1.2, 0.74)));
  EXPECT_EQ(top->sigma_m, 0.001);
  const std::optional<SurfacePlane> underside = SurfaceUnderTag(TagAt({1, 1, 0.68}), desk_, {});
  ASSERT_TRUE(underside);
  EXPECT_TRUE(underside->normal.isApprox(kZ));
  EXPECT_NEAR(underside->on_surface.z(), 0.70, 1e-12);
}

TEST_F(SurfaceUnderTagTest, RefusesWhatIsFarBesideOblique) {
  EXPECT_FALSE(SurfaceUnderTag(TagAt({1, 1, 0.78}), desk_, {}));
  EXPECT_FALSE(SurfaceUnderTag(TagAt({1.6, 1, 0.75}), desk_, {}));
  EXPECT_FALSE(SurfaceUnderTag(TagAt({1, 1, 0.75}, 0.2), desk_, {}));
  EXPECT_FALSE(SurfaceUnderTag(TagAt({1, 1, 0.75}), TriangleSurface(), {}));
}

TEST_F(SurfaceUnderTagTest, RefusesTwoSurfacesWithinReach) {
  EXPECT_FALSE(SurfaceUnderTag(TagAt({1, 1, 0.72}), desk_, {}));
  EXPECT_FALSE(SurfaceUnderTag(TagAt({1, 1, 0.75}), desk_, {0.06, 0.001}));
}

TEST_F(SurfaceUnderTagTest, LaysTheTagDownAndTurnsItBeyondADegree) {
  for (const double tilt_rad : {0.01, 0.05}) {
    const SurveyedTag tag = TagAt({1, 1, 0.75}, tilt_rad);
    const std::optional<SurfacePlane> plane = SurfaceUnderTag(tag, desk_, {});
    ASSERT_TRUE(plane);
    const SurveyedTag laid = LaidOn(*plane, tag);
    EXPECT_NEAR(laid.center_in_world.z(), 0.74, 1e-12);
    EXPECT_TRUE(laid.normal_in_world.isApprox(tilt_rad > 0.02 ? kZ : tag.normal_in_world));
    EXPECT_NEAR(laid.normal_in_world.dot(laid.up_in_world), 0, 1e-12);
    EXPECT_EQ(laid.id, tag.id);
  }
}

}  // namespace
}  // namespace luxfit
