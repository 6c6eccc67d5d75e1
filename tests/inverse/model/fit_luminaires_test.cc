#include "inverse/model/fit_luminaires.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/support/closed_forms.h"
#include "tests/support/inverse/cube_photos.h"
#include "tests/support/inverse/plane_readings.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

// A cos^3 point over two planes of sensors, in no room.
class OnePoint : public testing::Test {
 protected:
  static constexpr double kExponent = 3, kFluxLm = 800, kNoise = 0.01;
  const Eigen::Vector3d lamp_{0.33, -0.41, 1.27};

  LightData Read(double relative_noise) {
    const auto lux = [&](const Eigen::Vector3d& p) {
      const auto cd_per_lm = [](double c) {
        return (kExponent + 1) * std::pow(c, kExponent) / (2 * support::kPi);
      };
      return support::PointLx(kFluxLm, cd_per_lm, lamp_, p);
    };
    LightData data;
    data.dimming = {Eigen::VectorXd::Ones(1)};
    for (const double height : {0.0, 0.4}) {
      const std::vector<Reading> plane =
          support::ReadAt(support::PlanePoints(8, 2, height), lux, relative_noise, rng_);
      data.readings.insert(data.readings.end(), plane.begin(), plane.end());
    }
    return data;
  }

  // Some way off, as a first guess is.
  LightState Start() const {
    return support::CosinePowerStart(lamp_ + Eigen::Vector3d(0.2, 0.15, -0.2), 1.5);
  }

  // Position, log exponent, log flux: the order of FreeParameters.
  Eigen::VectorXd Truth() const {
    Eigen::VectorXd x(5);
    x << lamp_, std::log(kExponent), std::log(kFluxLm);
    return x;
  }

  // Expects errors within 4 sigma, and sigmas as they follow from 128 readings of 1 %: the normal equations give 3.6 mm
  // of place (3.5 mm of height), 0.0076 of the log exponent and 0.0013 of the log flux. The limits are 1.5 times that:
  // robust weights and the model error of 0.2 % take a part of it.
  void ExpectTheTruthWithinItsSigma(const LuminaireFit& fit) const {
    const Eigen::VectorXd error = PackParameters(fit.state, fit.parameters) - Truth(),
                          sigma = fit.covariance.diagonal().cwiseSqrt();
    for (Eigen::Index i = 0; i < error.size(); ++i)
      EXPECT_LT(std::abs(error[i]), 4 * sigma[i]) << NameOf(fit.parameters[static_cast<size_t>(i)].id());
    std::printf("sigma of the place %.2f mm, of the log exponent %.4f, of the log flux %.5f\n",
                1000 * sigma.head<3>().norm(), sigma[3], sigma[4]);
    EXPECT_LT(sigma.head<3>().norm(), 0.0055);
    EXPECT_LT(sigma[3], 0.0115);
    EXPECT_LT(sigma[4], 0.0019);
  }

  Room room_ = MakeRoom(Scene{});
  std::mt19937_64 rng_ = support::TestRng();
};

