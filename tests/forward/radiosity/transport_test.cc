#include "forward/radiosity/transport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "forward/direct/direct_light.h"
#include "forward/light/room.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

// A closed cube of 2 m, an isotropic luminaire of 1 lm in its middle.
class Furnace : public testing::Test {
 protected:
  Furnace()
      : room_(MakeRoom(support::ClosedRoom({2, 2, 2}, {"wall", "wall", "wall", "wall", "floor", "wall"}))) {
    Luminaire lamp;
    lamp.position = Eigen::Vector3d(1, 1, 1);
    lamp.distribution = Distribution::kIsotropic;
    Eigen::MatrixXf at_elements(static_cast<Eigen::Index>(room_.patches.elements.size()), 1);
    for (size_t e = 0; e < room_.patches.elements.size(); ++e) {
      const Element& element = room_.patches.elements[e];
      at_elements(static_cast<Eigen::Index>(e), 0) =
          static_cast<float>(DirectIlluminancePerLumen(lamp, element.center, element.normal).lx_per_lm);
    }
    direct_ = PatchMean(room_.patches, at_elements);
  }

  const Eigen::VectorXf& areas() const { return room_.transport.patch_area_m2; }
  double FluxOf(const Eigen::VectorXf& illuminance_lx) const {
    return areas().cast<double>().dot(illuminance_lx.cast<double>());
  }

  Room room_;
  Eigen::MatrixXf direct_;
};

TEST_F(Furnace, TheDirectLightIsAllOfIt) {
  // Midpoint rule on elements of h = 0.1 m at d = 1 m: error about (h / d)^2 / 24 times a curvature of a few.
  EXPECT_NEAR(FluxOf(direct_), 1, 0.003);
}

// Summed over the room, A E = Phi + rho sum_j A_j s_j E_j, where A_j s_j = sum_i A_i F_ij is A_j for exact
// form factors. So E_indirect has the mean rho Phi / (A (1 - rho)). The sampled s_j differ from 1 but their
// mean does not (rows add up to 1), so by Cauchy-Schwarz the error of (1 - rho) A E is at most rho |s - 1| |E
// - mean E| in the area-weighted norm.
TEST_F(Furnace, InterreflectionIsThatOfTheIntegratingSphere) {
  const double area = areas().sum();
  const Eigen::VectorXf root = areas().cwiseSqrt();
  const Eigen::VectorXf excess =
      (room_.transport.coupling.transpose() * root).cwiseQuotient(root).array() - 1;
  for (const double rho : {0.0, 0.2, 0.5, 0.8, 0.95}) {
    const Transport transport(room_.transport, Eigen::Vector2d::Constant(rho));
    const Eigen::VectorXf indirect = transport.Irradiance(transport.Exitance(direct_));
    const Eigen::VectorXf total = direct_ + indirect;
    const double mean_lx = FluxOf(total) / area;
    const Eigen::VectorXf uneven = total.array() - static_cast<float>(mean_lx);
    const double norms = std::sqrt(FluxOf(excess.cwiseAbs2()) * FluxOf(uneven.cwiseAbs2()));
    const double float_rounding = 1e-5 * mean_lx * area;
    const double tolerance = rho / (1 - rho) * (norms + float_rounding) / area;
    const double expected = rho * FluxOf(direct_) / (area * (1 - rho));
    EXPECT_NEAR(FluxOf(indirect) / area, expected, tolerance) << "rho " << rho;
    EXPECT_LE(tolerance, 0.01 * expected) << "the form factors are too noisy for the test to tell";
  }
}

TEST_F(Furnace, ExitanceSolvesTheRadiosityEquation) {
  const Eigen::Vector2d albedo(0.7, 0.2);
  const Transport transport(room_.transport, albedo);
  const Eigen::VectorXf exitance = transport.Exitance(direct_);
  const Eigen::VectorXf illuminance = direct_ + transport.Irradiance(exitance);
  for (Eigen::Index i = 0; i < exitance.size(); ++i) {
    const double rho = albedo[room_.transport.patch_material[static_cast<size_t>(i)]];
    EXPECT_NEAR(exitance[i], rho * illuminance[i], 1e-5 * exitance.maxCoeff());  // float rounding
  }
}

TEST_F(Furnace, CouplingIsSymmetric) {
  EXPECT_EQ(room_.transport.coupling, room_.transport.coupling.transpose().eval());
}

