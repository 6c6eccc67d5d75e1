#include "inverse/model/internal/weights/element_texture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr double kNoise = 0.003;
constexpr int kStates = 4;

// A room of 4 m x 4 m x 3 m of one material, with 1280 elements in 320 patches. No light is computed: each
// row has some value m, and Y = m (1 + t_e) with relative noise of sigma kNoise.
class TexturedElements : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    room_ = new Room(MakeRoom(support::ClosedRoom({4, 4, 3}), {{0.5, 0.25}, {4}}));
  }
  static void TearDownTestSuite() { delete room_; }

  static int ElementCount() { return static_cast<int>(room_->patches.elements.size()); }

  // Returns rows of every element but those that `skip` divides; 0: of every one. They run state by state.
  static LightData Observe(int states, int skip = 0) {
    LightData data;
    data.dimming.assign(static_cast<size_t>(states), Eigen::VectorXd::Ones(1));
    for (int state = 0; state < states; ++state) {
      for (int e = 0; e < ElementCount(); ++e) {
        if (skip > 0 && e % skip == 0) continue;
        Observation o;
        o.element = e;
        o.state = state;
        data.observations.push_back(o);
      }
    }
    return data;
  }

  struct Simulated {
    Eigen::VectorXd model, measured, root_weight;
  };
  // `t`: by element. The weights are those of the rows' true sigmas.
  Simulated Simulate(const LightData& data, const Eigen::VectorXd& t) {
    std::uniform_real_distribution<double> light(0.5, 1.5);
    const auto rows = static_cast<Eigen::Index>(data.observations.size());
    Simulated simulated{Eigen::VectorXd(rows), Eigen::VectorXd(rows), Eigen::VectorXd(rows)};
    for (Eigen::Index i = 0; i < rows; ++i) {
      const double m = light(rng_);
      const double shown = m * (1 + t[data.observations[static_cast<size_t>(i)].element]);
      simulated.model[i] = m;
      simulated.measured[i] = shown * (1 + kNoise * normal_(rng_));
      simulated.root_weight[i] = 1 / (kNoise * shown);
    }
    return simulated;
  }
  ElementTexture Estimate(const LightData& data, const Eigen::VectorXd& t) {
    const Simulated rows = Simulate(data, t);
    return TextureEstimator(*room_, data).Estimate(rows.model, rows.measured, rows.root_weight);
  }

  Eigen::VectorXd DrawTexture(double tau) {
    constexpr double kDarkest = -0.9;
    Eigen::VectorXd t(ElementCount());
    for (double& each : t) each = std::max(kDarkest, tau * normal_(rng_));
    return t;
  }
  static Eigen::VectorXd Plain() { return Eigen::VectorXd::Zero(ElementCount()); }

  // Returns a texture of one sigma, whose elements depart by nothing.
  static ElementTexture TextureOf(const LightData& data, double tau) {
    const auto rows = static_cast<Eigen::Index>(data.observations.size());
    return {Eigen::VectorXd::Zero(rows), Eigen::VectorXd::Constant(rows, tau),
            Eigen::VectorXd::Constant(1, tau)};
  }
  static double ValueOf(const TextureMean& mean, const Simulated& rows) {
    double value = 0;
    for (const auto& [row, coefficient] : mean.terms)
      value += coefficient * rows.root_weight[row] * (rows.model[row] - rows.measured[row]);
    return value;
  }

  static const Room* room_;
  std::mt19937_64 rng_ = support::TestRng();
  std::normal_distribution<double> normal_;
};
const Room* TexturedElements::room_ = nullptr;

// The standard error of a scale by medians is 1.17 / sqrt(1280) = 3.3 %.
TEST_F(TexturedElements, TheirSigmaIsRecovered) {
  const LightData data = Observe(kStates);
  for (const double tau : {0.05, 0.2}) {
    const ElementTexture texture = Estimate(data, DrawTexture(tau));
    ASSERT_EQ(texture.sigma_of_material.size(), 1);
    EXPECT_NEAR(texture.sigma_of_material[0] / tau, 1, 0.15);
  }
}

