#include "inverse/observe/observe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

// A floor of 12 x 9 m in square elements of 1 m, seen from 10 m straight above its middle: 20 px a metre.
class LookingDown : public testing::Test {
 protected:
  LookingDown() {
    Scene scene;
    support::AddParallelogram(scene, {0, 0, 0}, {8, 0, 0}, {0, 9, 0}, "left");
    support::AddParallelogram(scene, {8, 0, 0}, {4, 0, 0}, {0, 9, 0}, "right");
    room_ = std::make_unique<Room>(MakeRoom(scene, {{1, 1}, {1}}));
    camera_.width_px = 200;
    camera_.height_px = 140;
    camera_.fx_px = camera_.fy_px = 200;
    camera_.cx_px = 99.5;
    camera_.cy_px = 69.5;
    // x right along world x, y down along world -y, z forward along world -z.
    Eigen::Matrix3d rotation;
    rotation << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    cam_from_world_.linear() = rotation;
    cam_from_world_.translation() = -rotation * Eigen::Vector3d(6, 4.5, 10);
  }

  PixelMap Map(const std::vector<PixelQuad>& masked = {}, const PixelMapOptions& options = {}) const {
    return MapPixels(camera_, UnprojectAllPixels(camera_), cam_from_world_, *room_, masked, options);
  }
  int ElementAt(const PixelMap& map, const Eigen::Vector2d& px) const {
    return map.element(static_cast<Eigen::Index>(std::lround(px.y())),
                       static_cast<Eigen::Index>(std::lround(px.x())));
  }
  // By arithmetic of this view, without Project.
  Eigen::Vector2d PixelOf(double x_m, double y_m) const {
    return {99.5 + 20 * (x_m - 6), 69.5 - 20 * (y_m - 4.5)};
  }

  std::unique_ptr<Room> room_;
  Camera camera_;
  Eigen::Isometry3d cam_from_world_ = Eigen::Isometry3d::Identity();
};

TEST_F(LookingDown, PixelsBelongToTheElementTheySee) {
  const PixelMap map = Map();
  int whole = 0;
  for (size_t e = 0; e < room_->patches.elements.size(); ++e) {
    const Eigen::Vector3d& center = room_->patches.elements[e].center;
    // 200 x 140 px see 10 x 7 m: x 1..11, y 1..8.
    if (center.x() < 1 || center.x() > 11 || center.y() < 1 || center.y() > 8) {
      EXPECT_EQ(map.pixels_of_element[e], 0);
      continue;
    }
    ++whole;
    EXPECT_EQ(ElementAt(map, PixelOf(center.x(), center.y())), static_cast<int>(e));
    // 20 x 20 px, without the guard of 2 px along the border between the two facets at x = 8.
    EXPECT_EQ(map.pixels_of_element[e], std::abs(center.x() - 8) < 1 ? 18 * 20 : 20 * 20);
  }
  EXPECT_EQ(whole, 70);
}

TEST_F(LookingDown, PixelsNearAnotherFacetAreLeftOut) {
  PixelMapOptions options;
  options.guard_px = 3;
  const PixelMap map = Map({}, options);
  const int border = static_cast<int>(std::floor(PixelOf(8, 4.5).x()));  // the last pixel of the left facet
  for (int u = border - 6; u <= border + 7; ++u) {
    const bool guarded = u > border - 3 && u <= border + 3;
    EXPECT_EQ(map.element(70, u) < 0, guarded) << u - border;
  }
}

PixelQuad Square(const Eigen::Vector2d& center, double half) {
  using V = Eigen::Vector2d;
  return {V(center + V(-half, -half)), V(center + V(half, -half)), V(center + V(half, half)),
          V(center + V(-half, half))};
}

TEST_F(LookingDown, PixelsUnderAMaskAndRoundItAreLeftOut) {
  // A mask in the middle of the element at (3.5, 4.5): its centroid stays, so it still counts.
  const Eigen::Vector2d center = PixelOf(3.5, 4.5);
  const PixelMap open = Map(), map = Map({Square(center, 3)});
  const int e = ElementAt(open, center);
  EXPECT_EQ(ElementAt(map, center), -1);
  EXPECT_EQ(ElementAt(map, center + Eigen::Vector2d(4, 0)), -1);  // 2 px of guard beyond 3 px of mask
  EXPECT_EQ(ElementAt(map, center + Eigen::Vector2d(6, 0)), e);
  const int left_out =
      open.pixels_of_element[static_cast<size_t>(e)] - map.pixels_of_element[static_cast<size_t>(e)];
  // The mask covers 6 x 6 px and its guard widens that to 10 x 10; probes at eight points may miss its very
  // corners.
  EXPECT_LE(left_out, 100);
  EXPECT_GE(left_out, 36 + 4 * 2 * 6);
  PixelQuad backwards = Square(center, 3);
  std::reverse(backwards.begin(), backwards.end());
  EXPECT_TRUE((Map({backwards}).element == map.element).all());  // corners may run either way round
}

