#include "inverse/observe/camera/self_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "inverse/observe/camera/internal/radiometry/photo_equations.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr int kViews = 7;
constexpr double kNoise = 0.003;

// Eight facets of 20 patches with 3 elements each, seen by seven views at places of the image and with
// shares of full scale that formulas give. Luminance: what formulas give for each luminaire, added up.
class SelfCalibrationTest : public testing::Test {
 protected:
  SelfCalibrationTest() {
    for (int patch = 0; patch < 160; ++patch) {
      Patch p;
      p.center = p.origin = p.edge_u = p.edge_v = Eigen::Vector3d::Zero();
      p.facet = patch / 20;
      p.first_element = 3 * patch;
      p.element_count = 3;
      patches_.patches.push_back(p);
      for (int i = 0; i < 3; ++i) {
        Element element;
        element.center = element.normal = element.origin = element.edge_u = element.edge_v =
            Eigen::Vector3d::Zero();
        element.patch = patch;
        patches_.elements.push_back(element);
      }
    }
  }

  static double Light(int element, int luminaire) {
    return 0.05 + 0.04 * std::sin(0.037 * element * (luminaire + 1) + 2.0 * luminaire);
  }

  struct Camera {
    std::function<double(int photo)> log_gain = [](int) { return 0.0; };
    std::function<double(double radius2)> log_vignetting = [](double) { return 0.0; };
    double power = 1;  // counts go with this power of light
    bool one_exposure = false;
    int cameras = 1;  // views take turns
  };

  // Photo: view + kViews * state.
  std::vector<PhotoSample> Photograph(const std::vector<Eigen::VectorXd>& dimming, const Camera& camera) {
    std::normal_distribution<double> noise(0, kNoise);
    std::vector<PhotoSample> samples;
    for (int e = 0; e < static_cast<int>(patches_.elements.size()); ++e) {
      for (int view = 0; view < kViews; ++view) {
        if ((e / 3 + 2 * view) % 5 > 2) continue;  // each view sees three fifths
        const double radius = 0.5 + 0.5 * std::sin(0.11 * e + 1.3 * view);
        for (int state = 0; state < static_cast<int>(dimming.size()); ++state) {
          double light = 0;
          for (Eigen::Index l = 0; l < dimming[static_cast<size_t>(state)].size(); ++l)
            light += dimming[static_cast<size_t>(state)][l] * Light(e, static_cast<int>(l));
          PhotoSample sample;
          sample.element = e;
          sample.state = state;
          sample.photo = view + kViews * state;
          sample.camera = view % camera.cameras;
          sample.radius2 = radius * radius;
          const double stated_s = camera.one_exposure ? 1 : 1 + 0.5 * ((view + state) % 3);
          const double log_exposed = std::log(light * stated_s) + camera.log_gain(sample.photo) +
                                     camera.log_vignetting(sample.radius2);
          sample.log_share = camera.power * log_exposed + noise(rng_);
          sample.log_value = sample.log_share - std::log(stated_s);
          sample.relative_sigma = kNoise;
          samples.push_back(sample);
        }
      }
    }
    return samples;
  }

  SelfCalibration Calibrate(const std::vector<Eigen::VectorXd>& dimming,
                            const std::vector<PhotoSample>& samples) const {
    return SelfCalibrate(patches_, dimming, samples, {true, {true}, {true}});
  }

  // Two cameras, the second of `gain` times the first's sensitivity. `wrong`: a photo of twice the stated
  // exposure.
  std::vector<PhotoSample> PhotographWithTwo(double gain, int wrong = -1) {
    Camera camera;
    camera.cameras = 2;
    camera.log_gain = [=](int photo) {
      return (photo % kViews % 2 == 1 ? std::log(gain) : 0.0) + (photo == wrong ? std::log(2.0) : 0.0);
    };
    return Photograph(OneByOneAndTogether(), camera);
  }

  SelfCalibration CalibrateTwo(const std::vector<PhotoSample>& samples,
                               const std::vector<bool>& gain_is_stated = {}) const {
    const OpenRadiometry open{true, {true, true}, {true, true}, gain_is_stated};
    return SelfCalibrate(patches_, OneByOneAndTogether(), samples, open);
  }

