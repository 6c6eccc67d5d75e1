#include "calib/luminance/colour_profile.h"

#include <gtest/gtest.h>
#include <lcms2.h>

#include <algorithm>
#include <cmath>
#include <exiv2/exiv2.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/calib/test_heic.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

// Returns an RGB profile of primaries like sRGB's and that curve.
std::vector<cmsUInt8Number> ProfileWith(cmsToneCurve* curve) {
  const cmsCIExyY white{0.3127, 0.3290, 1};
  const cmsCIExyYTRIPLE primaries{{0.64, 0.33, 1}, {0.30, 0.60, 1}, {0.15, 0.06, 1}};
  cmsToneCurve* curves[3] = {curve, curve, curve};
  cmsHPROFILE profile = cmsCreateRGBProfile(&white, &primaries, curves);
  cmsUInt32Number size = 0;
  cmsSaveProfileToMem(profile, nullptr, &size);
  std::vector<cmsUInt8Number> bytes(size);
  cmsSaveProfileToMem(profile, bytes.data(), &size);
  cmsCloseProfile(profile);
  cmsFreeToneCurve(curve);
  return bytes;
}

std::vector<cmsUInt8Number> SrgbProfile() {
  const cmsFloat64Number parameters[] = {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045};
  return ProfileWith(cmsBuildParametricToneCurve(nullptr, 4, parameters));
}

std::optional<ColourProfile> ReadWith(const std::vector<cmsUInt8Number>& icc,
                                      const std::string& name = "a.jpg") {
  const TempFolder folder;
  const std::string path = folder.Path(name);
  EXPECT_TRUE(cv::imwrite(path, cv::Mat(8, 8, CV_8UC3, cv::Scalar(9, 9, 9))));
  if (!icc.empty()) {
    const auto image = Exiv2::ImageFactory::open(path);
    image->readMetadata();
    Exiv2::DataBuf buffer(icc.data(), static_cast<long>(icc.size()));
#if EXIV2_TEST_VERSION(0, 28, 0)
    image->setIccProfile(std::move(buffer));
#else
    image->setIccProfile(buffer);
#endif
    image->writeMetadata();
  }
  return ReadColourProfile(path);
}

TEST(ColourProfileTest, APowerOfTwoPointTwo) {
  const std::optional<ColourProfile> profile = ReadWith(ProfileWith(cmsBuildGamma(nullptr, 2.2)));
  ASSERT_TRUE(profile);
  const CameraResponse response = profile->Response(255);
  for (const double count : {30.0, 128.0, 200.0, 255.0}) {
    for (size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(response.Exposure(c, count), std::pow(count / 255, 2.2), 1e-4) << count;
  }
  EXPECT_NEAR(response.RelativeSigma(1, 128), 0.05, 1e-12);
  EXPECT_GT(profile->DifferenceFromSrgb(), 0.05);
}

TEST(ColourProfileTest, SrgbsOwnProfileIsSrgb) {
  for (const char* name : {"a.jpg", "a.png"}) {
    const std::optional<ColourProfile> profile = ReadWith(SrgbProfile(), name);
    ASSERT_TRUE(profile) << name;
    EXPECT_LT(profile->DifferenceFromSrgb(), 0.005) << name;
  }
}

// IEC 61966-2-1: D65's white, not that of the profile, which is D50.
TEST(ColourProfileTest, PrimariesAreThoseBeforeTheAdaptationToD50) {
  const std::optional<ColourProfile> profile = ReadWith(SrgbProfile());
  ASSERT_TRUE(profile && profile->xyz_from_rgb);
  Eigen::Matrix3d srgb;
  srgb << 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505;
  EXPECT_LT((*profile->xyz_from_rgb - srgb).cwiseAbs().maxCoeff(), 2e-3) << *profile->xyz_from_rgb;
}

TEST(ColourProfileTest, NoneAndBrokenOnesStateNothing) {
  EXPECT_FALSE(ReadWith({}));
  std::vector<cmsUInt8Number> broken = SrgbProfile();
  std::fill(broken.begin() + 128, broken.end(), cmsUInt8Number{0});  // what follows the header
  EXPECT_FALSE(ReadWith(broken));
  EXPECT_FALSE(ReadColourProfile("/nowhere.jpg"));
}

std::optional<ColourProfile> ReadHeicOf(int transfer) {
  const TempFolder folder;
  support::TestHeic heic;
  heic.width_px = heic.height_px = 64;
  heic.counts.assign(3 * 64 * 64, 90);
  heic.transfer = transfer;
  if (!support::WriteHeic(folder.Path("a.heic"), heic)) return std::nullopt;
  return ReadColourProfile(folder.Path("a.heic"));
}

// ITU-R BT.2100-2: PQ of 0.5081 is 1 % of 10 000 cd/m2; HLG of a half is a twelfth.
TEST(ColourProfileTest, CodingPointsOfHeic) {
  const std::optional<ColourProfile> pq = ReadHeicOf(16), hlg = ReadHeicOf(18);
  if (!pq || !hlg) GTEST_SKIP() << "libheif cannot write HEIC here";
  EXPECT_NEAR(pq->Response(1).Exposure(0, 0.5081), 0.01, 1e-4);
  EXPECT_NEAR(hlg->Response(1).Exposure(2, 0.5), 1.0 / 12, 1e-3);
  EXPECT_FALSE(ReadHeicOf(13)) << "sRGB needs no curve of its own";
  EXPECT_FALSE(ReadHeicOf(1)) << "BT.709 is written by encoders that were told nothing";
}

}  // namespace
}  // namespace luxfit
