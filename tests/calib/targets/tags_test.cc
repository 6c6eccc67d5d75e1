#include "calib/targets/tags.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/support/calib/pinhole.h"
#include "tests/support/calib/tag_render.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

Camera SmallCamera() { return support::Pinhole(200, 160, 500, {100.3, 79.1}); }

// A tag in the camera's own frame (the world is the camera here), facing it, upright in the picture.
SurveyedTag FacingTag(double size_m, const Eigen::Vector3d& center) {
  SurveyedTag tag;
  tag.size_m = size_m;
  tag.center_in_world = center;
  tag.normal_in_world = {0, 0, -1};
  tag.up_in_world = {0, -1, 0};
  return tag;
}

TEST(TagsTest, CornersGoRoundFromTopLeftAsSeenFromTheFront) {
  SurveyedTag tag;
  tag.size_m = 0.2;
  tag.center_in_world = {0, 1, 1.5};  // on the wall x = 0, looking at +x: right is +y
  tag.normal_in_world = {1, 0, 0};
  tag.up_in_world = {0, 0, 1};
  const std::array<Eigen::Vector3d, 4> corners = TagCornersInWorld(tag);
  EXPECT_TRUE(corners[0].isApprox(Eigen::Vector3d(0, 0.9, 1.6)));
  EXPECT_TRUE(corners[1].isApprox(Eigen::Vector3d(0, 1.1, 1.6)));
  EXPECT_TRUE(corners[2].isApprox(Eigen::Vector3d(0, 1.1, 1.4)));
  EXPECT_TRUE(corners[3].isApprox(Eigen::Vector3d(0, 0.9, 1.4)));
}

// Order and half pixel: each detected corner is where its own surveyed corner projects, at every rotation of
// the tag. The detector's edges are off by up to 0.3 px (its grey is gamma-compressed, the picture has no
// lens blur): a wrong half pixel would show as a mean of (0.5, 0.5), a wrong order as many pixels.
TEST(TagsTest, DetectsRenderedTagsWhereTheyAre) {
  std::mt19937_64 rng = support::TestRng();
  const Camera camera = SmallCamera();
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  constexpr int kTags = 8;
  for (int i = 0; i < kTags; ++i) {
    SurveyedTag tag = FacingTag(0.2, {0.013 * i - 0.05, 0.01 * i - 0.04, 2.0});
    tag.up_in_world = Eigen::AngleAxisd(0.785 * i + 0.1, tag.normal_in_world) * tag.up_in_world;
    const ImagePlane grey = support::RenderTags(camera, Eigen::Isometry3d::Identity(), {tag}, rng);
    const std::vector<TagDetection> found = DetectTags(grey);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].id, 0);
    EXPECT_NEAR(found[0].side_px, 50, 0.6);  // 0.3 px at either end
    EXPECT_GT(found[0].decision_margin, 20);
    // 0.35 px by the display's curve and 0.05 px at 50 px a side, in quadrature.
    EXPECT_NEAR(found[0].corner_sigma_px, std::hypot(0.35, 0.05), 0.005);
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const Eigen::Vector2d error =
          found[0].corners_px[corner] - Project(camera, TagCornersInWorld(tag)[corner]);
      EXPECT_LT(error.norm(), 4 * found[0].corner_sigma_px);
      mean += error / (4 * kTags);
    }
  }
  EXPECT_LT(mean.norm(), 0.05);
}

// A luminaire hundreds of times as bright as the wall must not crush the tag's contrast; nor must clipping to
// NaN.
TEST(TagsTest, FindsTagsBesideALuminaire) {
  std::mt19937_64 rng = support::TestRng();
  const SurveyedTag tag = FacingTag(0.2, {0, 0, 2.0});
  ImagePlane grey = support::RenderTags(SmallCamera(), Eigen::Isometry3d::Identity(), {tag}, rng);
  grey.topLeftCorner(30, 60) = 500;
  EXPECT_EQ(DetectTags(grey).size(), 1u);
  grey.topLeftCorner(30, 60) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(DetectTags(grey).size(), 1u);
  EXPECT_EQ(DetectTags(1e-6f * grey).size(), 1u);
}

TEST(TagsTest, AnEmptyWallHasNoTags) {
  EXPECT_TRUE(DetectTags(ImagePlane::Constant(60, 80, 0.5f)).empty());
  EXPECT_TRUE(DetectTags(ImagePlane::Zero(60, 80)).empty());
}

TEST(TagsTest, TwoCopiesOfATagAreBothReturned) {
  std::mt19937_64 rng = support::TestRng();
  const std::vector<SurveyedTag> tags = {FacingTag(0.2, {-0.2, 0, 2.0}), FacingTag(0.2, {0.2, 0, 2.0})};
  const ImagePlane grey = support::RenderTags(SmallCamera(), Eigen::Isometry3d::Identity(), tags, rng);
  const std::vector<TagDetection> found = DetectTags(grey);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_LT(found[0].corners_px[0].x(), found[1].corners_px[0].x());
  EXPECT_EQ(CombineDetections({found, found}).size(), 2u);
}

