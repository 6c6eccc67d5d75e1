#include "inverse/model/internal/intervals/parameter_shift.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/inverse/direct_photos.h"
#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr double kWallAlbedo = 0.5, kNoise = 0.005;
const std::vector<Eigen::Vector3d> kLamps = {{0.8, 1.1, 1.2}, {1.3, 0.8, 0.9}};

// Two isotropic points of 1 lm, one on in each state, in a cube of 2 m without reflections: photos are closed forms.
// A third, faint point in the middle of the room stands for light that the model lacks.
class LackingLight : public testing::Test {
 protected:
  LackingLight() {
    data_.dimming = {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)};
    data_.indirect_is_held = true;
    state_.luminaires.resize(2);
    state_.free.resize(2);
    for (size_t k = 0; k < 2; ++k) {
      state_.luminaires[k].id = std::string(1, static_cast<char>('A' + k));
      state_.luminaires[k].distribution = Distribution::kIsotropic;
      state_.luminaires[k].position = kLamps[k];
    }
    state_.albedo = Eigen::VectorXd::Constant(1, kWallAlbedo);
    state_.albedo_free = {true};
    state_.camera_scale_free = false;
    // Without reflections, nothing else tells the reflectance from the fluxes.
    priors_ = {{ParameterKind::kAlbedo, 0, {}, kWallAlbedo, 0.02}};
  }

  // `texture`: sigma of the elements' reflectances about their mean, the same in both states.
  void Photograph(double texture) {
    std::normal_distribution<double> normal;
    std::vector<double> factor(room_.patches.elements.size());
    for (double& f : factor) f = std::exp(texture * normal(rng_));
    std::vector<double> lost;
    for (int state = 0; state < 2; ++state) {
      const auto photos =
          support::DirectPhotos(room_, kLamps[static_cast<size_t>(state)], kWallAlbedo, state);
      const auto faint = support::DirectPhotos(room_, {1.1, 1.0, 1.05}, kWallAlbedo, state);
      for (size_t e = 0; e < photos.size(); ++e) {
        Observation o = photos[e];
        lost.push_back(kLacking * factor[e] * faint[e].relative_luminance);
        o.relative_luminance *= factor[e] * (1 + kNoise * normal(rng_));
        o.variance = std::pow(kNoise * o.relative_luminance, 2);
        data_.observations.push_back(o);
      }
    }
    lost_ = Eigen::Map<Eigen::VectorXd>(lost.data(), static_cast<Eigen::Index>(lost.size()));
  }

  LuminaireFit Fit(const LightData& data, const LightState& start, double design_effect = 0) const {
    FitLuminairesOptions options;
    options.subtracts_discretisation = false;
    options.photo_design_effect = design_effect;
    return FitLuminaires(room_, data, start, priors_, options);
  }

  // Compares a predicted shift with that between two fits, in sigmas.
  static double WorstError(const LuminaireFit& from, const LuminaireFit& to,
                           const Eigen::VectorXd& predicted) {
    const Eigen::VectorXd actual =
        PackParameters(to.state, from.parameters) - PackParameters(from.state, from.parameters);
    const Eigen::VectorXd sigma = from.covariance.diagonal().cwiseSqrt();
    const double largest = actual.cwiseQuotient(sigma).cwiseAbs().maxCoeff();
    const double worst = (predicted - actual).cwiseQuotient(sigma).cwiseAbs().maxCoeff();
    std::printf("largest shift %.3f sigma, predicted to %.4f sigma\n", largest, worst);
    return worst / largest;
  }

  // Returns the error of the shift by `lost_`, relative to the largest, against a fit to data that have that light.
  double ErrorByLackingLight(size_t stride) const {
    const LuminaireFit without = Fit(data_, state_);
    LightData with = data_;
    for (size_t i = 0; i < with.observations.size(); ++i)
      with.observations[i].relative_luminance += lost_[static_cast<Eigen::Index>(i)];
    const LuminaireFit full = Fit(with, without.state, without.photo_design_effect);
    std::vector<size_t> rows;
    const size_t elements = room_.patches.elements.size();
    for (size_t i = 0; i < data_.observations.size(); ++i) {
      if (i % elements % stride == 0) rows.push_back(i);
    }
    const Eigen::VectorXd lost = lost_(rows);
    return WorstError(without, full, ParameterShift(room_, data_, without, priors_, rows, lost));
  }

  static constexpr double kLacking = 0.01;
  std::mt19937_64 rng_ = support::TestRng();
  Room room_ = MakeRoom(support::ClosedRoom({2, 2, 2}), {{0.4, 0.1}, {16}});
  LightData data_;
  LightState state_;
  std::vector<ParameterPrior> priors_;
  Eigen::VectorXd lost_;  // light of the faint point, by row
};

