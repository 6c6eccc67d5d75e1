#include "inverse/albedo/patch_albedo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <stdexcept>

#include "tests/support/inverse/poster_room.h"

namespace luxfit {
namespace {

constexpr int kWall = 0, kFloor = 1, kCeiling = 2;

std::string Scores(const MaterialAlbedo& material) {
  std::string text = material.because;
  for (const DetailScore& s : material.scores) {
    text += "\n" + ToString(s.detail) + " " + std::to_string(s.score) + " +- " +
            std::to_string(s.standard_error) + ", texture " + std::to_string(s.texture);
  }
  return text;
}

// Traced once for all tests.
const Room& TheRoom() {
  static const Room room = support::PosterRoomModel();
  return room;
}
const LightData& TheData() {
  static const LightData data = [] {
    std::mt19937_64 rng(7);
    return support::PosterRoomData(TheRoom(), 0.005, 4096, rng);
  }();
  return data;
}

TEST(PatchAlbedo, MaterialsComeOutAndThePosterIsFound) {
  const PatchAlbedo result = EstimatePatchAlbedo(TheRoom(), TheData(), support::PosterRoomLight());
  ASSERT_EQ(result.materials.size(), 3U);
  const Eigen::VectorXd truth = support::PosterRoomAlbedo();
  for (const int m : {kFloor, kCeiling}) {
    const MaterialAlbedo& material = result.materials[static_cast<size_t>(m)];
    EXPECT_EQ(material.detail, AlbedoDetail::kMaterial) << Scores(material);
    // Elements of half a metre: their light is known to about a percent.
    EXPECT_NEAR(material.albedo / truth[m], 1, 0.015);
    EXPECT_LT(std::abs(material.albedo - truth[m]), 4 * material.sigma);
    // Three states of one facet that err by 1 % each: sqrt(3 / 2) of their mean's 1 % / sqrt(3). 1.5 times that.
    std::printf("material %d: relative sigma %.4f\n", m, material.sigma / truth[m]);
    EXPECT_LT(material.sigma / truth[m], 0.011);
    EXPECT_EQ(material.unlike_elements, 0);
  }
  const MaterialAlbedo& wall = result.materials[kWall];
  EXPECT_NE(wall.detail, AlbedoDetail::kMaterial) << Scores(wall);
  // The wall is not darkened by the poster, which is a tenth of it.
  EXPECT_NEAR(wall.albedo / truth[kWall], 1, 0.015);
  EXPECT_EQ(wall.unlike_elements, 12);
  int on_poster = 0;
  for (const AlbedoUnit& unit : result.units) {
    if (unit.material != kWall) continue;
    const Eigen::Vector3d at = TheRoom().patches.patches[static_cast<size_t>(unit.patch)].center;
    const bool poster = support::OnPoster(at);
    on_poster += poster ? 1 : 0;
    EXPECT_NEAR(unit.albedo / (poster ? support::kPosterAlbedo : truth[kWall]), 1, 0.06) << at.transpose();
  }
  EXPECT_EQ(on_poster, 12);
}

// Without it the walls would have to reflect what came from elsewhere.
TEST(PatchAlbedo, InterreflectionIsNoAlbedo) {
  PatchAlbedoOptions options;
  options.interreflection = false;
  const PatchAlbedo direct = EstimatePatchAlbedo(TheRoom(), TheData(), support::PosterRoomLight(), options);
  EXPECT_GT(direct.materials[kFloor].albedo, 1.05 * support::PosterRoomAlbedo()[kFloor]);
  EXPECT_GT(direct.materials[kWall].albedo, 1.15 * support::PosterRoomAlbedo()[kWall]);
}

// What no photo shows takes its material's albedo: leaving the floor out moves the others little.
TEST(PatchAlbedo, UnseenSurfacesReflectAsTheirMaterial) {
  LightData part = TheData();
  part.observations.clear();
  for (const Observation& o : TheData().observations) {
    const int patch = TheRoom().patches.elements[static_cast<size_t>(o.element)].patch;
    if (TheRoom().patches.patches[static_cast<size_t>(patch)].material != kFloor)
      part.observations.push_back(o);
  }
  const PatchAlbedo result = EstimatePatchAlbedo(TheRoom(), part, support::PosterRoomLight());
  EXPECT_TRUE(std::isnan(result.materials[kFloor].albedo));
  EXPECT_EQ(result.materials[kFloor].observations, 0);
  EXPECT_NEAR(result.materials[kWall].albedo / support::PosterRoomAlbedo()[kWall], 1, 0.02);
}

TEST(PatchAlbedo, HighlightsAreNotAveragedIn) {
  // A quarter of the floor glares in one state.
  LightData data = TheData();
  for (Observation& o : data.observations) {
    const int patch = TheRoom().patches.elements[static_cast<size_t>(o.element)].patch;
    const bool floor = TheRoom().patches.patches[static_cast<size_t>(patch)].material == kFloor;
    if (floor && o.state == 1 && o.element % 4 == 0) o.relative_luminance *= 3;
  }
  const PatchAlbedo result = EstimatePatchAlbedo(TheRoom(), data, support::PosterRoomLight());
  EXPECT_NEAR(result.materials[kFloor].albedo / support::PosterRoomAlbedo()[kFloor], 1, 0.02);
  EXPECT_EQ(result.materials[kFloor].detail, AlbedoDetail::kMaterial) << Scores(result.materials[kFloor]);
}

// The error of fluxes and camera scale is independent of the data's own: variances add, each material's to its own.
TEST(PatchAlbedo, CommonSigmaIsInEverySigma) {
  PatchAlbedoOptions options;
  options.common_sigma = Eigen::Vector3d(0.02, 0, 0.05);
  const PatchAlbedo with = EstimatePatchAlbedo(TheRoom(), TheData(), support::PosterRoomLight(), options),
                    without = EstimatePatchAlbedo(TheRoom(), TheData(), support::PosterRoomLight());
  ASSERT_EQ(with.units.size(), without.units.size());
  ASSERT_FALSE(with.units.empty());
  for (size_t i = 0; i < with.units.size(); ++i) {
    const AlbedoUnit &unit = with.units[i], &alone = without.units[i];
    const double added = unit.sigma * unit.sigma - alone.sigma * alone.sigma;
    const double relative = options.common_sigma[unit.material];
    EXPECT_EQ(unit.albedo, alone.albedo) << i;
    EXPECT_NEAR(added, std::pow(relative * unit.albedo, 2), 1e-12) << i;  // rounding
  }
  options.common_sigma = Eigen::VectorXd::Zero(2);
  EXPECT_THROW(EstimatePatchAlbedo(TheRoom(), TheData(), support::PosterRoomLight(), options),
               std::invalid_argument);
}

// The fit knows the wall to 3 %, holds the floor and does not determine the ceiling.
TEST(PatchAlbedo, CommonSigmaIsThatOfTheFit) {
  LuminaireFit fit;
  fit.state = support::PosterRoomLight();
  for (const int m : {kWall, kCeiling}) {
    Parameter parameter;
    parameter.kind = ParameterKind::kAlbedo;
    parameter.index = m;
    parameter.owner = TheRoom().scene.materials[static_cast<size_t>(m)];
    fit.parameters.push_back(parameter);
  }
  const double sigma = 0.03 * fit.state.albedo[kWall];
  fit.covariance = Eigen::Vector2d(sigma * sigma, 1).asDiagonal();
  fit.undetermined = {fit.parameters[1].id()};
  PatchAlbedoOptions options;
  options.common_sigma = Eigen::Vector3d(0.03, 0, 0);
  const PatchAlbedo given = EstimatePatchAlbedo(TheRoom(), TheData(), fit.state, options);
  const PatchAlbedo fitted = EstimatePatchAlbedo(TheRoom(), TheData(), fit);
  for (const size_t m : {kWall, kFloor, kCeiling})
    EXPECT_NEAR(fitted.materials[m].sigma, given.materials[m].sigma, 1e-12) << m;  // rounding
}

TEST(PatchAlbedo, AFewUnlikeElementsAreBorderAndStains) {
  MaterialAlbedo material;
  material.elements = 100;
  material.unlike_elements = 2;
  EXPECT_FALSE(material.IsUneven());
  material.unlike_elements = 3;
  EXPECT_TRUE(material.IsUneven());
}

// One state: an element's others are its neighbours, so nothing finer than patches can be told.
TEST(PatchAlbedo, OneStateIsEnoughForMaterials) {
  LightData one = TheData();
  one.observations.clear();
  for (const Observation& o : TheData().observations) {
    if (o.state == 0) one.observations.push_back(o);
  }
  const PatchAlbedo result = EstimatePatchAlbedo(TheRoom(), one, support::PosterRoomLight());
  for (const MaterialAlbedo& m : result.materials) EXPECT_EQ(m.detail, AlbedoDetail::kMaterial) << Scores(m);
  EXPECT_NEAR(result.materials[kCeiling].albedo / support::PosterRoomAlbedo()[kCeiling], 1, 0.03);
}

}  // namespace
}  // namespace luxfit
