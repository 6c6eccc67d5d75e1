// What a luminaire emits arrives: every shape with every distribution in a black room, and the textbook value
// of a Lambertian source, E = Phi / (pi d^2) on its axis, along every path that gives illuminance.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "forward/direct/direct_light.h"
#include "forward/direct/sensor.h"
#include "forward/light/illuminance.h"
#include "forward/light/room.h"
#include "forward/luminaire/internal/ies_file.h"
#include "forward/luminaire/photometry.h"
#include "forward/luminaire/photometry_file.h"
#include "tests/support/closed_forms.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

using support::kPi;

// Intensities of a lobe that leans to one side, on planes all round, from nadir to zenith.
std::shared_ptr<const IntensityTable> LeaningLobe() {
  std::vector<double> c_rad, gamma_rad, intensity;
  for (int c = 0; c < 36; ++c) c_rad.push_back(c * kPi / 18);
  for (int g = 0; g <= 36; ++g) gamma_rad.push_back(g * kPi / 36);
  for (const double c : c_rad) {
    for (const double gamma : gamma_rad)
      intensity.push_back(std::pow(std::cos(gamma / 2), 4) * (1 + 0.6 * std::cos(c) * std::sin(gamma)));
  }
  return std::make_shared<IntensityTable>(
      Normalized(ExpandPlanes(c_rad, gamma_rad, intensity, PlaneSymmetry::kNone)));
}

TEST(LuminaireFlux, ABlackRoomReceivesAllOfIt) {
  const Room room = MakeRoom(support::ClosedRoom({4, 4, 4}));
  std::vector<Luminaire> luminaires;
  for (const Distribution distribution : {Distribution::kIsotropic, Distribution::kLambertian,
                                          Distribution::kCosinePower, Distribution::kMeasured}) {
    for (const LuminaireShape shape : {LuminaireShape::kPoint, LuminaireShape::kDisc,
                                       LuminaireShape::kRectangle, LuminaireShape::kSphere}) {
      Luminaire luminaire;
      luminaire.id = ToString(distribution) + " " + ToString(shape);
      luminaire.position = {2.1, 1.9, 2.2};
      luminaire.aim = Eigen::Vector3d(0.3, 0.2, -1).normalized();
      luminaire.distribution = distribution;
      luminaire.cosine_exponent = 3;
      luminaire.table = LeaningLobe();
      luminaire.shape = shape;
      luminaire.size_m = {0.6, 0.3};
      luminaires.push_back(luminaire);
    }
  }
  std::vector<int> elements(room.patches.elements.size());
  for (size_t e = 0; e < elements.size(); ++e) elements[e] = static_cast<int>(e);
  const Receivers receivers = MakeReceivers(room, elements, {});
  const Illuminance light = ComputeIlluminance(
      room, receivers, ComputeVisibility(room, receivers, luminaires), luminaires, Eigen::VectorXd::Zero(1));
  Eigen::VectorXd area_m2(static_cast<Eigen::Index>(elements.size()));
  for (size_t e = 0; e < elements.size(); ++e)
    area_m2[static_cast<Eigen::Index>(e)] = room.patches.elements[e].area_m2;
  const Eigen::VectorXd received_lm = light.total.cast<double>().transpose() * area_m2;
  for (size_t k = 0; k < luminaires.size(); ++k) {
    // Midpoint rule on elements of 0.1 m, 1.5 m away or more: (h / d)^2 / 24 = 0.02 %, times a curvature of a
    // few; 0.1 % of the luminaire's own quadrature (forward/direct/direct_light.h).
    EXPECT_NEAR(received_lm[static_cast<Eigen::Index>(k)], 1, 0.002) << luminaires[k].id;
  }
}

class HundredLumensLambertian : public testing::Test {
 protected:
  // As printed in textbooks; exactly 100 / pi.
  static constexpr double kLx = 31.83, kPrinted = 0.005;
  const Eigen::Vector3d below_{0, 0, -1}, up_{0, 0, 1};
};

TEST_F(HundredLumensLambertian, DirectLight) {
  EXPECT_NEAR(100 * DirectIlluminancePerLumen({}, below_, up_).lx_per_lm, kLx, kPrinted);
}

TEST_F(HundredLumensLambertian, ASensor) {
  EXPECT_NEAR(100 * SensorIlluminancePerLumen({}, {below_, up_, {}}).lx_per_lm, kLx, kPrinted);
}

TEST_F(HundredLumensLambertian, ARoomWithoutSurfaces) {
  const Room room = MakeRoom({});
  const Receivers receivers = MakeReceivers(room, {}, {{below_, up_, {}}});
  const std::vector<Luminaire> luminaires(1);
  const Illuminance light = ComputeIlluminance(
      room, receivers, ComputeVisibility(room, receivers, luminaires), luminaires, Eigen::VectorXd(0));
  EXPECT_NEAR(100 * light.total(0, 0), kLx, kPrinted);
}

// Through a photometric file: made, written, read.
TEST_F(HundredLumensLambertian, AnIesFile) {
  PhotometryFile lambertian;
  std::vector<double> gamma_rad, cosines;
  for (int deg = 0; deg <= 180; ++deg) {
    gamma_rad.push_back(deg * kPi / 180);
    cosines.push_back(std::max(0.0, std::cos(deg * kPi / 180)));
  }
  lambertian.table = Normalized(ExpandPlanes({0}, gamma_rad, cosines, PlaneSymmetry::kRotational));
  lambertian.luminaire_flux_lm = 100;
  const PhotometryFile read = PhotometryOf(ParseIes(IesText(MakeIes(lambertian)), "lambertian.ies"));
  Luminaire luminaire;
  luminaire.distribution = Distribution::kMeasured;
  luminaire.table = std::make_shared<IntensityTable>(read.table);
  // The interpolant between degrees lies below the cosine by (1 deg)^2 / 12 at most: 2.5e-5, normalised away.
  EXPECT_NEAR(read.luminaire_flux_lm, 100, 0.01);
  EXPECT_NEAR(read.luminaire_flux_lm * DirectIlluminancePerLumen(luminaire, below_, up_).lx_per_lm, kLx,
              kPrinted);
}

}  // namespace
}  // namespace luxfit