  // Leaves the first camera the patches before `end_of_first` and the second those from patch 80 on.
  static std::vector<PhotoSample> Apart(const std::vector<PhotoSample>& samples, int end_of_first) {
    std::vector<PhotoSample> apart;
    apart.reserve(samples.size());
    for (const PhotoSample& s : samples) {
      const int patch = s.element / 3;
      if (s.camera == 0 ? patch < end_of_first : patch >= 80) apart.push_back(s);
    }
    return apart;
  }

  static std::vector<Eigen::VectorXd> OneByOneAndTogether() {
    return {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(1, 1)};
  }
  static std::vector<Eigen::VectorXd> OneByOne() { return {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)}; }
  static double TrueGain(int photo) { return 0.05 * std::sin(2.3 * photo + 0.7); }

  // rms of estimated - true gains, about their mean.
  static double GainError(const SelfCalibration& found, const std::function<double(int)>& truth) {
    Eigen::ArrayXd error(found.log_gain.size());
    for (Eigen::Index p = 0; p < error.size(); ++p) error[p] = found.log_gain[p] - truth(static_cast<int>(p));
    return std::sqrt((error - error.mean()).square().mean());
  }

  std::mt19937_64 rng_ = support::TestRng();
  Patches patches_;
};

TEST_F(SelfCalibrationTest, ExactPhotosStayAsRecorded) {
  const SelfCalibration found = Calibrate(OneByOneAndTogether(), Photograph(OneByOneAndTogether(), Camera()));
  ASSERT_TRUE(found.is_possible);
  EXPECT_EQ(found.Chosen().name, "as recorded");
  EXPECT_EQ(found.log_gain.cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ(found.candidates.size(), 16u);
  EXPECT_NEAR(found.residual_sigma, kNoise, 0.15 * kNoise);
}

TEST_F(SelfCalibrationTest, GainsOfAllStatesAreFoundWhereTheirLightAddsUp) {
  Camera camera;
  camera.log_gain = TrueGain;
  const SelfCalibration found = Calibrate(OneByOneAndTogether(), Photograph(OneByOneAndTogether(), camera));
  EXPECT_EQ(found.Chosen().name, "gains");
  // About 80 elements of the 300 used show in each photo.
  EXPECT_LT(GainError(found, TrueGain), 0.001);
  for (int s = 0; s < 3; ++s) EXPECT_LT(found.state_sigma[s], 0.1 * found.state_prior_sigma[s]);
}

TEST_F(SelfCalibrationTest, StatesThatNothingTiesAreAsUnsureAsBefore) {
  Camera camera;
  camera.log_gain = TrueGain;
  const SelfCalibration found = Calibrate(OneByOne(), Photograph(OneByOne(), camera));
  EXPECT_EQ(found.Chosen().name, "gains");
  for (int s = 0; s < 2; ++s) {
    EXPECT_GT(found.state_sigma[s], 0.8 * found.state_prior_sigma[s]);
    EXPECT_LT(found.state_sigma[s], 1.3 * found.state_prior_sigma[s]);
  }
  // Within each state they are told.
  for (int s = 0; s < 2; ++s) {
    Eigen::ArrayXd error(kViews);
    for (int v = 0; v < kViews; ++v) error[v] = found.log_gain[v + kViews * s] - TrueGain(v + kViews * s);
    EXPECT_LT(std::sqrt((error - error.mean()).square().mean()), 0.001);
  }
}

TEST_F(SelfCalibrationTest, OnePhotoFarOffLeavesTheOthersAlone) {
  const auto truth = [](int photo) { return photo == 4 ? std::log(2.0) : 0.0; };
  Camera camera;
  camera.log_gain = truth;
  const SelfCalibration found = Calibrate(OneByOneAndTogether(), Photograph(OneByOneAndTogether(), camera));
  EXPECT_TRUE(found.Chosen().gains);
  for (int p = 0; p < 3 * kViews; ++p) EXPECT_NEAR(found.log_gain[p], truth(p), 0.006) << p;
}

TEST_F(SelfCalibrationTest, VignettingIsFoundAndGainsAreNotAddedToIt) {
  Camera camera;
  camera.log_vignetting = [](double r2) { return -0.4 * r2 - 0.2 * r2 * r2; };
  const SelfCalibration found = Calibrate(OneByOneAndTogether(), Photograph(OneByOneAndTogether(), camera));
  EXPECT_EQ(found.Chosen().name, "vignetting of order 2");
  for (const double r2 : {0.1, 0.5, 1.0})
    EXPECT_NEAR(found.CorrectionOf(0, 0).LogFactor(0, r2), 0.4 * r2 + 0.2 * r2 * r2, 0.002) << r2;
}

TEST_F(SelfCalibrationTest, ResponseIsToldByLightThatAddsUp) {
  Camera camera;
  camera.power = 0.85;
  const SelfCalibration found = Calibrate(OneByOneAndTogether(), Photograph(OneByOneAndTogether(), camera));
  EXPECT_EQ(found.Chosen().name, "response exponent");
  EXPECT_NEAR(1 / (1 + found.exponent[0]), 0.85, 0.003);
}

TEST_F(SelfCalibrationTest, EverythingAtOnceIsToldApart) {
  Camera camera;
  camera.log_gain = TrueGain;
  camera.power = 1.1;
  camera.log_vignetting = [](double r2) { return -0.5 * r2; };
  const SelfCalibration found = Calibrate(OneByOneAndTogether(), Photograph(OneByOneAndTogether(), camera));
  EXPECT_EQ(found.Chosen().name, "gains + vignetting of order 1 + response exponent");
  EXPECT_NEAR(1 / (1 + found.exponent[0]), 1.1, 0.005);
  EXPECT_NEAR(found.vignetting(0, 0), -0.5, 0.005);
  EXPECT_LT(GainError(found, TrueGain), 0.002);
}

// One state and one exposure: an exponent is one with the surfaces' own luminance.
TEST_F(SelfCalibrationTest, ResponseOfOneLevelIsNotDetermined) {
  const std::vector<Eigen::VectorXd> one{Eigen::VectorXd::Ones(1)};
  Camera camera;
  camera.power = 0.85;
  camera.log_gain = TrueGain;
  camera.one_exposure = true;
  const SelfCalibration found = Calibrate(one, Photograph(one, camera));
  EXPECT_FALSE(found.Chosen().exponent);
  for (const RadiometryCandidate& c : found.candidates) {
    if (c.exponent) {
      EXPECT_FALSE(c.is_determined) << c.name;
    }
  }
}

TEST_F(SelfCalibrationTest, WhatCalibFixedIsHeld) {
  Camera camera;
  camera.log_vignetting = [](double r2) { return -0.4 * r2; };
  const auto dimming = OneByOneAndTogether();
  const SelfCalibration found =
      SelfCalibrate(patches_, dimming, Photograph(dimming, camera), {true, {false}, {false}});
  EXPECT_EQ(found.candidates.size(), 2u);
  EXPECT_EQ(found.vignetting.cwiseAbs().maxCoeff(), 0);
}

TEST_F(SelfCalibrationTest, TooFewSharedSurfacesAreSaid) {
  std::vector<PhotoSample> samples = Photograph(OneByOneAndTogether(), Camera());
  samples.resize(40);
  const SelfCalibration found = Calibrate(OneByOneAndTogether(), samples);
  EXPECT_FALSE(found.is_possible);
  EXPECT_THAT(found.message, HasSubstr("fewer than 20 surfaces"));
  EXPECT_THROW(Calibrate({}, samples), std::invalid_argument);
}

// Sigmas of gains against their scatter over noise.
TEST_F(SelfCalibrationTest, SigmasOfGainsAreTheirScatter) {
  Camera camera;
  camera.log_gain = TrueGain;
  double squares = 0;
  int count = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const SelfCalibration found = SelfCalibrate(
        patches_, OneByOneAndTogether(), Photograph(OneByOneAndTogether(), camera), {true, {false}, {false}});
    Eigen::ArrayXd error(found.log_gain.size());
    for (Eigen::Index p = 0; p < error.size(); ++p)
      error[p] = found.log_gain[p] - TrueGain(static_cast<int>(p));
    error -= error.mean();
    for (Eigen::Index p = 0; p < error.size(); ++p, ++count)
      squares += error[p] * error[p] / found.covariance(p, p);
  }
  const double z = std::sqrt(squares / count);
  // Eight facets judge 21 gains: their own scatter is a sixth.
  EXPECT_GT(z, 0.75);
  EXPECT_LT(z, 1.4);
}

