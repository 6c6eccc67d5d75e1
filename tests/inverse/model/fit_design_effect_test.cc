#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "inverse/model/fit_luminaires.h"
#include "tests/support/inverse/cube_photos.h"
#include "tests/support/inverse/direct_photos.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

// Photos of a cube in five states. All rows of a facet in a state share an error of 2 %, ten times their own.
class SharedErrors : public testing::Test {
 protected:
  static constexpr int kStates = 5, kFacets = 6;
  static constexpr double kRho = 0.5, kCommon = 0.02, kOwn = 0.002;

  SharedErrors() {
    const Eigen::Vector3d p_lamp(1.1, 0.9, 1.2);
    data_.indirect_is_held = true;
    for (int s = 0; s < kStates; ++s) {
      data_.dimming.emplace_back(Eigen::VectorXd::Ones(1));
      const std::vector<Observation> photos = support::DirectPhotos(room_, p_lamp, kRho, s);
      clean_.insert(clean_.end(), photos.begin(), photos.end());
    }
    start_.luminaires.resize(1);
    start_.luminaires[0].id = "A";
    start_.luminaires[0].position = p_lamp + Eigen::Vector3d(0.05, 0.05, -0.05);
    start_.luminaires[0].distribution = Distribution::kIsotropic;
    start_.luminaires[0].flux_lm = 1.1;
    start_.free.resize(1);
    start_.albedo = Eigen::VectorXd::Constant(1, kRho);
    start_.albedo_free = {false};
    start_.camera_scale_free = false;
  }

  void Photograph() {
    std::vector<double> common(kStates * kFacets);
    for (double& error : common) error = kCommon * normal_(rng_);
    data_.observations = clean_;
    for (Observation& o : data_.observations) {
      const auto cluster = static_cast<size_t>(o.state * kFacets + room_.patches.PatchOf(o.element).facet);
      o.relative_luminance *= 1 + common.at(cluster) + kOwn * normal_(rng_);
    }
  }

  // Hold the error of the flux' logarithm, which is 0 in truth.
  struct Estimate {
    double error = 0, sigma = 0;
  };
  Estimate FitFlux(const std::vector<ParameterPrior>& priors) const {
    const LuminaireFit fit = FitLuminaires(room_, data_, start_, priors);
    EXPECT_TRUE(fit.IsUsable()) << fit.message;
    Estimate estimate{std::log(fit.state.luminaires[0].flux_lm), 0};
    for (size_t i = 0; i < fit.parameters.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      if (fit.parameters[i].kind == ParameterKind::kLogFlux)
        estimate.sigma = std::sqrt(fit.covariance(row, row));
    }
    return estimate;
  }

  Room room_ = support::CubeRoom();
  std::mt19937_64 rng_ = support::TestRng();
  std::normal_distribution<double> normal_;
  std::vector<Observation> clean_;
  LightData data_;
  LightState start_;
};

// 1920 rows of 2 % would give the flux to 0.05 %, were they independent; their 30 clusters give it to 0.36 %. A prior
// of 0.2 % then has to count. The same fit outside the library: rms errors of 0.36 % without the prior, 0.20 % with it,
// 0.34 % if each row counted by its own sigma.
TEST_F(SharedErrors, DoNotOverwhelmAPrior) {
  constexpr int kDraws = 40;
  constexpr double kPriorSigma = 0.002;
  double alone = 0, with_prior = 0, normalised = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    Photograph();
    alone += std::pow(FitFlux({}).error, 2);
    const double mean = kPriorSigma * normal_(rng_);
    const Estimate flux = FitFlux({{ParameterKind::kLogFlux, 0, {}, mean, kPriorSigma}});
    with_prior += std::pow(flux.error, 2);
    normalised += std::pow(flux.error / flux.sigma, 2);
  }
  const double ratio = std::sqrt(with_prior / alone), rms_z = std::sqrt(normalised / kDraws);
  std::printf("rms error of the flux %.3f %% alone, %.3f %% with the prior; rms z %.2f\n",
              100 * std::sqrt(alone / kDraws), 100 * std::sqrt(with_prior / kDraws), rms_z);
  EXPECT_LT(ratio, 0.75);  // 0.54 expected, 0.93 if each row counted by its own sigma
  // The rms of 40 normalised errors scatters by 0.11.
  EXPECT_GT(rms_z, 0.7);
  EXPECT_LT(rms_z, 1.3);
}

// The design effect is that of rows that count as if they were independent, however they counted in the fit. A fit from a
// near start weighs them by it from its first step.
TEST_F(SharedErrors, AreTheSameFromNearAndFar) {
  Photograph();
  const std::vector<ParameterPrior> priors{{ParameterKind::kLogFlux, 0, {}, 0, 0.002}};
  const LuminaireFit far = FitLuminaires(room_, data_, start_, priors);
  ASSERT_TRUE(far.IsUsable()) << far.message;
  EXPECT_GT(far.photo_design_effect, 10);
  FitLuminairesOptions options;
  options.start_is_near = true;
  const LuminaireFit near = FitLuminaires(room_, data_, far.state, priors, options);
  ASSERT_TRUE(near.IsUsable()) << near.message;
  EXPECT_NEAR(near.photo_design_effect, far.photo_design_effect, 0.1 * far.photo_design_effect);
}

}  // namespace
}  // namespace luxfit
