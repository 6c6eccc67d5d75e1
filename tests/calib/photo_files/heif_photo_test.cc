#include "calib/photo_files/internal/heif_photo.h"

#include <gmock/gmock.h>

#include <stdexcept>

#include "calib/luminance/exposure.h"
#include "calib/photo_files/capture.h"
#include "tests/support/calib/test_heic.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using support::TestHeic;

// A grey ramp along u: HEIC keeps colours at half the pixels, so that colour edges would blur.
TestHeic Ramp(int bits) {
  TestHeic heic;
  heic.width_px = 128;
  heic.height_px = 64;
  heic.bits = bits;
  const int step = bits == 8 ? 1 : 4;
  for (int v = 0; v < heic.height_px; ++v) {
    for (int u = 0; u < heic.width_px; ++u)
      heic.counts.insert(heic.counts.end(), 3, static_cast<std::uint16_t>(step * (40 + u)));
  }
  return heic;
}

// The file's compression errs by a count or two.
void ExpectRamp(const Photo& photo, double scale) {
  ASSERT_EQ(photo.width_px(), 128);
  ASSERT_EQ(photo.height_px(), 64);
  EXPECT_EQ(photo.bits_per_channel, 8);
  EXPECT_EQ(photo.full_scale_counts, 255);
  for (const int u : {3, 60, 120}) {
    for (const ImagePlane& plane : photo.rgb_counts) EXPECT_NEAR(plane(30, u), scale * (40 + u), 2.5) << u;
  }
}

TEST(HeifPhotoTest, CountsAreTheFiles) {
  const TempFolder folder;
  if (!support::WriteHeic(folder.Path("a.HEIC"), Ramp(8))) GTEST_SKIP() << "libheif cannot write HEIC here";
  ExpectRamp(ReadPhoto(folder.Path("a.HEIC")), 1);
}

TEST(HeifPhotoTest, TenBitsAreScaledToEight) {
  const TempFolder folder;
  if (!support::WriteHeic(folder.Path("a.heif"), Ramp(10))) GTEST_SKIP() << "libheif cannot write HEIC here";
  ExpectRamp(ReadPhoto(folder.Path("a.heif")), 4 * 255.0 / 1023);
}

// A phone held upright writes the same pixels as one held flat.
TEST(HeifPhotoTest, TurnsAreLeftOut) {
  const TempFolder folder;
  TestHeic heic = Ramp(8);
  heic.is_turned = true;
  if (!support::WriteHeic(folder.Path("a.heic"), heic)) GTEST_SKIP() << "libheif cannot write HEIC here";
  ExpectRamp(ReadPhoto(folder.Path("a.heic")), 1);
}

TEST(HeifPhotoTest, ExifIsRead) {
  const TempFolder folder;
  TestHeic heic = Ramp(8);
  heic.exif["Exif.Image.Model"] = "Phone 7";
  heic.exif["Exif.Photo.ExposureTime"] = Exiv2::Rational(1, 50);
  heic.exif["Exif.Photo.DateTimeOriginal"] = "1970:01:02 00:00:00";
  if (!support::WriteHeic(folder.Path("a.heic"), heic)) GTEST_SKIP() << "libheif cannot write HEIC here";
  EXPECT_DOUBLE_EQ(ReadExposureMetadata(folder.Path("a.heic")).exposure_s.value_or(0), 0.02);
  EXPECT_EQ(ReadCaptureMetadata(folder.Path("a.heic")).camera, "Phone 7");
  EXPECT_DOUBLE_EQ(ReadCaptureMetadata(folder.Path("a.heic")).taken_s.value_or(0), 86400);
}

TEST(HeifPhotoTest, BrokenFilesAreNamed) {
  const TempFolder folder;
  folder.Write("a.heic", "not a picture");
  try {
    ReadPhoto(folder.Path("a.heic"));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("a.heic: cannot read the photo, expected HEIC or HEIF"));
  }
  EXPECT_FALSE(ReadExposureMetadata(folder.Path("a.heic")).exposure_s);
}

}  // namespace
}  // namespace luxfit