// With all patches like their material, and with patches that depart from it.
TEST_F(Furnace, ExitanceDerivativesAreCentralDifferences) {
  const Eigen::Vector2d albedo(0.6, 0.3);
  // Truncation (h / (1 - rho))^2 = 6e-4 of the derivative; float rounding 1e-6 / h = 1e-4.
  constexpr double kStep = 0.01, kTolerance = 1e-3;
  Eigen::VectorXd uneven = Eigen::VectorXd::Ones(areas().size());
  for (Eigen::Index i = 0; i < uneven.size(); ++i) uneven[i] = i % 3 == 0 ? 0.5 : i % 3 == 1 ? 1 : 1.2;
  for (const Eigen::VectorXd& factor : {Eigen::VectorXd(), uneven}) {
    const Transport transport(room_.transport, albedo, factor);
    const Eigen::MatrixXf illuminance = direct_ + transport.Irradiance(transport.Exitance(direct_));
    for (int m = 0; m < 2; ++m) {
      const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(m);
      const Eigen::VectorXf numeric = (Transport(room_.transport, albedo + step, factor).Exitance(direct_) -
                                       Transport(room_.transport, albedo - step, factor).Exitance(direct_)) /
                                      static_cast<float>(2 * kStep);
      const Eigen::VectorXf analytic = transport.ExitanceDerivatives({0, 1}, illuminance).col(m);
      EXPECT_LT((analytic - numeric).cwiseAbs().maxCoeff(), kTolerance * numeric.maxCoeff())
          << "material " << m << ", " << factor.size() << " factors";
    }
  }
}

TEST_F(Furnace, ReflectancesOutsideTheUnitIntervalAreRefused) {
  for (const double rho : {-0.01, 1.0, 1.5, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(Transport(room_.transport, Eigen::Vector2d(0.5, rho)), std::invalid_argument) << rho;
    EXPECT_THROW(Transport(room_.transport, Eigen::Vector2d(rho, 0.5)), std::invalid_argument) << rho;
  }
  EXPECT_NO_THROW(Transport(room_.transport, Eigen::Vector2d(0, 0.99)));
}

// Every third patch is a material of its own there, and departs from its material by the same factor here.
TEST_F(Furnace, AFactorMakesAPatchAMaterialOfItsOwn) {
  constexpr double kFactor = 0.3;
  const Eigen::Vector2d albedo(0.7, 0.4);
  TransportGeometry geometry = room_.transport;
  Eigen::VectorXd factor = Eigen::VectorXd::Ones(areas().size());
  for (Eigen::Index i = 0; i < factor.size(); i += 3) {
    factor[i] = kFactor;
    geometry.patch_material[static_cast<size_t>(i)] += 2;
  }
  Eigen::Vector4d all_albedo;
  all_albedo << albedo, kFactor * albedo;
  const Transport by_material(geometry, all_albedo), by_factor(room_.transport, albedo, factor);
  const Eigen::VectorXf expected = by_material.Exitance(direct_), found = by_factor.Exitance(direct_);
  EXPECT_LT((found - expected).cwiseQuotient(expected).cwiseAbs().maxCoeff(), 1e-5);  // float rounding
  const Eigen::VectorXf plain = Transport(room_.transport, albedo).Exitance(direct_);
  EXPECT_GT((found - plain).cwiseQuotient(plain).cwiseAbs().maxCoeff(), 0.5);  // the factors matter
}

TEST_F(Furnace, APatchReflectsLessThanAllOfItsLight) {
  const Eigen::Index n = areas().size();
  const Transport at_most(room_.transport, Eigen::Vector2d::Constant(Transport::kMostReflectance)),
      beyond(room_.transport, Eigen::Vector2d::Constant(0.7), Eigen::VectorXd::Constant(n, 2));
  EXPECT_EQ(beyond.Exitance(direct_), at_most.Exitance(direct_));
}

TEST_F(Furnace, FactorsBelowZeroOrOfAnotherNumberAreRefused) {
  const Eigen::Index n = areas().size();
  const Eigen::Vector2d albedo(0.6, 0.3);
  EXPECT_THROW(Transport(room_.transport, albedo, Eigen::VectorXd::Ones(n - 1)), std::invalid_argument);
  EXPECT_THROW(Transport(room_.transport, albedo, Eigen::VectorXd::Ones(n + 1)), std::invalid_argument);
  for (const double wrong : {-0.01, std::numeric_limits<double>::quiet_NaN()}) {
    Eigen::VectorXd factor = Eigen::VectorXd::Ones(n);
    factor[n / 2] = wrong;
    EXPECT_THROW(Transport(room_.transport, albedo, factor), std::invalid_argument) << wrong;
  }
  EXPECT_NO_THROW(Transport(room_.transport, albedo, Eigen::VectorXd::Zero(n)));
}

TEST_F(Furnace, PatchMeanIsWeightedByArea) {
  const Eigen::Index n = static_cast<Eigen::Index>(room_.patches.elements.size());
  Eigen::MatrixXf x(n, 1), area(n, 1);
  for (Eigen::Index e = 0; e < n; ++e) {
    x(e, 0) = static_cast<float>(room_.patches.elements[static_cast<size_t>(e)].center.x());
  }
  const Eigen::MatrixXf mean = PatchMean(room_.patches, x);
  for (size_t p = 0; p < room_.patches.patches.size(); ++p) {
    EXPECT_NEAR(mean(static_cast<Eigen::Index>(p), 0), room_.patches.patches[p].center.x(),
                1e-5);  // float rounding
  }
}

}  // namespace
}  // namespace luxfit