// Rows tell each t_e to 0.3 % / sqrt(4), far below the prior's 5 %.
TEST_F(TexturedElements, EachDeviationIsRecovered) {
  const LightData data = Observe(kStates);
  const Eigen::VectorXd t = DrawTexture(0.05);
  const ElementTexture texture = Estimate(data, t);
  double squares = 0;
  for (Eigen::Index i = 0; i < texture.deviation.size(); ++i) {
    const double truth = t[data.observations[static_cast<size_t>(i)].element];
    squares += std::pow((texture.deviation[i] - truth) / (1 + truth), 2);
    EXPECT_GT(texture.sigma[i], 0);
  }
  const double rms = std::sqrt(squares / static_cast<double>(texture.deviation.size()));
  EXPECT_NEAR(rms / (kNoise / std::sqrt(kStates)), 1, 0.1);  // 1280 elements: 2 %
}

// One draw in 100 exceeds the one-sided limit by chance.
TEST_F(TexturedElements, PlainPaintHasNone) {
  constexpr int kDraws = 20;
  const LightData data = Observe(kStates);
  int plain = 0;
  for (int draw = 0; draw < kDraws; ++draw)
    plain += Estimate(data, Plain()).sigma_of_material[0] == 0 ? 1 : 0;
  EXPECT_GE(plain, kDraws - 1);
}

// A reflectance that is 5 % off moves all elements alike.
TEST_F(TexturedElements, AWrongReflectanceIsNone) {
  const LightData data = Observe(kStates);
  const ElementTexture texture = Estimate(data, Eigen::VectorXd::Constant(ElementCount(), 0.05));
  EXPECT_LT(texture.sigma_of_material[0], kNoise);
}

TEST_F(TexturedElements, OneStateCannotTell) {
  const ElementTexture texture = Estimate(Observe(1), DrawTexture(0.2));
  EXPECT_EQ(texture.sigma_of_material[0], 0);
  EXPECT_EQ(texture.deviation.cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ(texture.sigma.cwiseAbs().maxCoeff(), 0);
}

TEST_F(TexturedElements, RowsThatTheFitLeavesOutTellNothing) {
  const LightData data = Observe(kStates);
  Simulated rows = Simulate(data, DrawTexture(0.2));
  rows.root_weight.tail(rows.root_weight.size() * (kStates - 1) / kStates).setZero();
  const ElementTexture texture =
      TextureEstimator(*room_, data).Estimate(rows.model, rows.measured, rows.root_weight);
  EXPECT_EQ(texture.sigma_of_material[0], 0);
}

TEST_F(TexturedElements, APosterOnPlainPaintStandsAlone) {
  constexpr double kPoster = -0.6;
  const LightData data = Observe(kStates);
  Eigen::VectorXd t = Plain();
  for (int e = 0; e < ElementCount(); e += 10) t[e] = kPoster;
  const ElementTexture texture = Estimate(data, t);
  EXPECT_EQ(texture.sigma_of_material[0], 0);
  int strays = 0;
  for (Eigen::Index i = 0; i < texture.deviation.size(); ++i) {
    if (t[data.observations[static_cast<size_t>(i)].element] == 0) {
      EXPECT_LT(std::abs(texture.deviation[i]), 4 * kNoise);  // a stray by chance is some 3 sigmas off
      strays += texture.sigma[i] > 0 ? 1 : 0;
      continue;
    }
    EXPECT_NEAR(texture.deviation[i] / kPoster, 1, 0.02);
    EXPECT_NEAR(texture.sigma[i], -kPoster / kStraySigmas, 0.02);
  }
  // Of plain elements, 0.3 % are beyond 3 sigmas: 3 of 1152.
  EXPECT_LE(strays / kStates, 12);
}

// Equal weights of all elements shrink every t_e alike, so that the row is their sum.
TEST_F(TexturedElements, TheirMeanIsARowOfZero) {
  constexpr double kTau = 0.1;
  const LightData data = Observe(kStates);
  Eigen::VectorXd t = DrawTexture(kTau);
  t.array() -= t.mean();
  Simulated rows = Simulate(data, t);
  for (Eigen::Index i = 0; i < rows.model.size(); ++i) {
    rows.measured[i] = rows.model[i] * (1 + t[data.observations[static_cast<size_t>(i)].element]);
    rows.root_weight[i] = 1 / (kNoise * rows.model[i]);
  }
  const std::vector<TextureMean> means =
      TextureEstimator(*room_, data).Means(rows.model, rows.root_weight, TextureOf(data, kTau));
  ASSERT_EQ(means.size(), 1u);
  EXPECT_EQ(means[0].terms.size(), data.observations.size());
  EXPECT_NEAR(ValueOf(means[0], rows), 0, 1e-9);
  // With a reflectance that is 1 % off: over the sigma of the mean.
  rows.measured *= 1.01;
  const double sigma = kNoise / std::sqrt(static_cast<double>(data.observations.size()));
  EXPECT_NEAR(std::abs(ValueOf(means[0], rows)) * sigma / 0.01, 1, 0.01);
}

// The mean of 200 squares of sigma 1 has the sigma sqrt(2 / 200) = 0.1.
TEST_F(TexturedElements, TheRowsSigmaIsItsScatter) {
  constexpr int kDraws = 200;
  constexpr double kTau = 0.1;
  const LightData data = Observe(kStates);
  const TextureEstimator estimator(*room_, data);
  double squares = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    Eigen::VectorXd t = DrawTexture(kTau);
    t.array() -= t.mean();
    const Simulated rows = Simulate(data, t);
    const std::vector<TextureMean> means =
        estimator.Means(rows.model, rows.root_weight, TextureOf(data, kTau));
    ASSERT_EQ(means.size(), 1u);
    squares += std::pow(ValueOf(means[0], rows), 2);
  }
  std::printf("mean square of the row: %.3f\n", squares / kDraws);
  EXPECT_NEAR(squares / kDraws, 1, 0.3);
}