TEST_F(OnePoint, ExactReadingsGiveTheTruth) {
  const LuminaireFit fit = FitLuminaires(room_, Read(0), Start());
  ASSERT_EQ(fit.status, FitStatus::kConverged) << fit.message;
  // Inner solves end at relative changes of 1e-6 of the cost and 1e-7 of the parameters; the model is
  // computed in floats.
  EXPECT_LT((PackParameters(fit.state, fit.parameters) - Truth()).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_TRUE(fit.undetermined.empty());
  EXPECT_TRUE(fit.at_bound.empty());
}

// Steps from a start that is said to be near have no damping. Where it is not near, many would end far away with
// a flux without bound.
TEST_F(OnePoint, AFarStartThatIsSaidToBeNearDoesNotLeadAstray) {
  const LightData data = Read(kNoise);
  const Eigen::Vector3d position = FitLuminaires(room_, data, Start()).state.luminaires.front().position;
  std::uniform_real_distribution<double> level(-1.5, 1.5), height(-0.6, 1.2);
  int found = 0, found_from_near = 0;
  for (int k = 0; k < 40; ++k) {
    const Eigen::Vector3d off(level(rng_), level(rng_), height(rng_));
    const LightState start = support::CosinePowerStart(lamp_ + off, 1.5);
    FitLuminairesOptions options;
    const auto finds = [&] {
      const LuminaireFit fit = FitLuminaires(room_, data, start, {}, options);
      return (fit.state.luminaires.front().position - position).norm() < 1e-3;
    };
    found += finds() ? 1 : 0;
    options.start_is_near = true;
    found_from_near += finds() ? 1 : 0;
  }
  std::printf("of 40 starts %d reach the truth, %d where they are said to be near\n", found, found_from_near);
  EXPECT_GE(found_from_near, found);
}

TEST_F(OnePoint, NoisyReadingsGiveTheTruthWithinItsSigma) {
  const LuminaireFit fit = FitLuminaires(room_, Read(kNoise), Start());
  ASSERT_EQ(fit.status, FitStatus::kConverged) << fit.message;
  ExpectTheTruthWithinItsSigma(fit);
}

// Normalised error e^T C^-1 e of 5 parameters over 400 refits: chi-square of 2000 degrees of freedom if C is
// right. Three sigmas of its mean are 3 sqrt(2 / 2000) = 0.095. C may be cautious besides by what the fit
// adds on purpose: the least model error, 0.2 % beside 1 % of noise (4 %); more of it where the readings
// happen to scatter more, which they do with a sigma of 7 %, the fit taking the upper half of that (6 %);
// robust weights, mean 0.91 for Gaussian data (9 %).
TEST_F(OnePoint, CovarianceIsThatOfRefits) {
  constexpr int kRefits = 400;
  double sum = 0;
  for (int i = 0; i < kRefits; ++i) {
    const LuminaireFit fit = FitLuminaires(room_, Read(kNoise), Start());
    ASSERT_TRUE(fit.IsUsable()) << fit.message;
    const Eigen::VectorXd error = PackParameters(fit.state, fit.parameters) - Truth();
    sum += error.dot(fit.covariance.llt().solve(error));
  }
  const double mean = sum / (5 * kRefits), three_sigmas = 3 * std::sqrt(2. / (5 * kRefits));
  std::printf("mean normalised squared error %.3f, expected 1 within %.3f\n", mean, three_sigmas);
  EXPECT_LT(mean, 1 + three_sigmas);
  EXPECT_GT(mean, (1 - three_sigmas) / (1.04 * 1.06 * 1.09));
}

TEST_F(OnePoint, TheSameInputGivesTheSameBits) {
  const LightData data = Read(kNoise);
  const LuminaireFit first = FitLuminaires(room_, data, Start()),
                     second = FitLuminaires(room_, data, Start());
  EXPECT_EQ(PackParameters(first.state, first.parameters), PackParameters(second.state, second.parameters));
  EXPECT_EQ(first.covariance, second.covariance);
  EXPECT_EQ(first.predicted, second.predicted);
}

TEST_F(OnePoint, WithoutDataThereIsNoFit) {
  LightData data = Read(kNoise);
  for (Reading& reading : data.readings) reading.used = false;
  for (const LightData& none : {data, LightData{}}) {
    const LuminaireFit fit = FitLuminaires(room_, none, Start());
    EXPECT_EQ(fit.status, FitStatus::kNoData);
    EXPECT_NE(fit.message, "");
    EXPECT_FALSE(fit.IsUsable());
    EXPECT_EQ(fit.covariance.size(), 0);
  }
}

TEST_F(OnePoint, AReadingThatOnlyChecksIsPredictedButNotFitted) {
  LightData data = Read(0);
  data.readings[10].illuminance_lx *= 3;
  data.readings[10].used = false;
  const LuminaireFit fit = FitLuminaires(room_, data, Start());
  ASSERT_EQ(fit.status, FitStatus::kConverged);
  EXPECT_LT((PackParameters(fit.state, fit.parameters) - Truth()).cwiseAbs().maxCoeff(), 1e-4);  // as above
  EXPECT_NEAR(fit.predicted[10] / (data.readings[10].illuminance_lx / 3), 1, 1e-3);
  EXPECT_EQ(fit.weight[10], 0);
}

TEST_F(OnePoint, AWildReadingAmongManyHardlyCounts) {
  LightData data = Read(kNoise);
  data.readings[10].illuminance_lx *= 3;
  const LuminaireFit fit = FitLuminaires(room_, data, Start());
  ASSERT_TRUE(fit.IsUsable()) << fit.message;
  EXPECT_LT(fit.weight[10], 0.01);  // 1 / (1 + (z / 3)^2), z about 200
  ExpectTheTruthWithinItsSigma(fit);
}

TEST_F(OnePoint, APriorHoldsWhatItKnows) {
  ParameterPrior prior;
  prior.quantity = LuminaireQuantity::kPositionZ;
  prior.mean = lamp_.z() + 0.05;
  prior.sigma = 1e-5;
  const LuminaireFit fit = FitLuminaires(room_, Read(kNoise), Start(), {prior});
  ASSERT_TRUE(fit.IsUsable());
  // The readings know the height to some millimetres, 1e-5 m holds against them by (1e-5 / 1e-3)^2 = 1e-4 of
  // 0.05 m.
  EXPECT_NEAR(fit.state.luminaires[0].position.z(), prior.mean, 1e-4);
  EXPECT_LT(std::sqrt(fit.covariance(2, 2)), 1.5e-5);
}

TEST_F(OnePoint, WhatIsAllGivenIsPredicted) {
  LightState given = Start();
  given.luminaires[0].position = lamp_;
  given.luminaires[0].cosine_exponent = kExponent;
  given.luminaires[0].flux_lm = kFluxLm;
  given.free[0] = {false, false, false, false, false};
  const LightData data = Read(0);
  const LuminaireFit fit = FitLuminaires(room_, data, given);
  EXPECT_EQ(fit.status, FitStatus::kConverged) << fit.message;
  EXPECT_TRUE(fit.parameters.empty());
  for (size_t i = 0; i < data.readings.size(); ++i) {
    EXPECT_NEAR(fit.predicted[static_cast<Eigen::Index>(i)] / data.readings[i].illuminance_lx, 1,
                1e-6);  // floats
  }
}

TEST_F(OnePoint, ALuminaireThatIsNeverOnIsUndetermined) {
  LightData data = Read(kNoise);
  data.dimming = {Eigen::Vector2d(1, 0)};
  LightState start = Start();
  start.luminaires.push_back(start.luminaires[0]);
  start.luminaires[1].id = "B";
  start.free.push_back({});
  const LuminaireFit fit = FitLuminaires(room_, data, start);
  EXPECT_EQ(fit.status, FitStatus::kUndetermined);
  EXPECT_NE(fit.message, "");
  EXPECT_FALSE(fit.IsUsable());
  std::vector<std::string> names = NamesOf(fit.undetermined);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"log flux of B", "position x of B", "position y of B",
                                             "position z of B"}));
  // A is as well known as without B.
  EXPECT_LT((fit.state.luminaires[0].position - lamp_).norm(), 0.02);
}

