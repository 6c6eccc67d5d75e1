// Photos of a ramp by a camera with noise, cut off below full scale or not.
#include "calib/luminance/cut_off.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/support/calib/camera_model.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr int kWidth = 160, kHeight = 120;

class CutOff : public testing::Test {
 protected:
  // Takes a photo of a ramp up to that luminance; 1 at an exposure of 1 is where the camera model's counts end.
  Photo Take(double exposure, double most = 3) {
    Photo photo = support::Shoot(model_, support::LogRamp(kHeight, kWidth, 2e-3, most), exposure, rng_);
    photo.full_scale_counts = photo.saturation_counts = model_.bits == 8 ? 255 : 65535;
    return photo;
  }
  static ExposedTop TopOf(const Photo& photo, double exposure) { return {*TopCountOf(photo), exposure}; }

  support::CameraModel model_;
  std::mt19937_64 rng_ = support::TestRng();
};

TEST_F(CutOff, ManyPixelsShareTheWhiteLevelAtSeveralExposures) {
  model_.full_scale_counts = 20000;
  std::vector<ExposedTop> tops;
  for (const double exposure : {0.5, 1.0, 2.0}) tops.push_back(TopOf(Take(exposure), exposure));
  for (const ExposedTop& top : tops) EXPECT_TRUE(top.top.is_plateau);
  tops.push_back(TopOf(Take(0.1), 0.1));  // reaches no limit
  EXPECT_THAT(FindCutOffs(tops), ElementsAre(20000));
  tops.erase(tops.begin());
  EXPECT_THAT(FindCutOffs(tops), IsEmpty());  // two may share it by chance
}

TEST_F(CutOff, CountsInStepsAreCutOffLikewise) {
  model_.full_scale_counts = 20000;
  std::vector<ExposedTop> tops;
  for (const double exposure : {0.5, 1.0, 2.0}) {
    Photo photo = Take(exposure);
    for (ImagePlane& plane : photo.rgb_counts) plane = 64 * (plane / 64).round();
    tops.push_back(TopOf(photo, exposure));
  }
  EXPECT_THAT(FindCutOffs(tops), ElementsAre(64 * 313));
}

TEST_F(CutOff, PhotosUpToFullScaleAreRight) {
  std::vector<ExposedTop> tops;
  for (const double exposure : {0.05, 0.1, 0.2, 0.3, 0.5, 1.0, 2.0}) {
    tops.push_back(TopOf(Take(exposure), exposure));
    EXPECT_FALSE(tops.back().top.is_plateau) << exposure;
  }
  EXPECT_THAT(FindCutOffs(tops), IsEmpty());
}

TEST_F(CutOff, EightBitsOfANarrowHistogramAreRight) {
  model_.bits = 8;
  model_.full_scale_counts = 255;
  model_.response = support::SrgbEncoded;
  std::vector<ExposedTop> tops;
  for (const double most : {0.01, 0.03, 0.1, 0.3}) {
    for (const double exposure : {0.5, 0.8, 1.0}) {
      tops.push_back(TopOf(Take(exposure, most), exposure));
      EXPECT_FALSE(tops.back().top.is_plateau) << most << " " << exposure;
    }
  }
  EXPECT_THAT(FindCutOffs(tops), IsEmpty());
}

// Without noise a luminaire of one luminance has one count; at another exposure it is another one.
TEST_F(CutOff, AnEvenLuminaireIsNoCutOff) {
  model_.full_well = 0;
  const auto take = [&](double exposure) {
    Photo photo = Take(exposure, 0.3);
    for (ImagePlane& plane : photo.rgb_counts)
      plane.block(10, 10, 60, 60) = static_cast<float>(std::round(0.5 * exposure * 65535));
    return TopOf(photo, exposure);
  };
  const std::vector<ExposedTop> alike{take(1), take(1), take(1), take(1)};
  for (const ExposedTop& top : alike) EXPECT_TRUE(top.top.is_plateau);
  EXPECT_THAT(FindCutOffs(alike), IsEmpty());
  EXPECT_THAT(FindCutOffs({take(1), take(1), take(0.7), take(0.5)}), IsEmpty());
}

TEST_F(CutOff, PicturesOfAFewTonesRawAndFloatsTellNothing) {
  Photo flat = Take(0.5, 0.3);
  for (ImagePlane& plane : flat.rgb_counts) plane = 4096 * (plane / 4096).round();
  EXPECT_FALSE(TopCountOf(flat)->is_plateau);
  Photo raw = Take(0.5);
  raw.is_black_subtracted = true;
  EXPECT_FALSE(TopCountOf(raw));
  Photo floats = Take(0.5);
  floats.bits_per_channel = 32;
  EXPECT_FALSE(TopCountOf(floats));
  EXPECT_FALSE(TopCountOf({}));
}

}  // namespace
}  // namespace luxfit
