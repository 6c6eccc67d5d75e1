#include "calib/calibrate/internal/calibration_coverage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/calib/board_views.h"

namespace luxfit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Eigen::Isometry3d Pose(double tilt_deg, double distance_m) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() =
      Eigen::AngleAxisd(tilt_deg * 3.14159265358979323846 / 180, Eigen::Vector3d::UnitX()).toRotationMatrix();
  pose.translation().z() = distance_m;
  return pose;
}

// Corners over a rectangle of an image of 600 x 600, in pixels.
std::vector<BoardCorner> Corners(double left, double top, double right, double bottom) {
  std::vector<BoardCorner> corners;
  for (int i = 0; i < 100; ++i)
    corners.push_back({i, {left + (right - left) * (i % 10) / 9, top + (bottom - top) * (i / 10) / 9}, 0.1});
  return corners;
}

const CalibrationCamera kCamera = {"cam0", 600, 600};

TEST(CalibrationCoverage, SaysWhatIsMissingWhere) {
  const CalibrationTarget target = support::GridTarget(10, 10);
  const auto lacks = [&](const std::vector<CoveringImage>& images) {
    return CoverageOf(target, kCamera, {}, images).lacks;
  };
  EXPECT_THAT(lacks({{Corners(0, 0, 599, 599), Pose(20, 0.5)}, {Corners(0, 0, 599, 599), Pose(30, 1)}}),
              IsEmpty());
  EXPECT_THAT(lacks({{Corners(0, 0, 390, 599), Pose(20, 0.5)}, {Corners(0, 210, 390, 599), Pose(0, 1)}}),
              ElementsAre("no corner in the right third of the image"));
  EXPECT_THAT(lacks({{Corners(210, 0, 599, 599), Pose(20, 0.5)}, {Corners(0, 210, 390, 599), Pose(0, 1)}}),
              ElementsAre("no corner in the upper left third of the image"));
  EXPECT_THAT(
      lacks({{Corners(0, 0, 599, 599), Pose(3, 0.5)}, {Corners(0, 0, 599, 599), Pose(5, 0.52)}}),
      ElementsAre("the board was never tilted more than 5 degrees", "all boards are at one distance"));
}

TEST(CalibrationCoverage, NothingLacksOutsideTheImageCircle) {
  const ImageCircle circle{{299.5, 299.5}, 200};
  const CalibrationCoverage coverage =
      CoverageOf(support::GridTarget(10, 10), kCamera, circle,
                 {{Corners(110, 110, 490, 490), Pose(20, 0.5)}, {Corners(110, 110, 490, 490), Pose(30, 1)}});
  EXPECT_THAT(coverage.lacks, IsEmpty());
  EXPECT_DOUBLE_EQ(coverage.covered_share, 1);
  const CalibrationCoverage half = CoverageOf(support::GridTarget(10, 10), kCamera, circle,
                                              {{Corners(110, 110, 290, 490), Pose(20, 0.5)}});
  EXPECT_THAT(half.lacks, testing::Contains("no corner in the middle right third of the image"));
  EXPECT_LT(half.covered_share, 0.7);
}

TEST(CalibrationCoverage, CountsCellsAndCorners) {
  const CalibrationCoverage coverage = CoverageOf(
      support::GridTarget(10, 10), kCamera, {}, {{Corners(0, 0, 299, 299), Pose(25, 0.5)}, {{}, Pose(0, 9)}});
  EXPECT_EQ(coverage.corner_counts.sum(), 100);
  EXPECT_DOUBLE_EQ(coverage.covered_share, 0.25);
  EXPECT_EQ(coverage.images, 1);
  EXPECT_NEAR(coverage.max_tilt_deg, 25, 1e-9);
  EXPECT_GT(coverage.nearest_m, 0.4);
  EXPECT_LT(coverage.farthest_m, 1);
}

}  // namespace
}  // namespace luxfit
