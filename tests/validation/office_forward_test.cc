// The office of fixtures/office, whose readings an independent renderer made: predicted from the true
// luminaires and reflectances, nothing fitted.
//
// Both compute diffuse interreflection of the same mesh. The renderer's panels hang 1 cm below the ceiling,
// opaque and dark behind, each there in its own readings only; its downlights are points here and cover
// nothing. The renderer's own error is 0.2 to 0.5 % (its README: 14 bounces, no cache). Ours: 256 rays an
// element, elements of 0.1 m, 8 shares of a shadow edge.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "forward/light/covered_surfaces.h"
#include "forward/light/illuminance.h"
#include "forward/light/room.h"
#include "forward/mesh/mesh_file.h"
#include "forward/room/scene.h"
#include "tests/support/office_truth.h"

namespace luxfit {
namespace {

// Of R, G, B in luminance, as in truth.json's renderer and the session format.
const Eigen::Vector3d kLuminanceWeights(0.265, 0.670, 0.065);

// Receivers x luminaires, lx, each luminaire alone.
struct OfficeLight {
  Eigen::MatrixXd lux;
  Eigen::MatrixXd hidden;  // what black bodies hide of it
};

// Reflectances have colours, so each channel has its own interreflection.
OfficeLight PredictLux(const Room& room, const std::vector<Luminaire>& lamps,
                       const std::vector<Sensor>& sensors, const nlohmann::json& materials) {
  const Receivers receivers = MakeReceivers(room, {}, sensors);
  const LuminaireVisibility visibility = ComputeVisibility(room, receivers, lamps);
  const std::vector<CoveredSurface> surfaces = FindCoveredSurfaces(room, lamps);
  OfficeLight light;
  light.lux.setZero(receivers.count(), static_cast<Eigen::Index>(lamps.size()));
  light.hidden = light.lux;
  for (int channel = 0; channel < 3; ++channel) {
    Eigen::VectorXd albedo(static_cast<Eigen::Index>(room.scene.materials.size()));
    for (Eigen::Index m = 0; m < albedo.size(); ++m) {
      albedo[m] = materials.at(room.scene.materials[static_cast<size_t>(m)]).at(static_cast<size_t>(channel));
    }
    const Transport transport(room.transport, albedo);
    light.lux += kLuminanceWeights[channel] *
                 ComputeIlluminance(room, receivers, visibility, lamps, transport).total.cast<double>();
    const CoveredLight covered = ComputeCoveredLight(room, receivers, visibility, lamps, transport, surfaces);
    for (size_t j = 0; j < surfaces.size(); ++j) {
      const auto row = static_cast<Eigen::Index>(j);
      const Eigen::Index k = surfaces[j].luminaire;
      light.hidden.col(k) += kLuminanceWeights[channel] * surfaces[j].share * albedo[surfaces[j].material] *
                             covered.incident(row, k) * covered.response.col(row);
    }
  }
  const Eigen::VectorXd flux = FluxesLm(lamps);
  light.lux *= flux.asDiagonal();
  light.hidden *= flux.asDiagonal();
  return light;
}

// Errors of points x luminaires, percent.
struct Errors {
  double rms = 0, worst = 0;
  double spread = 0;  // largest less least mean of a luminaire
};

Errors PrintErrors(const char* name, const Eigen::ArrayXXd& percent) {
  const Eigen::ArrayXd mean = percent.colwise().mean();
  const Errors errors{std::sqrt(percent.square().mean()), percent.abs().maxCoeff(),
                      mean.maxCoeff() - mean.minCoeff()};
  std::printf("%s, error of predicted lux, %% of the reading (rows: luminaires; last: mean)\n", name);
  for (Eigen::Index k = 0; k < percent.cols(); ++k) {
    for (Eigen::Index p = 0; p < percent.rows(); ++p) std::printf("%+8.2f", percent(p, k));
    std::printf("   %+8.2f\n", mean[k]);
  }
  std::printf("rms %.2f %%, worst %.2f %%, means within %.2f %%\n", errors.rms, errors.worst, errors.spread);
  return errors;
}

TEST(OfficeForward, AgreesWithTheRendererWhereBodiesHideTheCeiling) {
  const nlohmann::json truth = support::OfficeTruth();
  const std::vector<std::vector<std::string>> expected = support::OfficeTable("truth_lux_per_lamp.csv");
  std::vector<Luminaire> lamps;
  for (const nlohmann::json& lamp : truth.at("lamps")) lamps.push_back(support::OfficeLuminaire(lamp));
  const size_t points = expected.at(0).size() - 1;
  ASSERT_EQ(expected.size(), lamps.size() + 1);
  ASSERT_EQ(points, 8u);
  Eigen::ArrayXXd reading_lx(static_cast<Eigen::Index>(points), static_cast<Eigen::Index>(lamps.size()));
  for (size_t k = 0; k < lamps.size(); ++k) {
    ASSERT_EQ(expected[k + 1].at(0), lamps[k].id);
    for (size_t p = 0; p < points; ++p)
      reading_lx(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(k)) =
          std::stod(expected[k + 1].at(p + 1));
  }

  const Room room = MakeRoom(ReadScene(support::kOfficeFolder + "room.obj"));
  const OfficeLight light =
      PredictLux(room, lamps, support::OfficeSensors(support::OfficeTable("luxmeter.csv"), points),
                 truth.at("materials"));
  const Errors without = PrintErrors("without bodies", 100 * (light.lux.array() / reading_lx - 1));
  const Errors with = PrintErrors("with bodies", 100 * ((light.lux - light.hidden).array() / reading_lx - 1));
  EXPECT_LE(with.spread, 0.5);
  EXPECT_GE(without.spread, 0.7);
  EXPECT_LE(with.rms, 0.35);
  EXPECT_LE(with.worst, 1);
}

}  // namespace
}  // namespace luxfit