TEST_F(TexturedElements, APlainMaterialHasNoMean) {
  const LightData data = Observe(kStates);
  const Simulated rows = Simulate(data, Plain());
  ElementTexture texture = TextureOf(data, 0);
  texture.sigma[0] = 0.2;  // a stray
  EXPECT_TRUE(TextureEstimator(*room_, data).Means(rows.model, rows.root_weight, texture).empty());
}

TEST_F(TexturedElements, PatchesReflectTheMeanOfTheirObservedElements) {
  constexpr int kUnseenPatch = 7;
  LightData data = Observe(kStates, 3);
  const auto is_unseen = [](const Observation& o) {
    return room_->patches.elements[static_cast<size_t>(o.element)].patch == kUnseenPatch;
  };
  data.observations.erase(std::remove_if(data.observations.begin(), data.observations.end(), is_unseen),
                          data.observations.end());
  const Eigen::VectorXd t = DrawTexture(0.2);
  ElementTexture texture = TextureOf(data, 0.2);
  for (Eigen::Index i = 0; i < texture.deviation.size(); ++i)
    texture.deviation[i] = t[data.observations[static_cast<size_t>(i)].element];
  const Eigen::VectorXd factors = TextureEstimator(*room_, data).PatchFactors(*room_, texture);
  ASSERT_EQ(factors.size(), static_cast<Eigen::Index>(room_->patches.patches.size()));
  for (size_t p = 0; p < room_->patches.patches.size(); ++p) {
    const Patch& patch = room_->patches.patches[p];
    double sum = 0;
    int count = 0;
    for (int e = patch.first_element; e < patch.first_element + patch.element_count; ++e) {
      if (e % 3 != 0 && p != kUnseenPatch) sum += t[e], ++count;
    }
    EXPECT_NEAR(factors[static_cast<Eigen::Index>(p)], 1 + sum / std::max(count, 1), 1e-12);
  }
}

TEST_F(TexturedElements, PlainPatchesHaveNoFactors) {
  const LightData data = Observe(kStates);
  const TextureEstimator estimator(*room_, data);
  ElementTexture texture = TextureOf(data, 0.2);
  EXPECT_EQ(estimator.PatchFactors(*room_, texture).size(), 0);
  texture.deviation.setConstant(0.5 * kLeastDeparture);
  EXPECT_EQ(estimator.PatchFactors(*room_, texture).size(), 0);
  texture.deviation.setConstant(2 * kLeastDeparture);
  EXPECT_EQ(estimator.PatchFactors(*room_, texture).size(),
            static_cast<Eigen::Index>(room_->patches.patches.size()));
}

}  // namespace
}  // namespace luxfit
