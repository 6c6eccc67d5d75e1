#include "calib/targets/tags.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "calib/targets/internal/tags/tag_family.h"
#include "calib/targets/internal/tags/tag_image_model.h"
#include "tests/support/calib/tag_render.h"
#include "tests/support/calib/tag_scene.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::TagScene;

Camera DistortedCamera() { return support::OffAxisCamera(); }

// Turned at random and tilted up to 50 degrees.
TagScene RandomScene(const Camera& camera, double side_px, std::mt19937_64& rng) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return support::MakeTagScene(camera, side_px, 0.87 * uniform(rng), rng);
}

struct Figures {
  int count = 0;
  double detected_rms_px = 0, refined_rms_px = 0;  // per axis
  double normalised = 0;                           // rms of refined error / corner_sigma_px
  double size_bias = 0;                            // mean of refined side / true side - 1
};

Figures Measure(double side_px, const support::TagRenderOptions& render, std::mt19937_64& rng,
                const RefineTagCornersOptions& options = {}) {
  const Camera camera = DistortedCamera();
  Figures figures;
  for (int i = 0; i < 8; ++i) {
    const TagScene scene = RandomScene(camera, side_px, rng);
    const ImagePlane grey = support::RenderTags(camera, scene.cam_from_world, {scene.tag}, rng, render);
    const std::vector<TagDetection> found = DetectTags(grey);
    if (found.size() != 1) continue;
    const TagDetection refined = RefineTagCorners(grey, camera, found, options).front();
    std::array<Eigen::Vector2d, 4> truth;
    for (std::size_t k = 0; k < 4; ++k) {
      truth[k] = Project(camera, scene.cam_from_world * TagCornersInWorld(scene.tag)[k]);
      figures.detected_rms_px += (found[0].corners_px[k] - truth[k]).squaredNorm() / 8;
      const double error2 = (refined.corners_px[k] - truth[k]).squaredNorm() / 8;
      figures.refined_rms_px += error2;
      figures.normalised += error2 / (refined.corner_sigma_px * refined.corner_sigma_px);
    }
    double true_side_px = 0;
    for (std::size_t k = 0; k < 4; ++k) true_side_px += (truth[(k + 1) % 4] - truth[k]).norm() / 4;
    figures.size_bias += refined.side_px / true_side_px - 1;
    ++figures.count;
  }
  figures.detected_rms_px = std::sqrt(figures.detected_rms_px / figures.count);
  figures.refined_rms_px = std::sqrt(figures.refined_rms_px / figures.count);
  figures.normalised = std::sqrt(figures.normalised / figures.count);
  figures.size_bias /= figures.count;
  return figures;
}

// 0.02 px: the rays (8 x 8 a pixel) place an edge to about 1/16 px in each pixel, and some 100 pixels share
// it.
TEST(TagRefineTest, ReachesHundredthsOfAPixelOnSharpPhotos) {
  std::mt19937_64 rng = support::TestRng();
  support::TagRenderOptions render;
  render.shading_across = 0.4;
  for (const double side_px : {20.0, 30.0, 60.0}) {
    const Figures figures = Measure(side_px, render, rng);
    ASSERT_GE(figures.count, 6) << side_px;
    EXPECT_LT(figures.refined_rms_px, 0.02) << side_px;
    EXPECT_LT(figures.refined_rms_px, figures.detected_rms_px / 5) << side_px;
    EXPECT_LT(std::abs(figures.size_bias), 0.02 / side_px) << side_px;
  }
}

// Noise of 6 % of the contrast, no floor: the predicted sigma is the actual error. 8 tags x 8 coordinates
// leave the ratio uncertain by about 10 %; aliasing of the finite rays adds a little.
TEST(TagRefineTest, SigmaIsTheErrorUnderNoise) {
  std::mt19937_64 rng = support::TestRng();
  support::TagRenderOptions render;
  render.noise_sigma = 0.05;
  RefineTagCornersOptions options;
  options.min_corner_sigma_px = 1e-6;
  const Figures figures = Measure(50, render, rng, options);
  ASSERT_GE(figures.count, 6);
  EXPECT_GT(figures.normalised, 0.7);
  EXPECT_LT(figures.normalised, 1.4);
}

