// A matt ceiling of 400 elements under three luminaires of one height: closed forms, with 1 % of scatter between views.
#include "inverse/observe/as_if/photos_as_if.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr int kSide = 20, kStates = 3;

Patches Ceiling() {
  Patches patches;
  patches.elements.resize(kSide * kSide);
  for (int i = 0; i < kSide * kSide; ++i) {
    Element& element = patches.elements[static_cast<size_t>(i)];
    element.center = {0.2 * (i % kSide), 0.2 * (i / kSide), 3};
    element.patch = (i % kSide) / 4 + (kSide / 4) * (i / kSide / 4);
  }
  return patches;
}

// Illuminance of a Lambertian luminaire that faces the ceiling from 2 m below: h^2 / (h^2 + d^2)^2.
double Light(const Element& element, int state) {
  const double h = 2, x = element.center.x() - (0.5 + 1.3 * state), y = element.center.y() - 2;
  return h * h / std::pow(h * h + x * x + y * y, 2);
}

std::vector<Observation> Photos(int views) {
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<double> normal;
  const Patches ceiling = Ceiling();
  std::vector<Observation> observations;
  for (int v = 0; v < views; ++v) {
    for (int s = 0; s < kStates; ++s) {
      const double gain = std::exp(0.2 * normal(rng));  // its exposure's error
      for (int e = 0; e < kSide * kSide; ++e) {
        Observation o;
        o.element = e;
        o.view = v;
        o.state = s;
        o.relative_luminance =
            gain * Light(ceiling.elements[static_cast<size_t>(e)], s) * (1 + 0.01 * normal(rng));
        o.variance = std::pow(0.002 * o.relative_luminance, 2);
        observations.push_back(o);
      }
    }
  }
  return observations;
}

std::vector<Observation> Exchanged(std::vector<Observation> observations, int view, int a, int b) {
  for (Observation& o : observations)
    if (o.view == view) o.state = o.state == a ? b : (o.state == b ? a : o.state);
  return observations;
}

TEST(PhotosAsIf, RightPhotosAreLeftAlone) {
  EXPECT_TRUE(FindPhotosAsIf(Ceiling(), Photos(4)).empty());
  EXPECT_TRUE(FindPhotosAsIf(Ceiling(), {}).empty());
}

TEST(PhotosAsIf, ExchangedPhotosOfAViewAreNamed) {
  const std::vector<PhotoAsIf> found = FindPhotosAsIf(Ceiling(), Exchanged(Photos(4), 1, 0, 2));
  ASSERT_EQ(found.size(), 2u);
  for (const PhotoAsIf& photo : found) {
    EXPECT_EQ(photo.view, 1);
    EXPECT_EQ(photo.state + photo.as_if, 2);
    EXPECT_TRUE(photo.is_exchanged);
    EXPECT_LT(photo.difference_as_if, 0.015);  // 1 % of its own, a half of that of the median of three
    EXPECT_GT(photo.difference, 0.1);
  }
}

TEST(PhotosAsIf, OfTwoViewsNobodyKnowsWhichIsWrong) {
  EXPECT_TRUE(FindPhotosAsIf(Ceiling(), Exchanged(Photos(2), 1, 0, 2)).empty());
}

TEST(PhotosAsIf, StatesThatDifferByAFactorAreOne) {
  const Patches ceiling = Ceiling();
  std::vector<Observation> observations = Photos(4);
  for (Observation& o : observations) {
    if (o.state == 2) o.relative_luminance = 0.5 * Light(ceiling.elements[static_cast<size_t>(o.element)], 0);
  }
  EXPECT_TRUE(FindPhotosAsIf(Ceiling(), Exchanged(observations, 1, 0, 2)).empty());
}

constexpr double kExposure = 2;  // counts half of full scale where the light is most, 0.25

