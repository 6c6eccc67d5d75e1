// Reads a camera's colours from a session, or from its photos.
#include <gmock/gmock.h>

#include <Eigen/LU>
#include <array>

#include "tests/support/apps/tiny_session.h"
#include "tests/support/calib/test_dng.h"

namespace luxfit {
namespace {

using ::testing::HasSubstr;

class SessionColoursTest : public TinySessionTest {
 protected:
  SessionCamera WithKey(const std::string& key, const std::string& after = "black_level = 64") const {
    folder_.Replace("session.toml", after, after + "\n" + key);
    return Read().cameras.at(0);
  }
};

TEST_F(SessionColoursTest, NothingIsTakenWhereNothingIsSaid) {
  const SessionCamera camera = Read().cameras.at(0);
  EXPECT_EQ(camera.colours, "");
  EXPECT_FALSE(camera.xyz_from_rgb);
  EXPECT_TRUE(Read().scene->neutral.empty());
}

TEST_F(SessionColoursTest, AMatrixGivesTheWeights) {
  const SessionCamera camera = WithKey("xyz_from_rgb = [[0.4, 0.3, 0.2], [0.2, 0.6, 0.0], [0.0, 0.1, 1.0]]");
  EXPECT_EQ(camera.colours, "xyz_from_rgb");
  EXPECT_LT((camera.luminance_weights - Eigen::Vector3d(0.25, 0.75, 0)).norm(), 1e-12);
  EXPECT_EQ((*camera.xyz_from_rgb)(2, 1), 0.1);
}

TEST_F(SessionColoursTest, WeightsAloneStateNoMatrix) {
  const SessionCamera camera = WithKey("luminance_weights = [0.2, 0.7, 0.1]");
  EXPECT_EQ(camera.colours, "luminance_weights");
  EXPECT_FALSE(camera.xyz_from_rgb);
}

TEST_F(SessionColoursTest, PhotosOfSrgbHaveItsPrimaries) {
  folder_.Replace("session.toml", "response = \"linear\"", "response = \"srgb\"");
  const SessionCamera camera = Read().cameras.at(0);
  EXPECT_EQ(camera.colours, "sRGB");
  EXPECT_LT((camera.luminance_weights - Eigen::Vector3d(0.2126, 0.7152, 0.0722)).norm(), 1e-3);
}

TEST_F(SessionColoursTest, RawBringsItsSensorsMatrix) {
  support::TestDng dng;
  dng.width_px = 40;
  dng.height_px = 32;
  dng.counts.assign(40 * 32, 1000);
  dng.color_matrix_1e4 = {20000, 0, 0, 0, 10000, 0, 0, 0, 5000};
  support::WriteTestDng(folder_.Path("photos/v0_Z.dng"), dng);
  folder_.Replace("photos.csv", "v0_Z.png", "v0_Z.dng");
  folder_.Replace("session.toml", "black_level = 64", "black_level = 0");
  const SessionCamera camera = Read().cameras.at(0);
  EXPECT_EQ(camera.colours, "the sensor's matrix");
  ASSERT_TRUE(camera.xyz_from_rgb);
  EXPECT_LT((camera.luminance_weights - Eigen::Vector3d::UnitY()).norm(), 1e-6);
  const SessionCamera given = WithKey("luminance_weights = [0.2, 0.7, 0.1]", "black_level = 0");
  EXPECT_EQ(given.colours, "luminance_weights");
}

TEST_F(SessionColoursTest, NeutralMaterialsAreAList) {
  folder_.Replace("session.toml", "unit = \"cm\"", "unit = \"cm\"\nneutral = [\"ceiling\", \"board\"]");
  EXPECT_EQ(Read().scene->neutral, (std::vector<std::string>{"ceiling", "board"}));
}

TEST_F(SessionColoursTest, WhatHasNoMeaningIsRefused) {
  const std::string key = "black_level = 64", file = "session.toml";
  const auto error_of = [&](const std::string& line) { return ErrorAfter(file, key, key + "\n" + line); };
  EXPECT_THAT(
      error_of("xyz_from_rgb = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\nluminance_weights = [0.2, 0.7, 0.1]"),
      HasSubstr("camera[0].xyz_from_rgb: expected either luminance_weights or xyz_from_rgb"));
  EXPECT_THAT(error_of("xyz_from_rgb = [[1, 0, 0], [0, 1, 0]]"), HasSubstr("expected three rows [r, g, b]"));
  EXPECT_THAT(error_of("xyz_from_rgb = [[1, 0, 0], [0, 1, 0], [1, 1, 0]]"),
              HasSubstr("expected a matrix that has an inverse"));
  EXPECT_THAT(error_of("xyz_from_rgb = [[1, 0, 0], [0, -1, 0], [0, 0, 1]]"),
              HasSubstr("a row of Y with a sum > 0"));
  EXPECT_THAT(ErrorAfter(file, "unit = \"cm\"", "unit = \"cm\"\nneutral = \"ceiling\""),
              HasSubstr("scene.neutral: expected a list of materials"));
}

}  // namespace
}  // namespace luxfit
