#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "calib/luminance/exposure.h"
#include "calib/photo_files/image.h"
#include "calib/photo_files/lens_shading.h"
#include "tests/support/calib/test_dng.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

// LibRaw refuses pictures of less than 22 px a side.
constexpr int kWidth = 40, kHeight = 32;
constexpr std::array<std::uint32_t, 4> kBlack{500, 512, 520, 530};

size_t Place(int u, int v) { return static_cast<size_t>(2 * (v % 2) + u % 2); }
// Of the mosaic red green / green blue.
size_t ChannelAt(int u, int v) { return std::array<size_t, 4>{0, 1, 1, 2}[Place(u, v)]; }

// Returns a file without counts yet.
support::TestDng EmptyDng() {
  support::TestDng dng;
  dng.width_px = kWidth;
  dng.height_px = kHeight;
  dng.black = kBlack;
  dng.white = 15000;
  return dng;
}

// `truth`: counts above black of a channel at a place.
template <typename Truth>
support::TestDng MosaicOf(const Truth& truth) {
  support::TestDng dng = EmptyDng();
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      dng.counts.push_back(static_cast<std::uint16_t>(truth(ChannelAt(u, v), u, v) + kBlack[Place(u, v)]));
    }
  }
  return dng;
}

TEST(RawPhotoTest, LinearGradientsComeBackInEveryChannelWithBlackOfEveryPlaceSubtracted) {
  const auto truth = [](size_t c, int u, int v) { return 1000.0 * (c + 1) + 20 * u + 30 * v; };
  const TempFolder folder;
  support::WriteTestDng(folder.Path("a.dng"), MosaicOf(truth));
  const Photo photo = ReadPhoto(folder.Path("a.dng"));
  ASSERT_EQ(photo.width_px(), kWidth);
  ASSERT_EQ(photo.height_px(), kHeight);
  EXPECT_TRUE(photo.is_black_subtracted);
  EXPECT_EQ(photo.full_scale_counts, 15000 - 530);
  EXPECT_EQ(photo.saturation_counts, 15000 - 530);
  // Bilinear interpolation is exact on linear functions, away from the border, whose sums are lopsided.
  for (int v = 1; v + 1 < kHeight; ++v) {
    for (int u = 1; u + 1 < kWidth; ++u) {
      for (size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(photo.rgb_counts[c](v, u), truth(c, u, v), 1e-2) << c << " at " << u << ", " << v;
      }
    }
  }
}

TEST(RawPhotoTest, NoiseBelowBlackStaysNegative) {
  const TempFolder folder;
  support::WriteTestDng(folder.Path("a.dng"),
                        MosaicOf([](size_t, int u, int) { return u % 4 < 2 ? 7 : -7; }));
  const Photo photo = ReadPhoto(folder.Path("a.dng"));
  EXPECT_EQ(photo.rgb_counts[0].minCoeff(), -7.0f);
  EXPECT_NEAR(photo.rgb_counts[1].mean(), 0, 0.3);
}

// Three colours a pixel, as ProRAW and DNG converters write them. `truth`: as of MosaicOf.
template <typename Truth>
support::TestDng LinearOf(const Truth& truth) {
  support::TestDng dng = EmptyDng();
  dng.is_linear = true;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      for (size_t c = 0; c < 3; ++c)
        dng.counts.push_back(static_cast<std::uint16_t>(truth(c, u, v) + kBlack[c]));
    }
  }
  return dng;
}

TEST(RawPhotoTest, ALinearDngGivesTheCountsOfItsThreeColours) {
  const auto truth = [](size_t c, int u, int v) { return 1000.0 * (c + 1) + 7 * (u * v % 5) - 1010; };
  const TempFolder folder;
  support::WriteTestDng(folder.Path("a.dng"), LinearOf(truth));
  const Photo photo = ReadPhoto(folder.Path("a.dng"));
  ASSERT_EQ(photo.width_px(), kWidth);
  ASSERT_EQ(photo.height_px(), kHeight);
  EXPECT_TRUE(photo.is_black_subtracted);
  EXPECT_EQ(photo.bits_per_channel, 16);
  EXPECT_EQ(photo.full_scale_counts, 15000 - 520);
  EXPECT_EQ(photo.saturation_counts, 15000 - 520);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      for (size_t c = 0; c < 3; ++c)
        ASSERT_EQ(photo.rgb_counts[c](v, u), truth(c, u, v)) << c << " at " << u << ", " << v;
    }
  }
}

// DNG 1.6: numbers beyond the table stand for its last entry. The table undoes how the file packs counts; no tone curve
// follows it.
TEST(RawPhotoTest, ALinearizationTableIsUndone) {
  support::TestDng dng = LinearOf([](size_t, int u, int) { return u; });
  for (std::uint32_t packed = 0; packed < 1000; ++packed) dng.linearization.push_back(packed * packed / 100);
  const TempFolder folder;
  support::WriteTestDng(folder.Path("a.dng"), dng);
  const Photo photo = ReadPhoto(folder.Path("a.dng"));
  for (size_t c = 0; c < 3; ++c) {
    for (int u = 0; u < kWidth; ++u) {
      const std::uint32_t packed = static_cast<std::uint32_t>(u) + kBlack[c];
      EXPECT_EQ(photo.rgb_counts[c](3, u),
                static_cast<float>(packed * packed / 100) - static_cast<float>(kBlack[c]));
    }
  }
}

