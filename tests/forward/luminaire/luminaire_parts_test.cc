#include "forward/luminaire/luminaire_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "forward/direct/direct_light.h"
#include "tests/support/closed_forms.h"

namespace luxfit {
namespace {

using support::kPi;

std::vector<double> Nodes(double step_deg) {
  std::vector<double> gamma_rad;
  for (int j = 0; j * step_deg <= 90; ++j) gamma_rad.push_back(j * step_deg * kPi / 180);
  return gamma_rad;
}

Luminaire BatwingPoint() {
  Luminaire lamp;
  lamp.position = {0.2, -0.1, 2};
  lamp.distribution = Distribution::kMeasured;
  const std::vector<double> gamma_rad = Nodes(7.5);
  std::vector<double> intensity;
  for (const double g : gamma_rad) intensity.push_back(0.2 + std::pow(std::sin(2 * g), 2));
  lamp.table = std::make_shared<IntensityTable>(RotationalTable(gamma_rad, intensity));
  return lamp;
}

Luminaire UnevenPanel() {
  Luminaire lamp;
  lamp.position = {0.2, -0.1, 1};
  lamp.heading = Eigen::Vector3d(1, 0.5, 0).normalized();
  lamp.aim = Eigen::Vector3d(0.1, 0.05, -1).normalized();
  lamp.shape = LuminaireShape::kRectangle;
  lamp.size_m = {0.9, 0.4};
  lamp.emission.resize(3, 2);
  lamp.emission << 0.3, 0.05, 0.1, 0.2, 0.25, 0.1;
  return lamp;
}

const Eigen::Vector3d kPlace(0.7, 0.4, 0), kUp(0, 0, 1);

double LxAt(const Luminaire& lamp) { return DirectIlluminancePerLumen(lamp, kPlace, kUp).lx_per_lm; }

TEST(LuminaireParts, SharesOfNodesAddUpToOne) {
  // Of a table of 1 lm, by its own integral.
  EXPECT_NEAR(PartShares(BatwingPoint(), PartKind::kGammaNode).sum(), 1, 1e-12);
}

TEST(LuminaireParts, NodeFluxOfAnIsotropicTableIsTheWholeHemisphere) {
  EXPECT_NEAR(NodeFlux(Nodes(7.5)).sum(), 2 * kPi, 1e-12);
}

TEST(LuminaireParts, LightIsTheSumOverPartsByShare) {
  for (const auto& [lamp, kind] :
       {std::pair{BatwingPoint(), PartKind::kGammaNode}, std::pair{UnevenPanel(), PartKind::kCell}}) {
    const Eigen::VectorXd shares = PartShares(lamp, kind);
    double sum = 0;
    for (int j = 0; j < static_cast<int>(shares.size()); ++j) sum += shares[j] * LxAt(PartOf(lamp, kind, j));
    EXPECT_NEAR(sum, LxAt(lamp), 1e-12 * std::abs(sum) + 1e-15);
  }
}

Luminaire TwoSidedDisc(double share_up) {
  Luminaire lamp;
  lamp.position = {0.2, -0.1, 2};
  lamp.shape = LuminaireShape::kDisc;
  lamp.size_m = {0.4, 0.4};
  lamp.distribution = Distribution::kMeasured;
  lamp.table = std::make_shared<IntensityTable>(TwoSidedTable(share_up));
  return lamp;
}

// Chords of 2.5 degrees lie within (2.5 degrees)^2 / 8 = 2.4e-4 of the cosine.
TEST(LuminaireParts, ATwoSidedTableIsLambertianOnEitherSide) {
  const Luminaire lamp = TwoSidedDisc(0.4);
  const LuminaireAxes axes = AxesOf(lamp);
  for (const double gamma_deg : {0.0, 20.0, 41.0, 77.0, 103.0, 139.0, 180.0}) {
    const double cosine = std::cos(gamma_deg * kPi / 180);
    const Eigen::Vector3d direction = cosine * lamp.aim + std::sqrt(1 - cosine * cosine) * axes.along;
    const double expected = std::max(0.6 * cosine, -0.4 * cosine) / kPi;
    EXPECT_NEAR(IntensityPerLumen(lamp, axes, direction).cd_per_lm, expected, 2.4e-4 * 0.6 / kPi)
        << gamma_deg;
  }
  const Eigen::VectorXd shares = PartShares(lamp, PartKind::kSide);
  ASSERT_EQ(shares.size(), 2);
  EXPECT_NEAR(shares[1], 0.4, 1e-12);
  EXPECT_THROW(TwoSidedTable(1.1), std::invalid_argument);
}

TEST(LuminaireParts, LightOfASideIsThatOfALambertianDiscAlone) {
  Luminaire down;
  down.position = {0.2, -0.1, 2};
  down.shape = LuminaireShape::kDisc;
  down.size_m = {0.4, 0.4};
  const Luminaire both = TwoSidedDisc(0.4);
  EXPECT_NEAR(LxAt(PartOf(both, PartKind::kSide, 0)), LxAt(down), 2.4e-4 * LxAt(down));
  EXPECT_NEAR(LxAt(both), 0.6 * LxAt(down), 2.4e-4 * LxAt(down));
  EXPECT_EQ(LxAt(PartOf(both, PartKind::kSide, 1)), 0);
  const Luminaire other = WithPartShares(both, PartKind::kSide, Eigen::Vector2d(1, 3));
  EXPECT_NEAR(LxAt(other), 0.25 * LxAt(down), 2.4e-4 * LxAt(down));
}

TEST(LuminaireParts, OtherSharesAreScaledToOne) {
  const Luminaire lamp = BatwingPoint();
  const Eigen::VectorXd shares = PartShares(lamp, PartKind::kGammaNode);
  const Luminaire same = WithPartShares(lamp, PartKind::kGammaNode, 7 * shares);
  for (size_t j = 0; j < lamp.table->cd_per_lm.size(); ++j)
    EXPECT_NEAR(same.table->cd_per_lm[j], lamp.table->cd_per_lm[j], 1e-12);
}

// Each cell a Lambertian rectangle of its own, in closed form (Howell B-3).
TEST(LuminaireParts, UnevenPanelIsTheSumOfItsCellsClosedForms) {
  Luminaire lamp = UnevenPanel();
  lamp.aim = {0, 0, -1};
  lamp.heading = {1, 0, 0};
  const LuminaireAxes axes = AxesOf(lamp);
  double expected = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 2; ++j) {
      const Eigen::Vector3d centre =
          lamp.position + 0.3 * (i - 1) * axes.along + 0.2 * (j - 0.5) * axes.across;
      expected += support::LambertianRectangleLx(lamp.emission(i, j), centre, 0.3, 0.2, kPlace);
    }
  }
  EXPECT_NEAR(LxAt(lamp), expected,
              3e-5 * expected);  // what direct_light.h promises of a rectangle some sides away
}

