#include "calib/register/mesh_alignment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "calib/register/internal/triangle_tree.h"
#include "tests/support/calib/feature_room.h"
#include "tests/support/calib/position_sigmas.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::FeatureRoom;
using testing::HasSubstr;

// The six sides of the room.
TriangleSurface RoomSurface() {
  TriangleSurface surface;
  surface.vertices_m.resize(3, 8);
  for (int i = 0; i < 8; ++i) {
    surface.vertices_m.col(i) << (i & 1 ? support::kRoomSize[0] : 0), (i & 2 ? support::kRoomSize[1] : 0),
        (i & 4 ? support::kRoomSize[2] : 0);
  }
  const int sides[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                           {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
  surface.triangles.resize(3, 12);
  for (int side = 0; side < 6; ++side) {
    const int* const c = sides[side];
    surface.triangles.col(2 * side) << c[0], c[1], c[2];
    surface.triangles.col(2 * side + 1) << c[0], c[2], c[3];
  }
  return surface;
}

FeatureRoom RoomWithFloor(int views, int points, std::mt19937_64& rng) {
  FeatureRoom room = support::MakeFeatureRoom(views, 0, points, rng);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < points / 3; ++i)
    room.points.emplace_back(support::kRoomSize[0] * uniform(rng), support::kRoomSize[1] * uniform(rng), 0);
  return room;
}

Eigen::Matrix3Xd PointsOf(const FeatureModel& features) {
  Eigen::Matrix3Xd points(3, features.tracks.size());
  for (std::size_t i = 0; i < features.tracks.size(); ++i)
    points.col(static_cast<Eigen::Index>(i)) = features.tracks[i].p_in_model;
  return points;
}

// Where somebody says the cameras stood: three decimetres off.
std::map<std::string, Eigen::Vector3d> RoughPlaces(const FeatureRoom& room, double off_m,
                                                   std::mt19937_64& rng) {
  std::normal_distribution<double> normal(0, 1);
  std::map<std::string, Eigen::Vector3d> places;
  for (const std::size_t v : {0, 2, 4, 6}) {
    const Eigen::Vector3d off = off_m * Eigen::Vector3d(normal(rng), normal(rng), normal(rng)) / std::sqrt(3);
    places[support::ViewName(v)] = room.poses[v].inverse().translation() + off;
  }
  return places;
}

Registration RegisterOnSurface(const FeatureRoom& room, const FeatureModel& features,
                               const SurfaceAlignment& alignment) {
  std::vector<ViewDetections> views;
  for (std::size_t v = 0; v < room.poses.size(); ++v) views.push_back({support::ViewName(v), 0, {}});
  return RegisterViews({room.camera}, {}, views, OnSurface(features, alignment));
}

TEST(TriangleTreeTest, FindsWhatASearchThroughAllFinds) {
  std::mt19937_64 rng = support::TestRng();
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto any = [&] { return Eigen::Vector3d(uniform(rng), uniform(rng), uniform(rng)); };
  Eigen::Matrix3Xd vertices(3, 60);
  Eigen::Matrix3Xi triangles(3, 40);
  for (Eigen::Index i = 0; i < 60; ++i) vertices.col(i) = any();
  for (Eigen::Index i = 0; i < 120; ++i) triangles(i) = static_cast<int>(rng() % 60);
  const TriangleTree tree(vertices, triangles);
  for (int draw = 0; draw < 200; ++draw) {
    const Eigen::Vector3d p = 1.5 * any();
    // Barycentric samples bound the distance from above; the tree's point must lie on its triangle.
    double least = 1e9;
    for (Eigen::Index t = 0; t < 40; ++t) {
      for (int a = 0; a <= 40; ++a) {
        for (int b = 0; b <= 40 - a; ++b) {
          const Eigen::Vector3d q = (a * vertices.col(triangles(0, t)) + b * vertices.col(triangles(1, t)) +
                                     (40 - a - b) * vertices.col(triangles(2, t))) /
                                    40.0;
          least = std::min(least, (q - p).norm());
        }
      }
    }
    const NearestPoint nearest = tree.Nearest(p);
    EXPECT_NEAR((nearest.p - p).norm(), std::sqrt(nearest.squared_distance), 1e-12);
    EXPECT_LE(std::sqrt(nearest.squared_distance), least + 1e-12);
    EXPECT_GE(std::sqrt(nearest.squared_distance), least - 0.06);  // samples are a fortieth of a side apart
  }
}

TEST(MeshAlignmentTest, PosesComeFromTheMeshAloneWithoutTags) {
  std::mt19937_64 rng = support::TestRng();
  const FeatureRoom room = RoomWithFloor(8, 300, rng);
  const FeatureModel features = support::FeaturesOfRoom(room, {0.3, 0, 0.004}, support::AnySimilarity(), rng);
  const std::optional<Similarity> start = StartFromPlaces(features.views, RoughPlaces(room, 0.3, rng));
  ASSERT_TRUE(start);
  const SurfaceAlignment alignment = AlignPointsToSurface(PointsOf(features), RoomSurface(), *start);
  ASSERT_TRUE(alignment.is_determined) << alignment.message;
  const Similarity truth = support::AnySimilarity().Inverse();
  EXPECT_NEAR(alignment.world_from_points.scale / truth.scale, 1, 0.002);
  const Registration registration = RegisterOnSurface(room, features, alignment);
  ASSERT_EQ(registration.views.size(), 8u) << registration.message;
  EXPECT_EQ(registration.frame, "surface");
  EXPECT_TRUE(registration.notes.empty());
  for (std::size_t v = 0; v < 8; ++v) {
    EXPECT_LT(support::PoseError(registration.views[v], room.poses[v]).tail<3>().norm(), 0.01) << v;
    EXPECT_LT(support::NormalisedError(registration.views[v], room.poses[v]), 27.9) << v;
  }
  support::ExpectPositionSigmasBelow(11, registration);  // 7.2 mm: pixels of 0.3, walls of 2 mm
}

// Furniture that the mesh has not: a fifth of the points hang in the air.
TEST(MeshAlignmentTest, PointsOffTheMeshDoNotCount) {
  std::mt19937_64 rng = support::TestRng();
  FeatureRoom room = RoomWithFloor(8, 300, rng);
  std::uniform_real_distribution<double> uniform(0.2, 0.8);
  for (int i = 0; i < 80; ++i)
    room.points.emplace_back(support::kRoomSize[0] * uniform(rng), support::kRoomSize[1] * uniform(rng),
                             uniform(rng));
  const FeatureModel features = support::FeaturesOfRoom(room, {0.3, 0, 0.004}, support::AnySimilarity(), rng);
  const SurfaceAlignment alignment = AlignPointsToSurface(
      PointsOf(features), RoomSurface(), *StartFromPlaces(features.views, RoughPlaces(room, 0.2, rng)));
  ASSERT_TRUE(alignment.is_determined) << alignment.message;
  const Registration registration = RegisterOnSurface(room, features, alignment);
  ASSERT_EQ(registration.views.size(), 8u) << registration.message;
  for (std::size_t v = 0; v < 8; ++v)
    EXPECT_LT(support::PoseError(registration.views[v], room.poses[v]).tail<3>().norm(), 0.01) << v;
}

TEST(MeshAlignmentTest, OneWallLeavesDirectionsFreeAndSaysSo) {
  std::mt19937_64 rng = support::TestRng();
  std::uniform_real_distribution<double> uniform(0, 1);
  Eigen::Matrix3Xd wall(3, 200);
  for (Eigen::Index i = 0; i < 200; ++i) wall.col(i) << 0, 4 * uniform(rng), 2.8 * uniform(rng);
  const SurfaceAlignment alignment = AlignPointsToSurface(wall, RoomSurface(), Similarity());
  EXPECT_FALSE(alignment.is_determined);
  EXPECT_THAT(alignment.message, HasSubstr("leave a direction free"));
}

TEST(MeshAlignmentTest, AnotherRoomAndHopelessStartsAreRefused) {
  std::mt19937_64 rng = support::TestRng();
  std::uniform_real_distribution<double> uniform(0, 1);
  Eigen::Matrix3Xd cloud(3, 300);
  for (Eigen::Index i = 0; i < 300; ++i)
    cloud.col(i) << 3 + 2 * (uniform(rng) - 0.5), 2 + 2 * (uniform(rng) - 0.5), 1.4 + uniform(rng) - 0.5;
  const SurfaceAlignment other = AlignPointsToSurface(cloud, RoomSurface(), Similarity());
  EXPECT_FALSE(other.is_determined);
  EXPECT_FALSE(other.message.empty());
  const SurfaceAlignment few = AlignPointsToSurface(cloud.leftCols(5), RoomSurface(), Similarity());
  EXPECT_THAT(few.message, HasSubstr("12 and more are needed"));
  EXPECT_FALSE(StartFromPlaces({{"a", Eigen::Isometry3d::Identity()}}, {{"a", Eigen::Vector3d::Zero()}}));
  EXPECT_THROW(AlignPointsToSurface(cloud, TriangleSurface(), Similarity()), std::invalid_argument);
}

// The alignment's own sigmas against refits: rotation, shift and scale about the middle, 7 degrees of
// freedom.
TEST(MeshAlignmentTest, CovarianceEqualsMonteCarlo) {
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<double> normal(0, 1);
  const FeatureRoom room = RoomWithFloor(0, 150, rng);
  SurfaceAlignmentOptions options;
  options.mesh_sigma_m = 0;
  double sum = 0;
  constexpr int kDraws = 60;
  for (int draw = 0; draw < kDraws; ++draw) {
    Eigen::Matrix3Xd points(3, room.points.size());
    for (std::size_t i = 0; i < room.points.size(); ++i)
      points.col(static_cast<Eigen::Index>(i)) =
          room.points[i] + 0.005 * Eigen::Vector3d(normal(rng), normal(rng), normal(rng));
    const SurfaceAlignment alignment = AlignPointsToSurface(points, RoomSurface(), Similarity(), options);
    ASSERT_TRUE(alignment.is_determined) << alignment.message;
    const Similarity& fit = alignment.world_from_points;
    const Eigen::AngleAxisd turn(fit.rotation);
    Eigen::Matrix<double, 7, 1> error;
    error << turn.angle() * turn.axis(), fit * alignment.middle_in_world - alignment.middle_in_world,
        std::log(fit.scale);
    sum += error.dot(alignment.covariance.ldlt().solve(error));
  }
  // Mean of 60 chi2 of 7 degrees of freedom: standard error sqrt(14 / 60) = 0.48, and the robust scatter is
  // itself known to 8 %, its square to 16: five standard errors.
  EXPECT_NEAR(sum / kDraws, 7, 2.4);
}

}  // namespace
}  // namespace luxfit