TEST_F(SelfCalibrationTest, GainOfACameraIsToldFromAPhotoThatIsOff) {
  const SelfCalibration found = CalibrateTwo(PhotographWithTwo(0.64, 4));
  EXPECT_TRUE(found.Chosen().gains);
  const CameraGain& second = found.camera_gains.at(1);
  EXPECT_EQ(second.reference, 0);
  EXPECT_TRUE(second.is_tied);
  EXPECT_GT(second.sigma, 0);
  EXPECT_NEAR(second.log_gain, std::log(0.64), 3 * second.sigma);
  // Exposures that err by 5 % each: the means of 9 photos of one camera and 11 of the other, without the one that is
  // off, differ by 2.2 %. Closed form, and a fifth for weights.
  std::printf("sigma of the second camera's log gain %.4f\n", second.sigma);
  EXPECT_LT(second.sigma, 1.2 * 0.05 * std::sqrt(1. / 9 + 1. / 11));
  // The photo that is off pulls the mean of its camera's exposures by 0.0013.
  EXPECT_NEAR(second.log_gain, std::log(0.64), 0.005);
  EXPECT_EQ(found.camera_gains[0].log_gain, 0);
  for (int p = 0; p < 3 * kViews; ++p) EXPECT_NEAR(found.log_gain[p], p == 4 ? std::log(2.0) : 0, 0.008) << p;
  EXPECT_GT(found.score_of_equal_cameras, 2 * found.score_of_camera_gains);
}