// Photos alone cannot tell a brighter lamp from a more sensitive camera.
class PhotosAlone : public testing::Test {
 protected:
  PhotosAlone() {
    data_.dimming = {Eigen::VectorXd::Ones(1)};
    data_.observations = support::CubePhotos(room_, lamp_, Eigen::Vector3d::Constant(kRho));
    start_.luminaires.resize(1);
    start_.luminaires[0].id = "A";
    start_.luminaires[0].position = Eigen::Vector3d(1, 1, 1);
    start_.luminaires[0].distribution = Distribution::kIsotropic;
    start_.free.resize(1);
    start_.albedo = Eigen::VectorXd::Constant(1, 0.5);
    start_.albedo_free = {true};
  }

  static bool Has(const std::vector<ParameterId>& ids, const ParameterId& id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
  }

  static constexpr double kRho = 0.6;
  const Eigen::Vector3d lamp_{1.1, 0.9, 1.2};
  Room room_ = support::CubeRoom();
  LightData data_;
  LightState start_;
};

TEST_F(PhotosAlone, FluxAndCameraScaleAreUndetermined) {
  const LuminaireFit fit = FitLuminaires(room_, data_, start_);
  EXPECT_EQ(fit.status, FitStatus::kUndetermined);
  EXPECT_FALSE(fit.IsUsable());
  EXPECT_TRUE(Has(fit.undetermined, {ParameterKind::kLogFlux, "A"}));
  EXPECT_TRUE(Has(fit.undetermined, {ParameterKind::kLogCameraScale, ""}));
  EXPECT_EQ(fit.undetermined.size(), 2u);
  ASSERT_EQ(fit.null_directions.size(), 1u);
  EXPECT_EQ(fit.null_directions[0].meaning,
            "the flux of A and the camera's scale are known only up to one common factor");
  // All else is determined. The even interreflection of these photos is a cube's only to about a tenth of the
  // light: that much the luminances may miss, and half of it, by E ~ 1 / r^2, the lamp at 1 m from the walls.
  EXPECT_LT((fit.state.luminaires[0].position - lamp_).norm(), 0.05);
  // Without a scale, the reflectance follows from the share of even light alone, and that light is a tenth off.
  EXPECT_NEAR(fit.state.albedo[0], kRho, 0.1);
  for (size_t i = 0; i < data_.observations.size(); ++i) {
    const double seen = data_.observations[i].relative_luminance;
    EXPECT_NEAR(fit.predicted[static_cast<Eigen::Index>(i)] / seen, 1, 0.1) << i;
  }
}

