// What the issue asks of tag corners: 0.05 px of bias and 0.06 px of sigma an axis for tags of 40 px and
// more, over poses, lens blur and noise, on pictures that do not know calib's image model.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "calib/targets/tags.h"
#include "tests/support/calib/blur.h"
#include "tests/support/calib/tag_render.h"
#include "tests/support/calib/tag_scene.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

struct CornerErrors {
  int corners = 0, missed = 0;
  Eigen::Vector2d sum_px = Eigen::Vector2d::Zero();
  double outward_px = 0;  // sum of the error's part away from the tag's middle
  double square_px2 = 0;

  Eigen::Vector2d BiasPx() const { return sum_px / corners; }
  double OutwardPx() const { return outward_px / corners; }
  // An axis', about the bias.
  double SigmaPx() const { return std::sqrt(square_px2 / (2 * corners) - BiasPx().squaredNorm() / 2); }

  void Add(const std::array<Eigen::Vector2d, 4>& found_px, const std::array<Eigen::Vector2d, 4>& true_px) {
    const Eigen::Vector2d middle = (true_px[0] + true_px[1] + true_px[2] + true_px[3]) / 4;
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector2d error = found_px[k] - true_px[k];
      ++corners;
      sum_px += error;
      outward_px += error.dot((true_px[k] - middle).normalized());
      square_px2 += error.squaredNorm();
    }
  }
};

class TagAccuracyTest : public ::testing::TestWithParam<double> {};

TEST_P(TagAccuracyTest, CornersHaveNoBiasAndASmallSigma) {
  std::mt19937_64 rng = support::TestRng();
  const double side_px = GetParam();
  const Camera camera = support::OffAxisCamera(static_cast<int>(2.2 * side_px));
  std::uniform_real_distribution<double> tilt_rad(0, 0.96);  // 55 degrees
  std::normal_distribution<float> normal(0, 1);
  constexpr int kPoses = 6;
  std::vector<std::pair<ImagePlane, std::array<Eigen::Vector2d, 4>>> photos;
  for (int i = 0; i < kPoses; ++i) {
    const double tilt = tilt_rad(rng);
    // Its mean side in the photo is side_px: two sides are foreshortened.
    const support::TagScene scene =
        support::MakeTagScene(camera, 2 * side_px / (1 + std::cos(tilt)), tilt, rng);
    photos.emplace_back(support::RenderTags(camera, scene.cam_from_world, {scene.tag}, rng),
                        scene.CornersPx(camera));
  }
  for (const double blur_px : {0.0, 0.7, 1.2}) {
    for (const float noise : {0.004f, 0.016f}) {  // of full scale: 1 and 4 of 255
      CornerErrors errors;
      for (const auto& [sharp, true_px] : photos) {
        ImagePlane grey = support::Blurred(sharp, blur_px);
        for (Eigen::Index i = 0; i < grey.size(); ++i) grey.data()[i] += noise * normal(rng);
        const std::vector<TagDetection> found = DetectTags(grey);
        errors.missed += found.size() == 1 ? 0 : 1;
        if (found.size() == 1) errors.Add(RefineTagCorners(grey, camera, found).front().corners_px, true_px);
      }
      std::printf("side %3.0f px, blur %.1f px, noise %.3f: bias %+.3f %+.3f, outward %+.3f, sigma %.3f px\n",
                  side_px, blur_px, static_cast<double>(noise), errors.BiasPx().x(), errors.BiasPx().y(),
                  errors.OutwardPx(), errors.SigmaPx());
      // Blurred and noisy at once, the detector misses some tilted ones (docs/calib.md, "Boards and tags").
      EXPECT_LE(errors.missed, blur_px > 1 && noise > 0.01f ? kPoses / 2 : 0) << blur_px << " " << noise;
      EXPECT_LT(errors.BiasPx().cwiseAbs().maxCoeff(), 0.05) << blur_px << " " << noise;
      EXPECT_LT(std::abs(errors.OutwardPx()), 0.05) << blur_px << " " << noise;
      EXPECT_LT(errors.SigmaPx(), 0.06) << blur_px << " " << noise;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sides, TagAccuracyTest, ::testing::Values(40.0, 56.0));

}  // namespace
}  // namespace luxfit
