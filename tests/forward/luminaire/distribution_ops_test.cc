#include "forward/luminaire/distribution_ops.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>

#include "forward/luminaire/photometry.h"
#include "tests/support/closed_forms.h"

namespace luxfit {
namespace {

using support::kPi;

// Twice as bright along C0 as along C180, and some light above the horizontal.
std::shared_ptr<const IntensityTable> LopsidedGrid() {
  std::vector<double> c_rad, gamma_rad, intensity;
  for (int i = 0; i < 24; ++i) c_rad.push_back(2 * kPi * i / 24);
  for (int j = 0; j <= 24; ++j) gamma_rad.push_back(kPi * j / 24);
  for (const double c : c_rad) {
    for (const double gamma : gamma_rad)
      intensity.push_back(1.2 + std::cos(gamma) + std::sin(gamma) * std::cos(c) / 3);
  }
  return std::make_shared<IntensityTable>(
      Normalized(ExpandPlanes(c_rad, gamma_rad, intensity, PlaneSymmetry::kNone)));
}

// Has what any distribution may need, turned so that no axis of the world is one of its own.
Luminaire LuminaireOf(const DistributionOps& ops) {
  Luminaire luminaire;
  luminaire.distribution = ops.distribution;
  luminaire.cosine_exponent = 2.5;
  luminaire.table = LopsidedGrid();
  luminaire.aim = Eigen::Vector3d(0.3, -0.2, -1).normalized();
  luminaire.heading = Eigen::Vector3d(1, 1, 0).normalized();
  return luminaire;
}

Eigen::Vector3d DirectionAt(const Luminaire& luminaire, const LuminaireAxes& axes, double cosine_gamma,
                            double c_rad) {
  return cosine_gamma * luminaire.aim + std::sqrt(1 - cosine_gamma * cosine_gamma) *
                                            (std::cos(c_rad) * axes.along - std::sin(c_rad) * axes.across);
}

TEST(Distributions, EveryValueHasItsRow) {
  std::set<std::string> names, photometries;
  for (size_t i = 0; i < Distributions().size(); ++i) {
    const DistributionOps& ops = Distributions()[i];
    EXPECT_EQ(static_cast<size_t>(ops.distribution), i);
    EXPECT_EQ(OpsOf(ops.distribution).distribution, ops.distribution);
    EXPECT_EQ(ToString(ops.distribution), ops.name);
    EXPECT_TRUE(names.insert(ops.name).second) << ops.name;
    EXPECT_TRUE(photometries.insert(ops.photometry).second) << ops.photometry;
    EXPECT_TRUE(ops.towards && ops.is_symmetric_about_aim && ops.shines_to_one_side && ops.sharpness &&
                ops.missing)
        << ops.name;
  }
}

TEST(FindDistribution, FindsTheNamesOfSessionsAndNoOthers) {
  for (const DistributionOps& ops : Distributions()) EXPECT_EQ(FindDistribution(ops.photometry), &ops);
  for (const char* unknown : {"", "auto", "measured", "Lambertian", "lambertian ", "downlight.ies"})
    EXPECT_EQ(FindDistribution(unknown), nullptr) << unknown;
}

// They stand in session files, in results and in messages about both.
TEST(PhotometryNames, AreThoseOfTheFileFormats) {
  EXPECT_EQ(PhotometryNames(),
            (std::vector<std::string>{"isotropic", "lambertian", "cosine_power", "table"}));
  EXPECT_EQ(PhotometryNames([](const DistributionOps& ops) { return ops.has_exponent; }),
            std::vector<std::string>{"cosine_power"});
}

TEST(Distributions, GiveOneLumenToTheSphere) {
  for (const DistributionOps& ops : Distributions()) {
    const Luminaire luminaire = LuminaireOf(ops);
    const LuminaireAxes axes = AxesOf(luminaire);
    // Midpoint rule in gamma, whose cells end at the table's angles, and C.
    constexpr int kGammas = 480, kPlanes = 480;
    double flux_lm = 0;
    for (int i = 0; i < kGammas; ++i) {
      const double gamma = (i + 0.5) * kPi / kGammas;
      for (int j = 0; j < kPlanes; ++j) {
        const double c = (j + 0.5) * 2 * kPi / kPlanes;
        flux_lm += std::sin(gamma) *
                   ops.towards(luminaire, axes, DirectionAt(luminaire, axes, std::cos(gamma), c)).cd_per_lm;
      }
    }
    flux_lm *= (kPi / kGammas) * (2 * kPi / kPlanes);
    // The rule errs by less than (pi / 480)^2 = 4e-5 of integrands as smooth as these.
    EXPECT_NEAR(flux_lm, 1, 4e-5) << ops.name;
  }
}

TEST(Distributions, DerivativesAreThoseOfTheIntensity) {
  constexpr double kStep = 1e-6;  // truncation 1e-11 of the value, rounding 1e-10
  for (const DistributionOps& ops : Distributions()) {
    const Luminaire luminaire = LuminaireOf(ops);
    const LuminaireAxes axes = AxesOf(luminaire);
    const auto intensity = [&](const Eigen::Vector3d& direction) {
      return ops.towards(luminaire, axes, direction).cd_per_lm;
    };
    for (const double cosine : {-0.62, 0.07, 0.41, 0.93}) {
      for (const double c : {0.1, 1.9, 4.4}) {  // between the table's angles, where it has kinks
        const Eigen::Vector3d direction = DirectionAt(luminaire, axes, cosine, c);
        const DirectedIntensity at = ops.towards(luminaire, axes, direction);
        const Eigen::Vector3d across = direction.unitOrthogonal();
        for (const Eigen::Vector3d& turn : {across, Eigen::Vector3d(direction.cross(across))}) {
          const double up = intensity((direction + kStep * turn).normalized()),
                       down = intensity((direction - kStep * turn).normalized());
          EXPECT_NEAR(at.d_direction.dot(turn), (up - down) / (2 * kStep), 1e-8) << ops.name << cosine << c;
        }
        Luminaire wider = luminaire, narrower = luminaire;
        wider.cosine_exponent -= kStep, narrower.cosine_exponent += kStep;
        const double difference =
            ops.towards(narrower, axes, direction).cd_per_lm - ops.towards(wider, axes, direction).cd_per_lm;
        EXPECT_NEAR(at.d_exponent, difference / (2 * kStep), 1e-8) << ops.name;
        if (!ops.has_exponent) {
          EXPECT_EQ(difference, 0) << ops.name;
        }
      }
    }
  }
}

// Callers read these members of a row without calling its functions.
TEST(Distributions, AreWhatTheirRowsSay) {
  for (const DistributionOps& ops : Distributions()) {
    const Luminaire luminaire = LuminaireOf(ops);
    const LuminaireAxes axes = AxesOf(luminaire);
    const auto intensity = [&](double cosine, double c) {
      return ops.towards(luminaire, axes, DirectionAt(luminaire, axes, cosine, c)).cd_per_lm;
    };
    bool is_even = true, is_round = true, is_dark_behind = true;
    for (const double cosine : {-0.9, -0.3, 0.2, 0.6, 0.95}) {
      for (const double c : {0.3, 2.0, 4.0}) {
        const double cd_per_lm = intensity(cosine, c);
        is_even = is_even && std::abs(cd_per_lm - 1 / (4 * kPi)) < 1e-12;
        is_round = is_round && std::abs(cd_per_lm - intensity(cosine, 1)) < 1e-12;
        is_dark_behind = is_dark_behind && (cosine > 0 || cd_per_lm == 0);
        if (ops.is_diffuse) {
          EXPECT_NEAR(cd_per_lm, std::max(cosine, 0.0) / kPi, 1e-12) << ops.name;
        }
        if (ops.about_aim) {
          EXPECT_NEAR(ops.about_aim(luminaire, cosine).cd_per_lm, cd_per_lm, 1e-12) << ops.name;
        }
      }
    }
    EXPECT_EQ(ops.has_aim, !is_even) << ops.name;
    EXPECT_EQ(ops.is_symmetric_about_aim(luminaire), is_round) << ops.name;
    EXPECT_EQ(ops.about_aim != nullptr, is_round) << ops.name;
    EXPECT_EQ(ops.shines_to_one_side(luminaire), is_dark_behind) << ops.name;
    if (!ops.has_table) {
      EXPECT_EQ(ops.last_gamma_deg, is_dark_behind ? 90 : 180) << ops.name;
    }
  }
}

// A cosine power is as narrow as itself; none is taken for wider than a Lambertian one.
TEST(Distributions, SharpnessIsTheExponentOfAsHighAPeak) {
  for (const DistributionOps& ops : Distributions()) {
    const Luminaire luminaire = LuminaireOf(ops);
    double peak_cd_per_lm = 0;
    for (int i = 0; i <= 1000; ++i) {
      const Eigen::Vector3d direction = DirectionAt(luminaire, AxesOf(luminaire), -1 + i / 500.0, 0);
      peak_cd_per_lm =
          std::max(peak_cd_per_lm, ops.towards(luminaire, AxesOf(luminaire), direction).cd_per_lm);
    }
    const double exponent = std::max(2 * kPi * peak_cd_per_lm - 1, 1.0);
    EXPECT_NEAR(ops.sharpness(luminaire), exponent, 1e-9) << ops.name;
  }
}

TEST(Distributions, SayWhatIsMissing) {
  for (const DistributionOps& ops : Distributions()) {
    Luminaire luminaire = LuminaireOf(ops);
    EXPECT_EQ(ops.missing(luminaire), nullptr) << ops.name;
    luminaire.table = nullptr;
    EXPECT_EQ(ops.missing(luminaire) != nullptr, ops.has_table) << ops.name;
    luminaire = LuminaireOf(ops);
    for (const double wrong :
         {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
      luminaire.cosine_exponent = wrong;
      EXPECT_EQ(ops.missing(luminaire) != nullptr, ops.has_exponent) << ops.name << " " << wrong;
    }
  }
}

}  // namespace
}  // namespace luxfit