TEST(TagsTest, SmallOrDoubtfulTagsAreLeftOut) {
  std::mt19937_64 rng = support::TestRng();
  const ImagePlane grey =
      support::RenderTags(SmallCamera(), Eigen::Isometry3d::Identity(), {FacingTag(0.2, {0, 0, 2.0})}, rng);
  DetectTagsOptions options;
  options.min_side_px = 60;
  EXPECT_TRUE(DetectTags(grey, options).empty());
  options = {};
  options.min_decision_margin = 1000;
  EXPECT_TRUE(DetectTags(grey, options).empty());
}

TEST(TagsTest, UnknownFamiliesAndEmptyPlanesAreRefused) {
  DetectTagsOptions options;
  options.family = "tag99h99";
  EXPECT_THROW(DetectTags(ImagePlane::Zero(10, 10), options), std::invalid_argument);
  EXPECT_THROW(DetectTags(ImagePlane()), std::invalid_argument);
  for (const char* family : {"tag36h11", "tag36h10", "tag25h9", "tag16h5", "tagStandard41h12"}) {
    options.family = family;
    EXPECT_TRUE(DetectTags(ImagePlane::Zero(40, 40), options).empty()) << family;
  }
}

TEST(TagsTest, SmallerTagsAreExpectedToBeLessPrecise) {
  double last = std::numeric_limits<double>::infinity();
  for (const double side_px : {8.0, 16.0, 20.0, 24.0, 40.0, 80.0, 160.0}) {
    EXPECT_LT(DetectorCornerSigmaPx(side_px), last);
    last = DetectorCornerSigmaPx(side_px);
  }
  EXPECT_EQ(DetectorCornerSigmaPx(160), DetectorCornerSigmaPx(1000));
}

TagDetection SquareAt(double x, double y, double sigma_px) {
  TagDetection tag;
  tag.id = 3;
  tag.corners_px = {Eigen::Vector2d(x, y), Eigen::Vector2d(x + 40, y), Eigen::Vector2d(x + 40, y + 40),
                    Eigen::Vector2d(x, y + 40)};
  tag.side_px = 40;
  tag.corner_sigma_px = sigma_px;
  return tag;
}

TEST(CombineDetectionsTest, AveragesByPrecision) {
  const std::vector<TagDetection> combined =
      CombineDetections({{SquareAt(10.00, 20, 0.1)}, {SquareAt(10.05, 20, 0.05)}});
  ASSERT_EQ(combined.size(), 1u);
  EXPECT_NEAR(combined[0].corners_px[0].x(), 10.04, 1e-9);
  EXPECT_NEAR(combined[0].side_px, 40, 1e-9);
}

TEST(CombineDetectionsTest, SigmaFallsOnlyToWhatThePhotosShare) {
  CombineDetectionsOptions options;
  options.systematic_fraction = 0.6;
  const std::vector<std::vector<TagDetection>> photos(100, {SquareAt(10, 20, 0.1)});
  // sigma^2 = 0.36 s^2 + 0.64 s^2 / n
  EXPECT_NEAR(CombineDetections(photos, options)[0].corner_sigma_px, 0.1 * std::sqrt(0.36 + 0.0064), 1e-12);
  EXPECT_NEAR(CombineDetections({photos[0]}, options)[0].corner_sigma_px, 0.1, 1e-12);
}

TEST(CombineDetectionsTest, AScatterLargerThanSigmaShows) {
  std::vector<std::vector<TagDetection>> photos;
  for (int i = 0; i < 10; ++i) photos.push_back({SquareAt(10 + (i % 2 == 0 ? 0.3 : -0.3), 20, 0.1)});
  // Every corner is off by 0.3 px in one of two axes: variance per axis 0.045, of the mean of ten (9 spare)
  // 0.005.
  CombineDetectionsOptions options;
  options.systematic_fraction = 0;
  EXPECT_NEAR(CombineDetections(photos, options)[0].corner_sigma_px, std::sqrt(0.005), 1e-9);
}

TEST(CombineDetectionsTest, OutliersAndMuchWorsePhotosAreLeftOut) {
  const std::vector<TagDetection> combined = CombineDetections({{SquareAt(10, 20, 0.03)},
                                                                {SquareAt(10, 20, 0.03)},
                                                                {SquareAt(10, 20, 0.03)},
                                                                {SquareAt(14, 20, 0.03)},
                                                                {SquareAt(11, 20, 0.12)}});
  ASSERT_EQ(combined.size(), 1u);
  EXPECT_NEAR(combined[0].corners_px[0].x(), 10, 1e-12);
}

TEST(CombineDetectionsTest, NoPhotosNoTags) {
  EXPECT_TRUE(CombineDetections({}).empty());
  EXPECT_TRUE(CombineDetections({{}, {}}).empty());
}

}  // namespace
}  // namespace luxfit
