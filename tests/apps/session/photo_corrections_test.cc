#include "apps/session/photo_corrections.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

class PhotoCorrectionsTest : public testing::Test {
 protected:
  PhotoCorrections Read(const std::string& observed) const {
    folder_.Write("stages/observe.json", observed);
    return ReadPhotoCorrections(folder_.Path(""));
  }

  TempFolder folder_;
};

constexpr char kGains[] = R"("camera_gains": [{"camera": "cam1", "gain": 0.64}])";

TEST_F(PhotoCorrectionsTest, GainsOfCamerasNeedNoSelfCalibration) {
  const PhotoCorrections corrections = Read("{" + std::string(kGains) + "}");
  EXPECT_EQ(corrections.Of("cam0", "a.png").log_gain, 0);
  EXPECT_DOUBLE_EQ(corrections.Of("cam1", "a.png").log_gain, std::log(0.64));
}

TEST_F(PhotoCorrectionsTest, APhotosGainIsBeyondItsCameras) {
  const PhotoCorrections corrections = Read("{" + std::string(kGains) + R"(, "self_calibration": {
    "exposure_gains": [{"file": "a.png", "factor": 2}],
    "cameras": [{"camera": "cam1", "vignetting_coefficients": [-0.5], "response_exponent": 0.8}]}})");
  const PhotoCorrection known = corrections.Of("cam1", "a.png"), other = corrections.Of("cam1", "b.png");
  EXPECT_DOUBLE_EQ(known.log_gain, std::log(2 * 0.64));
  EXPECT_DOUBLE_EQ(other.log_gain, std::log(0.64));
  ASSERT_EQ(other.vignetting.size(), 1u);
  EXPECT_EQ(other.vignetting[0], -0.5);
  EXPECT_DOUBLE_EQ(other.exponent, 0.25);
}

}  // namespace
}  // namespace luxfit
