#include "inverse/albedo/photometric_stereo.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace luxfit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Three images of six pixels: three of the object, one of which is not determined, and three of the reference.
struct Solved {
  StereoData data;
  PhotometricStereo result;
  StereoRegions regions;

  Solved() {
    data.value = Eigen::MatrixXd::Ones(3, 6);
    data.to_light = Eigen::Matrix3d::Identity();
    data.direction_sigma_rad = Eigen::Vector3d::Constant(0.01);
    result.status = StereoStatus::kDone;
    result.albedo.resize(6);
    result.albedo << 0.2, 0.4, kNaN, 1.0, 1.2, 5.0;
    result.albedo_sigma = Eigen::VectorXd::Constant(6, 0.02);
    result.normal_sigma_rad = Eigen::VectorXd::LinSpaced(6, 0.1, 0.6);
    result.to_light = data.to_light;
    result.residual = Eigen::MatrixXd::Constant(3, 6, 0.5);
    result.residual.row(1) << -0.1, 0.2, kNaN, 9, 9, 9;
    regions = {{true, true, true, false, false, false}, {false, false, false, true, true, true}, 0.6};
  }

  StereoSummary Summary() const { return Summarize(data, result, regions); }
};

TEST(StereoSummary, TheReferencesMedianGivesReflectance) {
  const StereoSummary summary = Solved().Summary();
  EXPECT_TRUE(summary.is_absolute);
  EXPECT_DOUBLE_EQ(summary.factor, 0.6 / 1.2);
  EXPECT_EQ(summary.pixels, 3);
  EXPECT_EQ(summary.determined, 2);
  EXPECT_DOUBLE_EQ(summary.albedo_mean, 0.15);
  EXPECT_DOUBLE_EQ(summary.albedo_variation, 0.05 / 0.15);
  EXPECT_DOUBLE_EQ(summary.albedo_sigma, 0.01);
  EXPECT_DOUBLE_EQ(summary.normal_sigma_rad, 0.2);  // the upper one of two
}

TEST(StereoSummary, WithoutAReferenceAlbedoKeepsItsUnit) {
  Solved solved;
  solved.regions.is_reference.assign(6, false);
  const StereoSummary summary = solved.Summary();
  EXPECT_FALSE(summary.is_absolute);
  EXPECT_EQ(summary.factor, 1);
  EXPECT_DOUBLE_EQ(summary.albedo_mean, 0.3);
}

TEST(StereoSummary, LightsFarFromTheirMeasuredDirectionAreSuspect) {
  Solved solved;
  EXPECT_THAT(solved.Summary().suspect_lights, IsEmpty());
  solved.result.to_light.col(0) =
      Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitZ()) * Eigen::Vector3d::UnitX();
  solved.result.to_light.col(2) =
      Eigen::AngleAxisd(0.04, Eigen::Vector3d::UnitX()) * Eigen::Vector3d::UnitZ();
  const StereoSummary summary = solved.Summary();
  EXPECT_THAT(summary.suspect_lights, ElementsAre(2));
  EXPECT_NEAR(summary.adjusted_rad[0], 0.02, 1e-9);  // rounding of an arc cosine near 1
  EXPECT_NEAR(summary.adjusted_rad[2], 0.04, 1e-9);
  // Exact directions were not adjusted.
  solved.data.direction_sigma_rad.resize(0);
  EXPECT_THAT(solved.Summary().suspect_lights, IsEmpty());
}

TEST(StereoSummary, ResidualsAreThoseOfTheObject) {
  const StereoSummary summary = Solved().Summary();
  EXPECT_DOUBLE_EQ(summary.median_residual[0], 0.5);
  EXPECT_DOUBLE_EQ(summary.median_residual[1], 0.2);  // the upper one of two
}

TEST(StereoSummary, AnObjectThatNothingDeterminesHasNoNumbers) {
  Solved solved;
  solved.result.albedo.head(3).setConstant(kNaN);
  const StereoSummary summary = solved.Summary();
  EXPECT_EQ(summary.determined, 0);
  EXPECT_TRUE(std::isnan(summary.albedo_mean));
  EXPECT_TRUE(std::isnan(summary.albedo_sigma));
}

TEST(StereoSummary, RegionsAreChecked) {
  Solved solved;
  solved.regions.is_object.pop_back();
  EXPECT_THROW(solved.Summary(), std::invalid_argument);
  Solved unsolved;
  unsolved.result.status = StereoStatus::kUndetermined;
  EXPECT_THROW(unsolved.Summary(), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