TEST(RawPhotoTest, WhatIsNoRawIsNamed) {
  const TempFolder folder;
  folder.Write("a.dng", "II*\0 nothing of the kind");
  try {
    ReadPhoto(folder.Path("a.dng"));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(),
                testing::StartsWith(folder.Path("a.dng") + ": cannot read the photo, expected RAW"));
  }
}

TEST(ExposureMetadataTest, ComesFromExif) {
  const TempFolder folder;
  support::TestDng dng = MosaicOf([](size_t, int, int) { return 100; });
  dng.exposure_s = {1, 60};
  dng.f_number = {28, 5};
  dng.iso = 200;
  support::WriteTestDng(folder.Path("a.dng"), dng);
  const ExposureMetadata metadata = ReadExposureMetadata(folder.Path("a.dng"));
  ASSERT_TRUE(metadata.exposure_s && metadata.f_number && metadata.iso);
  EXPECT_DOUBLE_EQ(*metadata.exposure_s, 1.0 / 60);
  EXPECT_DOUBLE_EQ(*metadata.f_number, 5.6);
  EXPECT_DOUBLE_EQ(*metadata.iso, 200);
}

// EXIF 2.3: 65535 says that the value has no room in 16 bits.
TEST(ExposureMetadataTest, AnIsoBeyond16BitsStandsElsewhere) {
  const TempFolder folder;
  support::TestDng dng = MosaicOf([](size_t, int, int) { return 100; });
  dng.iso = 65535;
  support::WriteTestDng(folder.Path("a.dng"), dng);
  EXPECT_FALSE(ReadExposureMetadata(folder.Path("a.dng")).iso.has_value());
  dng.recommended_exposure_index = 102400;
  support::WriteTestDng(folder.Path("a.dng"), dng);
  EXPECT_EQ(ReadExposureMetadata(folder.Path("a.dng")).iso, 102400);
}

TEST(ExposureMetadataTest, ZeroTimesAreNone) {
  const TempFolder folder;
  support::TestDng dng = MosaicOf([](size_t, int, int) { return 100; });
  dng.exposure_s = {0, 1};
  dng.f_number = {1, 0};
  support::WriteTestDng(folder.Path("a.dng"), dng);
  const ExposureMetadata metadata = ReadExposureMetadata(folder.Path("a.dng"));
  EXPECT_FALSE(metadata.exposure_s.has_value());
  EXPECT_FALSE(metadata.f_number.has_value());
  EXPECT_TRUE(metadata.iso.has_value());
}

TEST(ExposureMetadataTest, FilesWithoutExifSayNothing) {
  const TempFolder folder;
  folder.Write("a.pfm", "PF\n1 1\n-1\n");
  for (const char* name : {"a.pfm", "missing.jpg"}) {
    const ExposureMetadata metadata = ReadExposureMetadata(folder.Path(name));
    EXPECT_FALSE(metadata.exposure_s || metadata.f_number || metadata.iso) << name;
  }
}

// DNG 1.4, chapter 6: big-endian count, then id, version, flags, size and content of each opcode.
TEST(RawPhoto, AMapOfTheLensShadingIsSeen) {
  const TempFolder folder;
  support::TestDng dng = MosaicOf([](size_t, int, int) { return 100; });
  const auto has_map = [&] {
    support::WriteTestDng(folder.Path("a.dng"), dng);
    return HasLensShadingMap(folder.Path("a.dng"));
  };
  EXPECT_FALSE(has_map());
  const std::vector<std::uint32_t> warp = {0, 0, 0, 1, 1, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4, 9, 9, 9, 9};
  dng.opcode_list_3 = {0, 0, 0, 1};
  dng.opcode_list_3.insert(dng.opcode_list_3.end(), warp.begin(), warp.end());
  EXPECT_FALSE(has_map()) << "an opcode of another kind";
  dng.opcode_list_3[3] = 2;
  const std::vector<std::uint32_t> map = {0, 0, 0, 9, 1, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0};
  dng.opcode_list_3.insert(dng.opcode_list_3.end(), map.begin(), map.end());
  EXPECT_TRUE(has_map());
  dng.is_linear = true;
  dng.counts.resize(3 * dng.counts.size());
  EXPECT_TRUE(has_map()) << "a linear one";
  dng.opcode_list_3.resize(12);
  EXPECT_FALSE(has_map()) << "cut off";
  EXPECT_FALSE(HasLensShadingMap(folder.Path("none.dng")));
}

}  // namespace
}  // namespace luxfit