// One ray a pixel: the worst aliasing there is. Nothing to gain, and the sigma must say so within a factor of 4.
TEST(TagRefineTest, AliasedPhotosGetALargerSigma) {
  std::mt19937_64 rng = support::TestRng();
  support::TagRenderOptions sharp, aliased;
  aliased.samples_per_axis = 1;
  RefineTagCornersOptions options;
  options.min_corner_sigma_px = 1e-6;
  const Figures figures = Measure(50, aliased, rng, options);
  ASSERT_GE(figures.count, 6);
  std::printf("aliased: rms error over sigma %.2f\n", figures.normalised);
  EXPECT_LT(figures.normalised, 4);
  EXPECT_GT(figures.normalised, 1. / 4);
}

TEST(TagRefineTest, LensBlurDoesNotBias) {
  std::mt19937_64 rng = support::TestRng();
  const Camera camera = DistortedCamera();
  for (int i = 0; i < 4; ++i) {
    const TagScene scene = RandomScene(camera, 50, rng);
    const ImagePlane sharp = support::RenderTags(camera, scene.cam_from_world, {scene.tag}, rng);
    // Two passes of [1 2 1] / 4 both ways: a Gaussian of 1 px.
    ImagePlane grey = sharp;
    for (int pass = 0; pass < 2; ++pass) {
      const ImagePlane rows = grey;
      for (Eigen::Index u = 1; u + 1 < grey.cols(); ++u) {
        grey.col(u) = 0.25f * rows.col(u - 1) + 0.5f * rows.col(u) + 0.25f * rows.col(u + 1);
      }
      const ImagePlane cols = grey;
      for (Eigen::Index v = 1; v + 1 < grey.rows(); ++v) {
        grey.row(v) = 0.25f * cols.row(v - 1) + 0.5f * cols.row(v) + 0.25f * cols.row(v + 1);
      }
    }
    const std::vector<TagDetection> found = DetectTags(grey);
    ASSERT_EQ(found.size(), 1u);
    const TagDetection refined = RefineTagCorners(grey, camera, found).front();
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector2d truth = Project(camera, scene.cam_from_world * TagCornersInWorld(scene.tag)[k]);
      // The blur is modelled as a box of the same variance: good to a few hundredths.
      EXPECT_LT((refined.corners_px[k] - truth).norm(), 0.06);
    }
  }
}

TEST(TagRefineTest, APhotoThatDoesNotShowTheTagLeavesTheDetectionAlone) {
  TagDetection detection;
  detection.corners_px = {Eigen::Vector2d(40, 40), Eigen::Vector2d(80, 40), Eigen::Vector2d(80, 80),
                          Eigen::Vector2d(40, 80)};
  detection.side_px = 40;
  detection.corner_sigma_px = 0.1;
  const std::vector<TagDetection> detections = {detection};
  const auto is_unchanged = [&detections](const ImagePlane& grey) {
    const TagDetection& before = detections.front();
    const TagDetection refined = RefineTagCorners(grey, DistortedCamera(), detections).front();
    return refined.corners_px == before.corners_px && refined.corner_sigma_px == before.corner_sigma_px;
  };
  EXPECT_TRUE(is_unchanged(ImagePlane::Constant(120, 120, 0.5f)));
  EXPECT_TRUE(is_unchanged(ImagePlane::Constant(120, 120, std::numeric_limits<float>::quiet_NaN())));
  std::mt19937_64 rng = support::TestRng();
  std::uniform_real_distribution<float> uniform(0, 1);
  EXPECT_TRUE(is_unchanged(ImagePlane::NullaryExpr(120, 120, [&](Eigen::Index) { return uniform(rng); })));
}

