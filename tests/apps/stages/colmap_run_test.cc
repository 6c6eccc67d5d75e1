#include "apps/stages/register/colmap_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "calib/register/colmap_files.h"
#include "tests/support/calib/colmap_installed.h"
#include "tests/support/calib/feature_room.h"
#include "tests/support/temp_folder.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

// White walls, and nothing on them but tags; small pictures, since COLMAP looks for features all the same.
support::FeatureRoom WhiteRoom(int views, int tags, std::mt19937_64& rng) {
  support::FeatureRoom room = support::MakeFeatureRoom(views, tags, 0, rng);
  Camera& camera = room.camera;
  camera.width_px /= 3;
  camera.height_px /= 3;
  for (double* value : {&camera.fx_px, &camera.fy_px, &camera.cx_px, &camera.cy_px}) *value /= 3;
  return room;
}

std::vector<ColmapPicture> BlankPictures(const support::FeatureRoom& room, std::mt19937_64& rng) {
  std::vector<ColmapPicture> pictures;
  for (std::size_t v = 0; v < room.poses.size(); ++v) {
    pictures.push_back({support::ViewName(v),
                        0,
                        ImagePlane::Constant(room.camera.height_px, room.camera.width_px, 0.5F),
                        support::DetectTagsOf(room, room.tags, v, 0.03, rng).tags,
                        {}});
  }
  return pictures;
}

// Walls with spots of all sizes from 2 cm to 30 cm, by the value noise of a hash of their place.
float Spots(const Eigen::Vector3d& place) {
  float sum = 0;
  for (const double size_m : {0.3, 0.12, 0.05, 0.02}) {
    const Eigen::Vector3d at = place / size_m + Eigen::Vector3d(0.5, 0.5, 0.5);
    const Eigen::Vector3d cell = at.array().floor();
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d node = cell + Eigen::Vector3d(corner & 1, corner >> 1 & 1, corner >> 2);
      const double weight = (1 - (at - node).array().abs()).prod();
      const double wave = std::sin(node.dot(Eigen::Vector3d(12.9898, 78.233, 37.719))) * 43758.5453;
      sum += static_cast<float>(weight * (wave - std::floor(wave)) / 4);
    }
  }
  return sum;
}

Eigen::Vector3d OnWalls(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
  double distance = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double wall = direction[axis] > 0 ? support::kRoomSize[axis] : 0;
    if (direction[axis] != 0) distance = std::min(distance, (wall - from[axis]) / direction[axis]);
  }
  return from + distance * direction;
}

std::vector<ColmapPicture> SpottedPictures(const support::FeatureRoom& room) {
  std::vector<ColmapPicture> pictures;
  for (std::size_t v = 0; v < room.poses.size(); ++v) {
    const Eigen::Isometry3d world_from_cam = room.poses[v].inverse();
    ImagePlane luminance(room.camera.height_px, room.camera.width_px);
    for (Eigen::Index y = 0; y < luminance.rows(); ++y) {
      for (Eigen::Index x = 0; x < luminance.cols(); ++x) {
        const Eigen::Vector2d pixel(static_cast<double>(x), static_cast<double>(y));
        luminance(y, x) = Spots(
            OnWalls(world_from_cam.translation(), world_from_cam.linear() * Unproject(room.camera, pixel)));
      }
    }
    pictures.push_back({support::ViewName(v), 0, luminance, {}, {}});
  }
  return pictures;
}

// The survey knows eight of the tags; the others are features that hold the views together.
void ExpectTheRoom(const support::FeatureRoom& room, const ColmapRun& run,
                   const std::vector<ColmapPicture>& pictures) {
  ASSERT_FALSE(run.model_folder.empty());
  const FeatureModel features = FeaturesOf(ReadColmapModel(run.model_folder), run.view_of_image);
  EXPECT_EQ(features.views.size(), room.poses.size());
  const std::vector<SurveyedTag> survey(room.tags.begin(), room.tags.begin() + 8);
  std::vector<ViewDetections> detections;
  for (const ColmapPicture& picture : pictures) detections.push_back({picture.view, 0, picture.tags});
  const Registration registration = RegisterViews({room.camera}, survey, detections, features);
  ASSERT_EQ(registration.views.size(), room.poses.size()) << registration.message;
  EXPECT_GT(registration.points, 100);
  for (std::size_t v = 0; v < room.poses.size(); ++v) {
    EXPECT_GT(registration.views[v].points_used, 20);
    // 6 degrees of freedom: above 27.9 once in 10 000; a third of the office's resolution leaves a
    // centimetre.
    EXPECT_LT(support::NormalisedError(registration.views[v], room.poses[v]), 27.9) << v;
    EXPECT_LT(support::PoseError(registration.views[v], room.poses[v]).tail<3>().norm(), 0.02) << v;
  }
}