// The light of a hundredth is linear to a hundredth. Weights and model error of the other fit differ as well.
TEST_F(LackingLight, AShiftIsThatOfAnotherFit) {
  Photograph(0);
  EXPECT_LT(ErrorByLackingLight(1), 0.05);
}

// A seventh of the elements samples the same smooth light.
TEST_F(LackingLight, AFewRowsStandForAll) {
  Photograph(0);
  EXPECT_LT(ErrorByLackingLight(7), 0.1);
}

// Elements that depart from their material by 10 % tell by their ratios alone.
TEST_F(LackingLight, TextureIsEliminatedAsInTheFit) {
  Photograph(0.1);
  EXPECT_GT(Fit(data_, state_).material_texture_sigma[0], 0.05);
  EXPECT_LT(ErrorByLackingLight(1), 0.05);
}

// The fit to a third of the elements, taken evenly, is predicted by the residuals of all. Weights and curvature of the
// part are its own: with 800 elements they scatter by 1 / sqrt(800), and the shift with them.
TEST_F(LackingLight, AFitToAPartIsPredictedByTheGradients) {
  Photograph(0);
  const LuminaireFit all = Fit(data_, state_);
  LightData part = data_;
  part.observations.clear();
  std::vector<bool> is_in_part;
  is_in_part.reserve(data_.observations.size());
  for (const Observation& o : data_.observations) {
    is_in_part.push_back(o.element % 3 == 0);
    if (is_in_part.back()) part.observations.push_back(o);
  }
  const LuminaireFit fit = Fit(part, all.state, 1 + (all.photo_design_effect - 1) / 3);
  EXPECT_LT(WorstError(all, fit, ShiftByPart(room_, data_, all, priors_, is_in_part)), 0.15);
}

TEST_F(LackingLight, TheParameterThatMovesMostIsNamed) {
  Photograph(0);
  const LuminaireFit fit = Fit(data_, state_);
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(fit.covariance.rows());
  shift[2] = -3 * std::sqrt(fit.covariance(2, 2));
  shift[5] = 2 * std::sqrt(fit.covariance(5, 5));
  const LargestShift largest = LargestShiftOf(fit, shift);
  EXPECT_DOUBLE_EQ(largest.sigmas, 3);
  EXPECT_EQ(largest.parameter, fit.parameters[2].id());
}

TEST_F(LackingLight, SizesThatDoNotFitTogetherAreRefused) {
  Photograph(0);
  const LuminaireFit fit = Fit(data_, state_);
  const Eigen::MatrixXd two = Eigen::MatrixXd::Zero(2, 1);
  EXPECT_THROW(ParameterShift(room_, data_, fit, priors_, {0}, two), std::invalid_argument);
  EXPECT_THROW(ParameterShift(room_, data_, fit, priors_, {0, data_.observations.size()}, two),
               std::invalid_argument);
  EXPECT_THROW(ShiftByPart(room_, data_, fit, priors_, {true}), std::invalid_argument);
}

// A part without rows, or with all, has no other to differ from.
TEST_F(LackingLight, NothingMovesWithoutAnotherPart) {
  Photograph(0);
  const LuminaireFit fit = Fit(data_, state_);
  for (const bool is_in_part : {false, true}) {
    const std::vector<bool> part(data_.observations.size(), is_in_part);
    EXPECT_EQ(ShiftByPart(room_, data_, fit, priors_, part).cwiseAbs().maxCoeff(), 0);
  }
}

}  // namespace
}  // namespace luxfit