TEST_F(LookingDown, AnElementSeenOnOneSideOnlyIsLeftOut) {
  // Covers the left 12 of 20 px: the mean of the rest lies 0.3 to 0.35 m off, above the tolerance of 0.2.
  const Eigen::Vector2d center = PixelOf(3.5, 4.5);
  const std::vector<PixelQuad> mask = {Square(center + Eigen::Vector2d(-8, 0), 10.2)};
  const size_t e = static_cast<size_t>(ElementAt(Map(), center));
  EXPECT_EQ(Map(mask).pixels_of_element[e], 0);
  EXPECT_FALSE((Map(mask).element == static_cast<int>(e)).any());
  PixelMapOptions generous;
  generous.centroid_tolerance = 0.4;
  EXPECT_GT(Map(mask, generous).pixels_of_element[e], 0);
}

TEST_F(LookingDown, TooFewPixelsAreLeftOut) {
  PixelMapOptions options;
  options.min_pixels = 400;
  EXPECT_GT(Map({}, options).pixels_of_element[static_cast<size_t>(ElementAt(Map(), PixelOf(3.5, 4.5)))], 0);
  options.min_pixels = 401;
  EXPECT_EQ((Map({}, options).element >= 0).count(), 0);
}

TEST_F(LookingDown, BacksAreNotSeen) {
  cam_from_world_.linear() << 1, 0, 0, 0, 1, 0, 0, 0, 1;  // from below, looking up
  cam_from_world_.translation() = -Eigen::Vector3d(6, 4.5, -10);
  EXPECT_EQ((Map().element >= 0).count(), 0);
}

LuminanceImage ConstantPhoto(int height, int width, float luminance) {
  LuminanceImage photo;
  photo.relative_luminance = ImagePlane::Constant(height, width, luminance);
  for (ImagePlane& channel : photo.relative_rgb) channel = photo.relative_luminance;
  photo.valid = PixelMask::Constant(height, width, true);
  photo.saturated = PixelMask::Constant(height, width, false);
  return photo;
}

TEST_F(LookingDown, MeanAndVarianceOfANoisyPhoto) {
  constexpr double kMean = 0.4, kSigma = 0.02;
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<float> noise(0, static_cast<float>(kSigma));
  LuminanceImage photo = ConstantPhoto(140, 200, static_cast<float>(kMean));
  for (float& y : photo.relative_luminance.reshaped()) y += noise(rng);
  const PixelMap map = Map();
  const std::vector<Observation> observations = ObservePhoto(map, photo, 3, 1);
  ASSERT_EQ(observations.size(), 70u);
  double chi2 = 0;
  for (const Observation& o : observations) {
    EXPECT_EQ(o.view, 3);
    EXPECT_EQ(o.state, 1);
    EXPECT_EQ(o.pixels, map.pixels_of_element[static_cast<size_t>(o.element)]);
    const double expected = kSigma * kSigma / o.pixels;
    // A variance from n >= 360 pixels has a relative sigma of sqrt(2 / n) = 7.5 %; 70 of them: 4 sigma.
    EXPECT_NEAR(o.variance / expected, 1, 0.3);
    chi2 += std::pow(o.relative_luminance - kMean, 2) / expected;
  }
  EXPECT_NEAR(chi2, 70, 4 * std::sqrt(2 * 70));  // chi-square of 70 degrees of freedom, 4 sigma
}

TEST_F(LookingDown, AnElementPartlyInvalidIsLeftOut) {
  const PixelMap map = Map();
  const Eigen::Vector2d center = PixelOf(3.5, 4.5);
  const int e = ElementAt(map, center);
  const auto is_observed = [&](int invalid_rows) {
    LuminanceImage photo = ConstantPhoto(140, 200, 0.4f);
    photo.valid
        .block(static_cast<Eigen::Index>(center.y() - 9.5), static_cast<Eigen::Index>(center.x() - 9.5),
               invalid_rows, 20)
        .setConstant(false);
    for (const Observation& o : ObservePhoto(map, photo, 0, 0)) {
      if (o.element == e) return o.pixels == 400 - 20 * invalid_rows;
    }
    return false;
  };
  EXPECT_TRUE(is_observed(1));   // 5 % of its pixels: still the same mean
  EXPECT_FALSE(is_observed(4));  // 20 %: what is left lies to one side, or is the edge of something bright
}

TEST(ThinElements, KeepsAllStatesOfEvenlyTakenElements) {
  std::vector<Observation> all;
  for (int state = 0; state < 3; ++state) {
    for (int e = 0; e < 100; ++e) {
      Observation o;
      o.element = e;
      o.state = state;
      all.push_back(o);
    }
  }
  const std::vector<Observation> thin = ThinElements(all, 25);
  ASSERT_EQ(thin.size(), 75u);
  for (size_t i = 0; i < thin.size(); ++i) {  // order is kept, every fourth element
    EXPECT_EQ(thin[i].element, static_cast<int>(4 * (i % 25)));
    EXPECT_EQ(thin[i].state, static_cast<int>(i / 25));
  }
  EXPECT_EQ(ThinElements(all, 1000).size(), all.size());
}

}  // namespace
}  // namespace luxfit