// With exposures as stated, the gain is as certain as the photos' own noise lets it be.
TEST_F(SelfCalibrationTest, GainOfACameraAloneLeavesPhotosAsRecorded) {
  const SelfCalibration found = CalibrateTwo(PhotographWithTwo(0.64));
  EXPECT_EQ(found.Chosen().name, "as recorded");
  EXPECT_EQ(found.log_gain.cwiseAbs().maxCoeff(), 0);
  const CameraGain& second = found.camera_gains.at(1);
  EXPECT_NEAR(second.log_gain, std::log(0.64), 3 * second.sigma);
  EXPECT_LT(second.sigma, 0.001);
  // A factor common to all photos is no error: each camera bears its share of the gain's sigma.
  EXPECT_NEAR(std::sqrt(found.covariance(0, 0)) + std::sqrt(found.covariance(1, 1)), second.sigma, 1e-9);
  EXPECT_NEAR(found.CorrectionOf(1, 1).LogFactor(0, 0), -second.log_gain, 1e-12);
}

TEST_F(SelfCalibrationTest, EqualCamerasHaveNoGains) {
  const SelfCalibration found = CalibrateTwo(PhotographWithTwo(1));
  EXPECT_EQ(found.Chosen().name, "as recorded");
  for (const CameraGain& camera : found.camera_gains) {
    EXPECT_EQ(camera.log_gain, 0);
    EXPECT_EQ(camera.sigma, 0);
    EXPECT_TRUE(camera.is_tied);
  }
  EXPECT_EQ(found.covariance.cwiseAbs().maxCoeff(), 0);
}

