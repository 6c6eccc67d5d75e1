// Glare of made photos against closed forms: discs of even luminance before an even background.
#include "inverse/control/photo_glare.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

namespace luxfit {
namespace {

// An equidistant fisheye of a whole hemisphere: 200 px a right angle.
Camera Fisheye() {
  Camera camera;
  camera.lens = LensModel::kFisheye;
  camera.width_px = camera.height_px = 401;
  camera.cx_px = camera.cy_px = 200;
  camera.fx_px = camera.fy_px = 200 / (M_PI / 2);
  return camera;
}

Camera Pinhole() {
  Camera camera;
  camera.width_px = 400;
  camera.height_px = 300;
  camera.cx_px = 199.5;
  camera.cy_px = 149.5;
  camera.fx_px = camera.fy_px = 300;
  return camera;
}

struct Disc {
  Eigen::Vector3d direction;  // camera frame
  double half_angle_rad = 0;
  float luminance_cd_m2 = 0;
};

ImagePlane PhotoOf(const PixelField& field, float background_cd_m2, const std::vector<Disc>& discs) {
  ImagePlane photo =
      ImagePlane::Constant(field.solid_angle_sr.rows(), field.solid_angle_sr.cols(), background_cd_m2);
  for (const Disc& disc : discs) {
    for (Eigen::Index i = 0; i < photo.size(); ++i) {
      const double cosine = field.directions.col(i).cast<double>().dot(disc.direction.normalized());
      if (cosine > std::cos(disc.half_angle_rad)) photo.data()[i] = disc.luminance_cd_m2;
    }
  }
  return photo;
}

PhotoGlare Glare(const PixelField& field, const ImagePlane& photo, const PhotoGlareOptions& options = {}) {
  return GlareOfPhoto(photo, PixelMask::Constant(photo.rows(), photo.cols(), false), field, UprightCamera(),
                      options);
}

// The solid angle of a rectangular pyramid; its E of unit luminance is that of a rectangle before the lens.
TEST(PhotoGlare, PixelsOfAPinholeAddUpToItsPyramid) {
  const PixelField field = FieldOf(Pinhole());
  const double a = 200.0 / 300, b = 150.0 / 300;
  const double pyramid = 4 * std::asin(a * b / std::sqrt((1 + a * a) * (1 + b * b)));
  EXPECT_NEAR(field.solid_angle_sr.cast<double>().sum(), pyramid, 1e-4 * pyramid);
  const double x = a / std::sqrt(1 + a * a), y = b / std::sqrt(1 + b * b);
  const double form_factor =
      2 / M_PI * (x * std::atan(b / std::sqrt(1 + a * a)) + y * std::atan(a / std::sqrt(1 + b * b)));
  EXPECT_NEAR(field.coverage, form_factor, 1e-4);
}

// Pixels that the border cuts count whole or not at all.
TEST(PhotoGlare, PixelsOfAFisheyeAddUpToAHemisphere) {
  const PixelField field = FieldOf(Fisheye());
  EXPECT_NEAR(field.solid_angle_sr.cast<double>().sum(), 2 * M_PI, 2e-3 * 2 * M_PI);
  EXPECT_NEAR(field.coverage, 1, 1e-3);
}

TEST(PhotoGlare, AnEvenHemisphereHasItsIlluminanceAndNoGlare) {
  const PixelField field = FieldOf(Fisheye());
  const PhotoGlare glare = Glare(field, PhotoOf(field, 1000, {}));
  ASSERT_TRUE(glare.vertical_lx);
  EXPECT_NEAR(*glare.vertical_lx, M_PI * 1000, 1e-3 * M_PI * 1000);
  EXPECT_TRUE(glare.sources.empty());
  const GlareRating rating = RatingOf(glare);
  EXPECT_FALSE(rating.ugr);
  EXPECT_NEAR(*rating.dgp, 5.87e-5 * M_PI * 1000 + 0.16, 1e-3);
  EXPECT_NEAR(rating.background_cd_m2, 1000, 2);
}

// On the axis p = 1: by hand
//   E_s = pi L sin^2 a,   omega = 2 pi (1 - cos a),   E_v = E_s + pi L_0 cos^2 a,   L_b = L_0 cos^2 a
TEST(PhotoGlare, ADiscOnTheAxisByHand) {
  const PixelField field = FieldOf(Fisheye());
  const double a = 0.2, luminance = 20000, background = 200;
  const PhotoGlare glare = Glare(field, PhotoOf(field, 200, {{{0, 0, 1}, a, 20000}}));
  ASSERT_EQ(glare.sources.size(), 1u);
  const double omega = 2 * M_PI * (1 - std::cos(a)), source_lx = M_PI * luminance * std::pow(std::sin(a), 2);
  // The disc has 2027 pixels: its border is known to some 0.5 % of its area.
  EXPECT_NEAR(glare.sources[0].solid_angle_sr, omega, 0.01 * omega);
  EXPECT_NEAR(glare.sources[0].luminance_cd_m2, luminance, 1e-6 * luminance);
  EXPECT_NEAR(glare.sources[0].illuminance_lx, source_lx, 0.01 * source_lx);
  const double left = background * std::pow(std::cos(a), 2), vertical_lx = source_lx + M_PI * left;
  EXPECT_NEAR(*glare.vertical_lx, vertical_lx, 0.01 * vertical_lx);
  const GlareRating rating = RatingOf(glare);
  const double sum = luminance * luminance * omega;
  EXPECT_NEAR(*rating.ugr, 8 * std::log10(0.25 / left * sum), 0.05);
  EXPECT_NEAR(*rating.dgp,
              5.87e-5 * vertical_lx + 0.0918 * std::log10(1 + sum / std::pow(vertical_lx, 1.87)) + 0.16,
              2e-3);
  EXPECT_EQ(rating.ugr_bound, GlareBound::kValue);
}

// CIE 117-1995, table 4.1: p = 7.00 at H / R = 1, T / R = 0; the formula is within 5 % there (Levin 1975).
TEST(PhotoGlare, ASourceAboveTheAxisHasTheIndexOfTheTable) {
  const PixelField field = FieldOf(Fisheye());
  const PhotoGlare above = Glare(field, PhotoOf(field, 200, {{{0, -1, 1}, 0.05, 20000}}));
  ASSERT_EQ(above.sources.size(), 1u);
  EXPECT_NEAR(above.sources[0].ugr_index, 7.00, 0.06 * 7);
  const PhotoGlare below = Glare(field, PhotoOf(field, 200, {{{0, 1, 1}, 0.05, 20000}}));
  EXPECT_NEAR(below.sources[0].ugr_index, 2.2, 0.02);  // 1 + 1.2 R / D
}

// A camera on its side shows the same room: what is above lies to the photo's right.
TEST(PhotoGlare, AboveIsByThePoseAndNotByThePhoto) {
  const PixelField field = FieldOf(Fisheye());
  const ImagePlane photo = PhotoOf(field, 200, {{{1, 0, 1}, 0.05, 20000}});
  const Eigen::Matrix3d on_its_side =
      UprightCamera() * Eigen::AngleAxisd(-M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const PhotoGlare turned =
      GlareOfPhoto(photo, PixelMask::Constant(photo.rows(), photo.cols(), false), field, on_its_side);
  const PhotoGlare upright = Glare(field, PhotoOf(field, 200, {{{0, -1, 1}, 0.05, 20000}}));
  EXPECT_NEAR(turned.sources.at(0).ugr_index, upright.sources.at(0).ugr_index, 1e-3);
}

TEST(PhotoGlare, NearPixelsAreOneSourceAndFarOnesTwo) {
  const PixelField field = FieldOf(Fisheye());
  const auto sources = [&](double apart_rad, float other_cd_m2) {
    const double half = apart_rad / 2;
    return Glare(field, PhotoOf(field, 200,
                                {{{-std::sin(half), 0, std::cos(half)}, 0.05, 20000},
                                 {{std::sin(half), 0, std::cos(half)}, 0.05, other_cd_m2}}))
        .sources.size();
  };
  EXPECT_EQ(sources(0.16, 20000), 1u);   // 0.06 rad between their borders
  EXPECT_EQ(sources(0.18, 20000), 1u);   // 0.08
  EXPECT_EQ(sources(0.23, 20000), 2u);   // 0.13
  EXPECT_EQ(sources(0.16, 200000), 2u);  // a peak stands alone
}

TEST(PhotoGlare, TheThresholdMayFollowTheMean) {
  const PixelField field = FieldOf(Fisheye());
  const ImagePlane photo = PhotoOf(field, 100, {{{0, 0, 1}, 0.1, 1500}});
  EXPECT_TRUE(Glare(field, photo).sources.empty());
  PhotoGlareOptions options;
  options.threshold_over_mean = 5;
  EXPECT_EQ(Glare(field, photo, options).sources.size(), 1u);
}

// A source outside the photo may glare, too.
TEST(PhotoGlare, APartOfTheFieldTellsOnlyOfItself) {
  const PixelField field = FieldOf(Pinhole());
  const ImagePlane photo = PhotoOf(field, 200, {{{0, 0, 1}, 0.1, 20000}});
  const PhotoGlare seen = Glare(field, photo);
  EXPECT_FALSE(seen.vertical_lx);
  const GlareRating of_seen = RatingOf(seen);
  EXPECT_FALSE(of_seen.dgp);
  EXPECT_EQ(of_seen.ugr_bound, GlareBound::kOfWhatIsSeen);
  EXPECT_NEAR(of_seen.background_cd_m2, 200, 0.1);
  PhotoGlareOptions options;
  options.vertical_lx = 1500;
  const GlareRating given = RatingOf(Glare(field, photo, options));
  EXPECT_EQ(given.ugr_bound, GlareBound::kAtLeast);
  EXPECT_EQ(given.dgp_bound, GlareBound::kAtLeast);
  const double source_lx = M_PI * 20000 * std::pow(std::sin(0.1), 2), left = (1500 - source_lx) / M_PI;
  EXPECT_NEAR(given.background_cd_m2, left, 0.02 * left);
}

TEST(PhotoGlare, ClippedPixelsMakeItABound) {
  const PixelField field = FieldOf(Fisheye());
  const ImagePlane photo = PhotoOf(field, 200, {{{0, 0, 1}, 0.1, 20000}});
  const PhotoGlare glare = GlareOfPhoto(photo, photo > 2000.0f, field, UprightCamera());
  EXPECT_TRUE(glare.sources.at(0).is_clipped);
  EXPECT_FALSE(glare.is_hidden);
  EXPECT_EQ(RatingOf(glare).ugr_bound, GlareBound::kAtLeast);
}

// Who knows how bright pixels are that clip at 1500 cd/m2.
TEST(PhotoGlare, PixelsThatClipBelowTheThresholdHideASource) {
  const PixelField field = FieldOf(Fisheye());
  const ImagePlane photo = PhotoOf(field, 200, {{{0, 0, 1}, 0.1, 20000}, {{-1, 0, 1}, 0.1, 1500}});
  const PhotoGlare glare = GlareOfPhoto(photo, photo > 1000.0f, field, UprightCamera());
  EXPECT_TRUE(glare.is_hidden);
  EXPECT_EQ(glare.sources.size(), 1u);
  EXPECT_FALSE(RatingOf(glare).ugr);
  EXPECT_EQ(RatingOf(glare).dgp_bound, GlareBound::kAtLeast);
}

// UGR goes with 8 log10 of the scale where the photo tells all of its light.
TEST(PhotoGlare, TheScalesErrorIsThatOfAllLight) {
  const PixelField field = FieldOf(Fisheye());
  const PhotoGlare glare = Glare(field, PhotoOf(field, 200, {{{0, 0, 1}, 0.2, 20000}}));
  EXPECT_NEAR(*RatingOf(glare, 1.02).ugr - *RatingOf(glare).ugr, 8 * std::log10(1.02), 1e-9);
}

TEST(PhotoGlare, MistakesAreRefused) {
  const PixelField field = FieldOf(Pinhole());
  EXPECT_THROW(Glare(field, ImagePlane::Constant(3, 3, 1.0f)), std::invalid_argument);
  PhotoGlareOptions options;
  options.threshold_cd_m2 = 0;
  EXPECT_THROW(Glare(field, PhotoOf(field, 200, {}), options), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