TEST(LuminaireParts, DerivativesOfAnUnevenPanelAreCentralDifferences) {
  const Luminaire lamp = UnevenPanel();
  const DirectIlluminance at = DirectIlluminancePerLumen(lamp, kPlace, kUp);
  constexpr double kStep = 1e-5;  // truncation 1e-10 of the value, rounding 1e-11
  const auto difference = [&](const auto& moved) {
    return (LxAt(moved(kStep)) - LxAt(moved(-kStep))) / (2 * kStep);
  };
  for (int axis = 0; axis < 3; ++axis) {
    const double numeric = difference([&](double step) {
      Luminaire m = lamp;
      m.position[axis] += step;
      return m;
    });
    EXPECT_NEAR(at.d_position[axis], numeric, 1e-6 * at.lx_per_lm);
  }
  const LuminaireAxes axes = AxesOf(lamp);
  for (int side = 0; side < 2; ++side) {
    const double size = difference([&](double step) {
      Luminaire m = lamp;
      m.size_m[side] += step;
      return m;
    });
    EXPECT_NEAR(at.d_size[side], size, 1e-6 * at.lx_per_lm);
    const double tilt = difference([&](double step) {
      Luminaire m = lamp;
      m.aim = (lamp.aim + step * (side == 0 ? axes.along : axes.across)).normalized();
      m.heading = axes.along;
      return m;
    });
    EXPECT_NEAR(at.d_tilt[side], tilt, 1e-6 * at.lx_per_lm);
  }
  const double heading = difference([&](double step) {
    Luminaire m = lamp;
    m.heading = std::cos(step) * axes.along + std::sin(step) * axes.across;
    return m;
  });
  EXPECT_NEAR(at.d_heading, heading, 1e-6 * at.lx_per_lm);
}

TEST(LuminaireParts, PartsThatAreNotThereAreRefused) {
  Luminaire plain;
  EXPECT_EQ(PartShares(plain, PartKind::kGammaNode).size(), 0);
  EXPECT_EQ(PartShares(plain, PartKind::kCell).size(), 0);
  EXPECT_THROW(PartOf(plain, PartKind::kCell, 0), std::invalid_argument);
  EXPECT_EQ(PartShares(BatwingPoint(), PartKind::kSide).size(), 0);  // dark above
  EXPECT_THROW(NodesOfSides(BatwingPoint()), std::invalid_argument);
  EXPECT_THROW(PartOf(BatwingPoint(), PartKind::kGammaNode, 13), std::invalid_argument);
  EXPECT_THROW(WithPartShares(BatwingPoint(), PartKind::kGammaNode, Eigen::VectorXd::Zero(13)),
               std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