// The mean luminance of a closed room is rho / (1 - rho) of the flux per area and pi, even where its
// interreflection is not even. With flux and scale known, the mean determines the reflectance: 1 % of the mean moves
// it by (1 - rho) %. Elements that stand for their area by their centres are 0.4 % off in the direct light.
TEST_F(PhotosAlone, KnownFluxAndScaleGiveTheReflectance) {
  start_.free[0].flux = false;
  start_.luminaires[0].flux_lm = 1;
  start_.camera_scale_free = false;
  for (const double rho : {0.1, 0.3, kRho}) {
    data_.observations = support::CubePhotos(room_, lamp_, Eigen::Vector3d::Constant(rho));
    const LuminaireFit fit = FitLuminaires(room_, data_, start_);
    ASSERT_TRUE(fit.IsUsable()) << fit.message;
    EXPECT_EQ(fit.parameters.size(), 4u);
    EXPECT_NEAR(fit.state.albedo[0] / rho, 1, 5e-3) << rho;
  }
}

TEST_F(PhotosAlone, OneReadingSettlesTheScale) {
  // Of the floor's middle, by the same closed form, for 1 lm.
  const Eigen::Vector3d p(1.01, 1.02, 1e-3);
  const double lx = support::PointLx(1, support::IsotropicCdPerLm, lamp_, p) + support::CubeIndirectLx(kRho);
  data_.readings = {{{p, {0, 0, 1}}, 0, lx, 0.01 * lx, true}};
  const LuminaireFit fit = FitLuminaires(room_, data_, start_);
  EXPECT_TRUE(fit.IsUsable()) << fit.message;
  EXPECT_TRUE(fit.undetermined.empty());
  EXPECT_NEAR(fit.predicted[fit.predicted.size() - 1] / lx, 1,
              0.01);                                       // its own sigma: nothing else knows the scale
  EXPECT_NEAR(fit.reading_sigma_lx[0] / lx, 0.01, 0.002);  // and it alone says how well it is known
}

// Four readings of 1 %, of a meter that may be 5 % off as a whole: reading more does not help against that.
TEST_F(PhotosAlone, ManyReadingsShareTheMetersCalibration) {
  for (const Eigen::Vector2d& at : {Eigen::Vector2d(1.01, 1.02), {0.5, 0.6}, {1.5, 0.7}, {0.8, 1.4}}) {
    const Eigen::Vector3d p(at.x(), at.y(), 1e-3);
    const double lx =
        support::PointLx(1, support::IsotropicCdPerLm, lamp_, p) + support::CubeIndirectLx(kRho);
    data_.readings.push_back({{p, {0, 0, 1}}, 0, lx, 0.01 * lx, true});
  }
  const auto flux_sigma = [](const LuminaireFit& fit) {
    for (size_t i = 0; i < fit.parameters.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      if (fit.parameters[i].kind == ParameterKind::kLogFlux) return std::sqrt(fit.covariance(row, row));
    }
    return 0.0;
  };
  const LuminaireFit by_itself = FitLuminaires(room_, data_, start_);
  const double alone = flux_sigma(by_itself);
  start_.meter_scale_free = true;
  FitLuminairesOptions same_weights;
  same_weights.photo_design_effect = by_itself.photo_design_effect;
  const LuminaireFit fit =
      FitLuminaires(room_, data_, start_, {{ParameterKind::kLogMeterScale, 0, {}, 0, 0.05}}, same_weights);
  EXPECT_TRUE(fit.IsUsable()) << fit.message;
  // The readings' own 1 %, and what reflectances and flux share: these photos miss up to a tenth of the light
  // (see above), by facet, and six facets tell little of it.
  EXPECT_LT(alone, 0.1);
  EXPECT_NEAR(flux_sigma(fit), std::hypot(alone, 0.05), 0.003);
  // What the same meter reads elsewhere is as well known as before: its calibration cancels.
  EXPECT_LT(fit.reading_sigma_lx[0] / fit.predicted[fit.predicted.size() - 4], 0.02);
}

TEST_F(PhotosAlone, TheSameInputGivesTheSameBits) {
  const LuminaireFit first = FitLuminaires(room_, data_, start_),
                     second = FitLuminaires(room_, data_, start_);
  EXPECT_EQ(PackParameters(first.state, first.parameters), PackParameters(second.state, second.parameters));
  EXPECT_EQ(first.covariance, second.covariance);
}

}  // namespace
}  // namespace luxfit
