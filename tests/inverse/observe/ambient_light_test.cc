#include "inverse/observe/ambient_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr int kAmbientViews = 6, kLitElements = 300;
constexpr double kPhotoNoise = 0.004;
enum AmbientState { kOff, kOne, kOther };
const std::vector<Eigen::VectorXd> kDimmings{Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0),
                                             Eigen::Vector2d(0, 1)};

// Elements that formulas light: what luminaires give is no model's.
class Ambient : public testing::Test {
 protected:
  using Share = std::function<double(int view, int state)>;

  Ambient() {
    for (int e = 0; e < kLitElements; ++e) {
      Patch patch;
      patch.center = patch.origin = patch.edge_u = patch.edge_v = Eigen::Vector3d::Zero();
      patch.first_element = e;
      patch.element_count = 1;
      patches_.patches.push_back(patch);
      Element element;
      element.center = element.normal = element.origin = element.edge_u = element.edge_v =
          Eigen::Vector3d::Zero();
      element.patch = e;
      patches_.elements.push_back(element);
    }
  }

  static double Daylight(int element) { return 0.3 + 0.25 * std::sin(0.05 * element); }
  static double Luminaires(int element, int state) {
    if (state == kOff) return 0;
    return 0.5 + 0.3 * std::sin(0.031 * element * (state + 1) + state);
  }

  // Each view sees three fifths, and a tenth of them shows something else. `has_off`: by view.
  std::vector<Observation> Photograph(const Share& share, const std::function<bool(int view)>& has_off) {
    std::normal_distribution<double> noise(0, kPhotoNoise);
    std::vector<Observation> observations;
    for (int e = 0; e < kLitElements; ++e)
      for (int view = 0; view < kAmbientViews; ++view) {
        if ((e + 2 * view) % 5 > 2) continue;
        const double other = (e + view) % 10 == 0 ? 0.6 : 1;
        for (int state = kOff; state <= kOther; ++state) {
          if (state == kOff && !has_off(view)) continue;
          Observation o;
          o.element = e;
          o.view = view;
          o.state = state;
          o.relative_luminance =
              other * (Luminaires(e, state) + share(view, state) * Daylight(e)) * (1 + noise(rng_));
          o.variance = std::pow(kPhotoNoise * o.relative_luminance, 2);
          o.relative_rgb.setConstant(o.relative_luminance);
          observations.push_back(o);
        }
      }
    return observations;
  }

  AmbientLight Estimated(
      const Share& share, const std::function<bool(int view)>& has_off = [](int) { return true; }) {
    return EstimateAmbientLight(patches_, Photograph(share, has_off), kDimmings);
  }

  Patches patches_;
  std::mt19937_64 rng_ = support::TestRng();
};

TEST_F(Ambient, SteadyLightNeedsNoShares) {
  const AmbientLight light = Estimated([](int, int) { return 0.8; });
  EXPECT_TRUE(light.share.empty());
  EXPECT_EQ(light.ShareOf(0, kOne), 1);
  EXPECT_LT(light.spread, 0.003);
  EXPECT_NEAR((light.off.at({0, 1}).relative_luminance) / (0.8 * Daylight(1)), 1, 5 * kPhotoNoise);
}

// The part that all photos of a state have in common is the fit's to find.
TEST_F(Ambient, SharesOfPhotosComeOutUpToWhatIsCommonToAState) {
  const Share share = [](int view, int state) { return 1 + 0.3 * std::sin(3.1 * view + 2.3 * state); };
  const AmbientLight light = Estimated(share);
  ASSERT_FALSE(light.share.empty());
  EXPECT_LT(light.score_of_shares, 0.75 * light.score_of_ones);
  for (const int state : {kOne, kOther}) {
    // All of it in one unit: of the light that the off photos show, each over its own.
    double common = 0, worst = 0;
    for (int view = 0; view < kAmbientViews; ++view)
      common += (light.ShareOf(view, state) * share(view, kOff) - share(view, state)) / kAmbientViews;
    for (int view = 0; view < kAmbientViews; ++view)
      worst = std::max(
          worst, std::abs(light.ShareOf(view, state) * share(view, kOff) - share(view, state) - common));
    EXPECT_LT(worst, 0.02) << state;
  }
  EXPECT_NEAR(light.spread, 0.21, 0.05);
}

TEST_F(Ambient, AViewWithoutAPhotoTakesTheOthers) {
  const AmbientLight light = Estimated([](int, int) { return 1.0; }, [](int view) { return view != 2; });
  int compared = 0;
  for (int e = 0; e < kLitElements; ++e) {
    const auto off = light.off.find({2, e});
    if (off == light.off.end() || e % 10 == 0) continue;
    bool is_clean = true;  // of the views that show something else there
    for (int view = 0; view < kAmbientViews; ++view) is_clean = is_clean && (e + view) % 10 != 0;
    if (!is_clean) continue;
    EXPECT_NEAR(off->second.relative_luminance / Daylight(e), 1, 0.02) << e;
    EXPECT_GT(off->second.variance, 0);
    ++compared;
  }
  EXPECT_GT(compared, 30);
  for (const int state : {kOne, kOther}) EXPECT_NEAR(light.ShareOf(2, state), 1, 0.03);
}

TEST_F(Ambient, WithoutOffPhotosThereIsNone) {
  const AmbientLight light = Estimated([](int, int) { return 1.0; }, [](int) { return false; });
  EXPECT_TRUE(light.off.empty());
  EXPECT_EQ(light.spread, 0);
}

}  // namespace
}  // namespace luxfit
