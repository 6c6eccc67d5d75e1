// Reflectances that only indirect light tells: readings alone in a box whose walls are chequered, which the model does
// not know. The unbiased light tracer lights it: the truth shares no patch, no form factor and no material with
// what is estimated from it.
//
// The box is 1.2 m x 1.2 m x 1.5 m. The luminaire, a panel of 0.6 m, is given. 100 readings face up, at 4 heights,
// with noise of 1 %. Walls consist of tiles of 0.3 m whose reflectance is half as large again as their mean, or half
// of it, in each draw at other places. Floor and ceiling are even.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "forward/light/light_tracer.h"
#include "inverse/fit/fit_room.h"
#include "tests/support/inverse/textured_room.h"
#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr int kFloor = 1, kMaterials = 3;
const Eigen::Vector3d kMeanAlbedo(0.6, 0.4, 0.7);  // wall, floor, ceiling

Room BoxModel() {
  RoomOptions options;
  options.patches.patch_size_m = 0.3;
  options.patches.element_size_m = 0.1;
  return MakeRoom(support::ClosedRoom({1.2, 1.2, 1.5}, {"wall", "wall", "wall", "wall", "floor", "ceiling"}),
                  options);
}

Luminaire Panel() {
  Luminaire panel;
  panel.id = "panel";
  panel.position = {0.6, 0.6, 1.3};
  panel.flux_lm = 1000;
  panel.shape = LuminaireShape::kRectangle;
  panel.size_m = {0.6, 0.6};
  return panel;
}

std::vector<Sensor> Places() {
  std::vector<Sensor> places;
  places.reserve(100);
  for (const double z : {0.2, 0.5, 0.8, 1.1})
    for (int i = 0; i < 25; ++i)
      places.push_back({{0.2 + 0.2 * (i % 5), 0.2 + 0.2 * (i / 5), z}, {0, 0, 1}, {}});
  return places;
}

// Holds a box whose walls are chequered at random: half of all tiles are dark, half are bright.
struct ChequeredBox {
  Scene scene;
  Eigen::VectorXd albedo;  // by tile
};
ChequeredBox DrawBox(const Scene& model, double contrast, std::mt19937_64& rng) {
  constexpr double kTileM = 0.3, kWhole = 100;
  ChequeredBox box;
  std::vector<double> albedo;
  for (const Facet& facet : model.facets) {
    const bool is_wall = facet.material == 0;
    const support::TileGrid grid = support::AddTiles(facet, is_wall ? kTileM : kWhole, box.scene);
    const auto count = static_cast<size_t>(grid.count_u) * static_cast<size_t>(grid.count_v);
    std::vector<double> factors(count, 1);
    for (size_t t = 0; is_wall && t < count; ++t) factors[t] = 1 + (t % 2 == 0 ? contrast : -contrast);
    std::shuffle(factors.begin(), factors.end(), rng);
    for (const double factor : factors) albedo.push_back(kMeanAlbedo[facet.material] * factor);
  }
  box.albedo = Eigen::Map<Eigen::VectorXd>(albedo.data(), static_cast<Eigen::Index>(albedo.size()));
  return box;
}

RoomObservations ReadBox(const ChequeredBox& box, std::mt19937_64& rng) {
  constexpr double kNoise = 0.01;
  std::normal_distribution<double> normal;
  RoomObservations given;
  given.dimming = {Eigen::VectorXd::Ones(1)};
  KnownLuminaire known;
  known.luminaire = Panel();
  known.position_m = known.luminaire.position;
  known.aim = known.luminaire.aim;
  known.flux_lm = known.luminaire.flux_lm;
  known.is_held = known.shape_is_known = true;
  known.photometry = KnownPhotometry::kLobe;
  given.luminaires.push_back(known);
  LightTracerOptions options;
  options.paths_per_sensor = 4096;
  options.replicates = 8;
  options.seed = rng();
  const std::vector<Sensor> places = Places();
  const TracedIlluminance lx =
      TraceIlluminance(box.scene, RayScene(box.scene), {Panel()}, box.albedo, places, options);
  for (size_t i = 0; i < places.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double read_lx = (lx.direct(row, 0) + lx.indirect(row, 0)) * (1 + kNoise * normal(rng));
    given.meter.readings.push_back({places[i], 0, read_lx, 0, true, -1});
  }
  return given;
}

// Holds errors of reflectances and the sigmas that the fit states of them: draws x materials.
struct Errors {
  Eigen::ArrayXXd error, sigma;
};

Errors FitDraws(const Room& model, double contrast, int draws, std::mt19937_64& rng) {
  Errors errors{Eigen::ArrayXXd(draws, kMaterials), Eigen::ArrayXXd(draws, kMaterials)};
  for (int draw = 0; draw < draws; ++draw) {
    const RoomFit fit = FitRoom(model, ReadBox(DrawBox(model.scene, contrast, rng), rng));
    for (int m = 0; m < kMaterials; ++m) {
      errors.error(draw, m) = fit.fit.state.albedo[m] - kMeanAlbedo[m];
      errors.sigma(draw, m) = SigmaOf(fit.fit, ParameterKind::kAlbedo, m);
    }
  }
  return errors;
}

// The rms of the normalised errors over 12 independent draws is below 1.40 with a probability of 97.5 % if sigmas are
// right (chi2 of 12). It may be small: a reflectance that is not determined stops at a bound, within its sigma. Sigmas
// that follow the residuals are much smaller where the walls are even, and say something there: they are below that of an
// even distribution from 0 to 1, 1 / sqrt(12).
TEST(IndirectAlbedoTest, IntervalsHoldWhereWallsAreChequered) {
  constexpr int kDraws = 12, kEvenDraws = 4;
  constexpr double kMostRms = 1.40;
  std::mt19937_64 rng = support::TestRng();
  const Room model = BoxModel();
  const Errors chequered = FitDraws(model, 0.5, kDraws, rng), even = FitDraws(model, 0, kEvenDraws, rng);
  for (int m = 0; m < kMaterials; ++m) {
    const double rms = std::sqrt((chequered.error.col(m) / chequered.sigma.col(m)).square().mean());
    std::printf("%s: rms of error over sigma %.2f, mean sigma %.3f chequered, %.3f even\n",
                model.scene.materials[static_cast<size_t>(m)].c_str(), rms, chequered.sigma.col(m).mean(),
                even.sigma.col(m).mean());
    EXPECT_LT(rms, kMostRms);
    EXPECT_LT(even.sigma.col(m).mean(), 1 / std::sqrt(12.0));
    EXPECT_LT(even.sigma.col(m).mean(), 0.5 * chequered.sigma.col(m).mean());
    EXPECT_LT((even.error.col(m) / even.sigma.col(m)).abs().maxCoeff(), 3);
  }
}

TEST(IndirectAlbedoTest, EachReflectanceIsNamed) {
  std::mt19937_64 rng = support::TestRng();
  const Room model = BoxModel();
  RoomObservations given = ReadBox(DrawBox(model.scene, 0.5, rng), rng);
  given.albedo = {std::nullopt, kMeanAlbedo[kFloor], std::nullopt};
  const RoomFit fit = FitRoom(model, given);
  EXPECT_EQ(ToldByIndirectLight(model, fit), (std::vector<bool>{true, false, true}));
  std::vector<std::string> named;
  for (const Warning& w : fit.findings.warnings)
    if (w.code == "albedo_by_indirect_light") named.push_back(w.remedy.substr(w.remedy.rfind('.') + 1));
  EXPECT_EQ(named, (std::vector<std::string>{"wall", "ceiling"}));
}

}  // namespace
}  // namespace luxfit