TEST(TagRefineTest, UnknownFamiliesAndIdsAreRefused) {
  TagDetection detection;
  detection.corners_px.fill(Eigen::Vector2d::Zero());
  detection.id = 100000;
  EXPECT_THROW(RefineTagCorners(ImagePlane::Zero(9, 9), DistortedCamera(), {detection}),
               std::invalid_argument);
  RefineTagCornersOptions options;
  options.family = "tag99h99";
  EXPECT_THROW(RefineTagCorners(ImagePlane::Zero(9, 9), DistortedCamera(), {}, options),
               std::invalid_argument);
}

TEST(TagFamilyTest, DrawsTagsAsTheirOfficialImages) {
  const TagFamilyPtr family = MakeTagFamily("tag36h11");
  const TagPicture picture = DrawTag(*family, 0);
  ASSERT_EQ(picture.total_cells(), 10);
  EXPECT_EQ(picture.border_begin, 1);
  EXPECT_EQ(picture.border_end, 9);
  for (int row = 0; row < 10; ++row) {
    for (int col = 0; col < 10; ++col) {
      EXPECT_EQ(picture.cells(row, col), support::kTag36h11Id0[row][col] == '1' ? 1 : 0)
          << row << ", " << col;
    }
  }
  EXPECT_THROW(DrawTag(*family, -1), std::invalid_argument);
}

TEST(TagImageModelTest, MeansAreThoseOfTheCells) {
  const TagImageModel model(DrawTag(*MakeTagFamily("tag36h11"), 0));
  EXPECT_NEAR(model.Mean(0.5, 0.5, 1, 1).mean, 1, 1e-12);      // rim
  EXPECT_NEAR(model.Mean(1.5, 1.5, 0.5, 0.5).mean, 0, 1e-12);  // border
  EXPECT_NEAR(model.Mean(1.0, 5.0, 1, 1).mean, 0.5, 1e-12);    // across the edge between them
  EXPECT_NEAR(model.Mean(-1.0, 5.0, 1, 1).mean, 1, 1e-12);     // the rim goes on outside
  EXPECT_NEAR(model.Mean(-50.0, 5.0, 1, 1).mean, 0, 1);        // far outside: finite
}

TEST(TagImageModelTest, DerivativesMatchCentralDifferences) {
  std::mt19937_64 rng = support::TestRng();
  std::uniform_real_distribution<double> place(0, 10), width(0.2, 1.5);
  const TagImageModel model(DrawTag(*MakeTagFamily("tag36h11"), 0));
  for (int i = 0; i < 200; ++i) {
    const double s = place(rng), t = place(rng), ws = width(rng), wt = width(rng);
    constexpr double kStep = 1e-6;
    // A side of the box within a step of a cell's edge has no derivative.
    bool at_edge = false;
    for (const double side : {s - ws / 2, s + ws / 2, t - wt / 2, t + wt / 2}) {
      at_edge = at_edge || std::abs(side - std::round(side)) < 2 * kStep;
    }
    if (at_edge) continue;
    const TagImageModel::Sample sample = model.Mean(s, t, ws, wt);
    const auto difference = [&](double ds, double dt, double dws, double dwt) {
      return (model.Mean(s + ds, t + dt, ws + dws, wt + dwt).mean -
              model.Mean(s - ds, t - dt, ws - dws, wt - dwt).mean) /
             (2 * kStep);
    };
    EXPECT_NEAR(sample.d_s, difference(kStep, 0, 0, 0), 1e-6);
    EXPECT_NEAR(sample.d_t, difference(0, kStep, 0, 0), 1e-6);
    EXPECT_NEAR(sample.d_width_s, difference(0, 0, kStep, 0), 1e-6);
    EXPECT_NEAR(sample.d_width_t, difference(0, 0, 0, kStep), 1e-6);
  }
}

}  // namespace
}  // namespace luxfit