TEST_F(SelfCalibrationTest, CamerasWithoutCommonSurfacesAreNotTied) {
  const std::vector<PhotoSample> samples = PhotographWithTwo(0.64);
  // None in common, or four patches.
  for (const int end_of_first : {80, 84}) {
    const SelfCalibration found = CalibrateTwo(Apart(samples, end_of_first));
    EXPECT_EQ(found.Chosen().name, "as recorded") << end_of_first;
    EXPECT_TRUE(found.camera_gains.at(0).is_tied);
    EXPECT_FALSE(found.camera_gains.at(1).is_tied) << end_of_first;
    EXPECT_EQ(found.camera_gains[1].log_gain, 0);
  }
  // Ten patches of one facet are enough.
  const SelfCalibration tied = CalibrateTwo(Apart(samples, 90));
  EXPECT_TRUE(tied.camera_gains.at(1).is_tied);
  EXPECT_NEAR(tied.camera_gains[1].log_gain, std::log(0.64), 0.003);
}

// One stated gain is the reference, and two are not adjusted to each other.
TEST_F(SelfCalibrationTest, StatedGainsAreHeld) {
  const std::vector<PhotoSample> samples = PhotographWithTwo(0.64);
  const SelfCalibration second = CalibrateTwo(samples, {false, true});
  EXPECT_THAT(second.contradictions, IsEmpty());
  EXPECT_EQ(second.camera_gains.at(0).reference, 1);
  EXPECT_EQ(second.camera_gains[1].log_gain, 0);
  EXPECT_NEAR(second.camera_gains[0].log_gain, -std::log(0.64), 0.003);
  const SelfCalibration both = CalibrateTwo(samples, {true, true});
  ASSERT_THAT(both.contradictions, SizeIs(1));
  EXPECT_EQ(both.contradictions[0].camera, 1);
  EXPECT_EQ(both.contradictions[0].reference, 0);
  EXPECT_NEAR(both.contradictions[0].log_ratio, std::log(0.64), 0.005);
  EXPECT_EQ(both.Chosen().name, "as recorded");
  for (const CameraGain& camera : both.camera_gains) EXPECT_EQ(camera.log_gain, 0);
  EXPECT_THAT(CalibrateTwo(PhotographWithTwo(1), {true, true}).contradictions, IsEmpty());
}

// The gradient of the cost over x alone, each element's light at its optimum, against central differences.
TEST_F(SelfCalibrationTest, GradientIsThatOfTheEliminatedCost) {
  Camera camera;
  camera.log_gain = TrueGain;
  camera.power = 0.9;
  camera.cameras = 2;
  const std::vector<PhotoSample> samples = Photograph(OneByOneAndTogether(), camera);
  const PhotoEquations equations(patches_, OneByOneAndTogether(), samples, 60);
  RadiometryUnknowns unknowns;
  unknowns.vignetting = {0, 3};
  unknowns.order = 3;
  unknowns.exponent = {6, 7};
  unknowns.camera = {-1, 8};
  unknowns.first_gain = 9;
  unknowns.count = 9 + 3 * kViews;
  PhotoEquations::Fit fit = equations.Start(unknowns);
  for (Eigen::Index i = 0; i < fit.x.size(); ++i) fit.x[i] = 0.02 * std::sin(1.7 * static_cast<double>(i));
  const auto sums = [&](const Eigen::VectorXd& x) {
    PhotoEquations::Fit at = fit;
    at.x = x;
    PhotoEquations::Sums all{{}, Eigen::VectorXd::Zero(unknowns.count), 0};
    for (const PhotoEquations::Sums& s : equations.Linearize(unknowns, at)) {
      all.right += s.right;
      all.cost += s.cost;
    }
    return all;
  };
  const Eigen::VectorXd gradient = -sums(fit.x).right;
  for (Eigen::Index i = 0; i < fit.x.size(); ++i) {
    constexpr double kStep = 1e-4;
    Eigen::VectorXd above = fit.x, below = fit.x;
    above[i] += kStep;
    below[i] -= kStep;
    const double difference = (sums(above).cost - sums(below).cost) / (2 * kStep);
    EXPECT_NEAR(gradient[i], difference, 1e-4 * gradient.cwiseAbs().maxCoeff()) << i;
  }
}

}  // namespace
}  // namespace luxfit
