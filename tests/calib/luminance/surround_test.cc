#include "calib/luminance/surround.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace luxfit {
namespace {

// A picture of 300 x 400 pixels, dark on its left half, 100 times as bright on its right.
LuminanceImage Halves() {
  LuminanceImage image;
  image.relative_luminance = ImagePlane::Constant(300, 400, 0.01f);
  image.relative_luminance.rightCols(200) = 1;
  return image;
}

TEST(SurroundTest, FarFromTheEdgeItIsTheLogarithmItself) {
  const Surround surround(Halves());
  for (Eigen::Index j = 0; j < surround.LogLuminance(0, 0).size(); ++j) {
    EXPECT_NEAR(surround.LogLuminance(150, 4)[j], std::log(0.01), 0.05) << j;
    EXPECT_NEAR(surround.LogLuminance(299, 399)[j], 0, 0.05) << j;
  }
}

// The step passes through a Gaussian: its cumulative distribution in pixels of 5 % and 15 % of the diagonal of 500.
TEST(SurroundTest, AnEdgeIsSmoothedByAGaussian) {
  const Surround surround(Halves());
  for (const Eigen::Index u : {140, 170, 200, 230}) {
    for (size_t j = 0; j < kSurroundSigmas.size(); ++j) {
      const double sigma_px = 500 * kSurroundSigmas[j];
      const double above = 0.5 * std::erfc((199.5 - static_cast<double>(u)) / (sigma_px * std::sqrt(2.0)));
      EXPECT_NEAR(surround.LogLuminance(100, u)[static_cast<Eigen::Index>(j)], (1 - above) * std::log(0.01),
                  0.15)
          << u << ' ' << j;
    }
  }
}

TEST(SurroundTest, PixelsWithoutAValueAreDark) {
  LuminanceImage image = Halves();
  image.relative_luminance(150, 399) = std::numeric_limits<float>::quiet_NaN();
  image.relative_luminance(0, 0) = 0;
  const Surround surround(image);
  for (const Eigen::Index u : {0, 200, 399}) EXPECT_TRUE(surround.LogLuminance(150, u).isFinite().all());
  EXPECT_THROW(Surround{LuminanceImage()}, std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