TEST(ColmapRunTest, TagCornersRegisterAWhiteRoomAndRepeat) {
  LUXFIT_SKIP_WITHOUT_COLMAP();
  std::mt19937_64 rng = support::TestRng();
  const support::FeatureRoom room = WhiteRoom(10, 60, rng);
  const std::vector<ColmapPicture> pictures = BlankPictures(room, rng);
  const TempFolder folder;
  const ColmapRun run = RunColmap(pictures, {room.camera}, folder.Path("colmap"));
  ExpectTheRoom(room, run, pictures);
  EXPECT_THAT(folder.Read("colmap/colmap.log"), testing::HasSubstr("$ colmap mapper"));
  const std::string once = ColmapImagesText(ReadColmapModel(run.model_folder));
  const ColmapRun again = RunColmap(pictures, {room.camera}, folder.Path("again"));
  EXPECT_EQ(once, ColmapImagesText(ReadColmapModel(again.model_folder)));
}

TEST(ColmapRunTest, FeaturesGiveTheSameModelInEveryRun) {
  LUXFIT_SKIP_WITHOUT_COLMAP();
  std::mt19937_64 rng = support::TestRng();
  const support::FeatureRoom room = WhiteRoom(14, 0, rng);
  const std::vector<ColmapPicture> pictures = SpottedPictures(room);
  const TempFolder folder;
  const ColmapRun run = RunColmap(pictures, {room.camera}, folder.Path("colmap"));
  ASSERT_FALSE(run.model_folder.empty());
  const ColmapModel model = ReadColmapModel(run.model_folder);
  EXPECT_EQ(model.images.size(), pictures.size());
  EXPECT_GT(model.points.size(), 300);
  const ColmapRun again = RunColmap(pictures, {room.camera}, folder.Path("again"));
  EXPECT_EQ(folder.Read("colmap/matches.txt"), folder.Read("again/matches.txt"));
  EXPECT_EQ(ColmapImagesText(model), ColmapImagesText(ReadColmapModel(again.model_folder)));
}

TEST(ColmapRunTest, StartsFromPosesThatAreKnown) {
  LUXFIT_SKIP_WITHOUT_COLMAP();
  std::mt19937_64 rng = support::TestRng();
  const support::FeatureRoom room = WhiteRoom(10, 60, rng);
  std::vector<ColmapPicture> pictures = BlankPictures(room, rng);
  for (std::size_t v = 0; v < 7; ++v) pictures[v].cam_from_world = room.poses[v];
  const TempFolder folder;
  ExpectTheRoom(room, RunColmap(pictures, {room.camera}, folder.Path("colmap")), pictures);
  EXPECT_THAT(folder.Read("colmap/colmap.log"), testing::HasSubstr("$ colmap point_triangulator"));
}

TEST(ColmapRunTest, NoMatchesAreNoModelAndNoError) {
  LUXFIT_SKIP_WITHOUT_COLMAP();
  std::mt19937_64 rng = support::TestRng();
  const support::FeatureRoom room = WhiteRoom(3, 0, rng);
  const TempFolder folder;
  EXPECT_EQ(RunColmap(BlankPictures(room, rng), {room.camera}, folder.Path("colmap")).model_folder, "");
}

TEST(ColmapRunTest, AStepThatTakesTooLongIsNamed) {
  LUXFIT_SKIP_WITHOUT_COLMAP();
  std::mt19937_64 rng = support::TestRng();
  const support::FeatureRoom room = WhiteRoom(3, 4, rng);
  const TempFolder folder;
  ColmapRunOptions options;
  options.time_limit_s = 0.001;
  try {
    RunColmap(BlankPictures(room, rng), {room.camera}, folder.Path("colmap"), options);
    FAIL() << "expected a time-out";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(),
                testing::AllOf(testing::HasSubstr("colmap.log"), testing::HasSubstr("feature_extractor"),
                               testing::HasSubstr("took longer than allowed")));
  }
}

TEST(ColmapDatabaseTest, WhatIsNoDatabaseIsNamed) {
  const TempFolder folder;
  folder.Write("text.db", "not a database, though long enough to be mistaken for one by its size alone");
  EXPECT_THROW(MatchColmapImages(folder.Path("text.db"), {}), std::runtime_error);
  EXPECT_THROW(ReadColmapImageIds(folder.Path("none.db")), std::runtime_error);
}

}  // namespace
}  // namespace luxfit