CountedShares AllCounted(int views) {
  CountedShares shares;
  for (int v = 0; v < views; ++v)
    for (int s = 0; s < kStates; ++s) shares[{v, s}] = kExposure;
  return shares;
}

// Light from neutral to reddish, element by element: channels are encoded, not their sum.
std::vector<Observation> Coloured(std::vector<Observation> observations) {
  const Eigen::Vector3d weights = LuminanceOptions().weights;
  for (Observation& o : observations) {
    const Eigen::Vector3d colour(1, 1 - 0.001 * o.element, 1 - 0.0015 * o.element);
    o.relative_rgb = o.relative_luminance / weights.dot(colour) * colour;
  }
  return observations;
}

// IEC 61966-2-1.
std::vector<Observation> EncodedInSrgb(std::vector<Observation> observations, int view, int state) {
  for (Observation& o : observations) {
    if (o.view != view || o.state != state) continue;
    for (double& y : o.relative_rgb) {
      const double x = kExposure * y;
      y = (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055) / kExposure;
    }
    const double luminance = LuminanceOptions().weights.dot(o.relative_rgb);
    o.variance *= std::pow(luminance / o.relative_luminance, 2);
    o.relative_luminance = luminance;
  }
  return observations;
}

TEST(PhotosAsIf, APhotoEncodedInSrgbAmongLinearOnesIsNamed) {
  const std::vector<Observation> right = Coloured(Photos(4));
  EXPECT_TRUE(FindPhotosAsIf(Ceiling(), right, AllCounted(4)).empty());
  const std::vector<PhotoAsIf> found = FindPhotosAsIf(Ceiling(), EncodedInSrgb(right, 2, 1), AllCounted(4));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].is_srgb);
  EXPECT_EQ(found[0].view, 2);
  EXPECT_EQ(found[0].state, 1);
  EXPECT_EQ(found[0].as_if, 1);
  EXPECT_LT(found[0].difference_as_if, 0.015);  // as of exchanged photos
  EXPECT_GT(found[0].difference, 0.1);
}

TEST(PhotosAsIf, AnotherStateIsNoEncoding) {
  const std::vector<PhotoAsIf> found =
      FindPhotosAsIf(Ceiling(), Exchanged(Coloured(Photos(4)), 1, 0, 2), AllCounted(4));
  ASSERT_EQ(found.size(), 2u);
  for (const PhotoAsIf& photo : found) EXPECT_TRUE(photo.is_exchanged && !photo.is_srgb);
}

// A curve of its own, a photo of which nothing is said, and two views: nothing tells of sRGB.
TEST(PhotosAsIf, WithoutEvidenceNoEncodingIsNamed) {
  const std::vector<Observation> encoded = EncodedInSrgb(Coloured(Photos(4)), 2, 1);
  EXPECT_TRUE(FindPhotosAsIf(Ceiling(), encoded).empty());
  EXPECT_TRUE(FindPhotosAsIf(Ceiling(), EncodedInSrgb(Coloured(Photos(2)), 1, 1), AllCounted(2)).empty());
  std::vector<Observation> squared = Coloured(Photos(4));
  for (Observation& o : squared) {
    if (o.view != 2 || o.state != 1) continue;
    o.relative_rgb *= o.relative_luminance;
    o.variance *= 4 * o.relative_luminance * o.relative_luminance;
    o.relative_luminance *= o.relative_luminance;
  }
  EXPECT_TRUE(FindPhotosAsIf(Ceiling(), squared, AllCounted(4)).empty());
}

TEST(PhotosAsIf, OtherPhotosRemain) {
  const std::vector<Observation> observations = Photos(3);
  const std::vector<Observation> rest = WithoutPhotos(observations, {{1, 2, 0, false, 0, 0}});
  EXPECT_EQ(rest.size(), observations.size() - kSide * kSide);
  for (const Observation& o : rest) EXPECT_FALSE(o.view == 1 && o.state == 2);
}

}  // namespace
}  // namespace luxfit
