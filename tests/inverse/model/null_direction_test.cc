#include "inverse/model/internal/intervals/null_direction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace luxfit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Parameter Flux(const std::string& id) { return {ParameterKind::kLogFlux, 0, {}, -50, 50, id}; }
Parameter Own(LuminaireQuantity quantity, const std::string& id) {
  return {ParameterKind::kLuminaire, 0, quantity, -1, 1, id};
}
const Parameter kScale{ParameterKind::kLogCameraScale, 0, {}, -50, 50, ""};
const Parameter kWallMaterial{ParameterKind::kAlbedo, 0, {}, 0, 1, "wall"};

NullDirection Even(const std::vector<Parameter>& parameters) {
  const auto n = static_cast<Eigen::Index>(parameters.size());
  return DescribeNullDirection(parameters,
                               Eigen::VectorXd::Constant(n, 1 / std::sqrt(static_cast<double>(n))));
}

TEST(NullDirectionTest, PhotosAloneHaveNoScale) {
  const NullDirection direction = Even({Flux("A"), Flux("B"), kScale});
  EXPECT_EQ(direction.meaning,
            "the flux of A and B and the camera's scale are known only up to one common factor");
  EXPECT_THAT(direction.remedy, HasSubstr("luxmeter.scale"));
}

TEST(NullDirectionTest, LuminairesThatAreAlwaysOnTogether) {
  const NullDirection direction = Even({Flux("A"), Flux("B"), Flux("C")});
  EXPECT_EQ(direction.meaning, "the fluxes of A, B and C are known only together");
  EXPECT_THAT(direction.remedy, HasSubstr("one of them alone"));
}

TEST(NullDirectionTest, DirectAndReflectedLight) {
  const NullDirection direction = Even({Flux("A"), kWallMaterial});
  EXPECT_THAT(direction.meaning, HasSubstr("direct and reflected light are not told apart"));
  EXPECT_THAT(direction.remedy, HasSubstr("dark cloth"));
}

TEST(NullDirectionTest, HeightLobeAndFluxOfOneLuminaire) {
  const NullDirection direction =
      Even({Own(LuminaireQuantity::kPositionZ, "C"), Own(LuminaireQuantity::kExponent, "C"), Flux("C")});
  EXPECT_EQ(direction.meaning, "height, lobe and flux of C trade off");
  EXPECT_THAT(direction.remedy, HasSubstr("nearer to C"));
}

TEST(NullDirectionTest, WhatChangesNothing) {
  EXPECT_EQ(Even({kWallMaterial}).meaning, "the reflectance of wall changes nothing that was measured");
  EXPECT_EQ(Even({Own(LuminaireQuantity::kTiltAlong, "D")}).meaning,
            "aim of D changes nothing that was measured");
}

TEST(NullDirectionTest, SmallPartsAreNotNamedAndTheStrongestComesFirst) {
  const NullDirection direction =
      DescribeNullDirection({Flux("A"), kWallMaterial, kScale}, Eigen::Vector3d(-0.5, 0.05, 0.86));
  EXPECT_THAT(direction.parameters, ElementsAre(kScale.id(), Flux("A").id()));
  EXPECT_THROW(DescribeNullDirection({kScale}, Eigen::Vector2d(1, 0)), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
