#include "apps/stages/linearize/linearize.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <random>

#include "apps/stages/observe/observed_light.h"
#include "apps/stages/session_light.h"
#include "tests/support/calib/camera_model.h"
#include "tests/support/calib/test_dng.h"
#include "tests/support/inverse/wall_photos.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr int kWidth = 160, kHeight = 120;

// A session of one camera in a folder of its own, whose photos a camera model shoots.
class LinearizeTest : public testing::Test {
 protected:
  LinearizeTest() : scene_(support::LogRamp(kHeight, kWidth, 2e-3, 3)) {
    folder_.Write("cam0.yaml", "%YAML:1.0\n");
    context_.out = folder_.Path("out");
  }

  // Photo `name`, of an exposure that the camera took.
  void Shoot(const std::string& name, double exposure_s) {
    const Photo photo = support::Shoot(model_, scene_, exposure_s, rng_);
    cv::Mat image(kHeight, kWidth, model_.bits == 8 ? CV_8UC3 : CV_16UC3);
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) {
        for (int c = 0; c < 3; ++c) {
          const float count = photo.rgb_counts[static_cast<size_t>(2 - c)](v, u);
          if (model_.bits == 8) {
            image.at<cv::Vec3b>(v, u)[c] = static_cast<unsigned char>(count);
          } else {
            image.at<cv::Vec3w>(v, u)[c] = static_cast<unsigned short>(count);
          }
        }
      }
    }
    cv::imwrite(folder_.Path(name), image);
  }

  void WriteSession(const std::string& camera_keys, const std::string& rows,
                    const std::string& states = "on = { A = 1 }", const std::string& rest = "") {
    folder_.Write("session.toml", "[[camera]]\nid = \"cam0\"\nintrinsics = \"cam0.yaml\"\n" + camera_keys +
                                      "\n[photos]\ntable = \"photos.csv\"\n[states]\n" + states + "\n" +
                                      rest);
    folder_.Write("photos.csv", "file,camera,view,state,exposure_s,aperture,iso\n" + rows);
  }

  LinearizedPhotos Linearized() {
    return LinearizeSession(ReadSession(folder_.Path("session.toml")), context_).photos;
  }

  std::string Refusal() {
    try {
      Linearized();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  LuminanceImage Luminance(const LinearizedPhotos& linearized, size_t photo = 0) const {
    Camera camera;
    camera.width_px = kWidth;
    camera.height_px = kHeight;
    return ReadLuminance(linearized, linearized.photos[photo], camera);
  }

  std::vector<std::string> WarningCodes() const {
    std::vector<std::string> codes;
    for (const Warning& warning : context_.warnings) codes.push_back(warning.code);
    return codes;
  }

  TempFolder folder_;
  support::CameraModel model_;
  std::array<ImagePlane, 3> scene_;
  std::mt19937_64 rng_{7};
  RunContext context_;
};

TEST_F(LinearizeTest, PlainPhotosStayAsTheyAre) {
  Shoot("a.png", 0.25);
  Shoot("b.png", 0.25);
  WriteSession("", "a.png,cam0,v0,on,0.25,,\nb.png,cam0,v1,on,0.25,,\n");
  const LinearizedPhotos linearized = Linearized();
  ASSERT_THAT(linearized.photos, SizeIs(2));
  for (const LinearizedPhoto& photo : linearized.photos) {
    ASSERT_THAT(photo.bracket, SizeIs(1));
    EXPECT_EQ(photo.bracket[0].relative_exposure_s, 0.25);
  }
  EXPECT_THAT(context_.warnings, IsEmpty());
  EXPECT_THAT(context_.choices, IsEmpty());
  const LuminanceImage image = Luminance(linearized),
                       direct = ToRelativeLuminance(ReadPhoto(folder_.Path("a.png")), 0.25);
  EXPECT_TRUE((image.relative_luminance == direct.relative_luminance).all());
  EXPECT_TRUE((image.valid == direct.valid).all());
  EXPECT_EQ(image.variance.size(), 0);
  EXPECT_THAT(folder_.Read("out/stages/linearize.json"), HasSubstr("luxfit-linearize-1"));
}

// As a raw converter with another white level writes them: counts end at 20 000 of 65 535.
TEST_F(LinearizeTest, CountsCutOffBelowFullScaleAreSaturated) {
  model_.full_scale_counts = 20000;
  std::string rows;
  for (const char* exposure : {"0.5", "1", "2"}) {
    const std::string name = std::string("v") + exposure;
    Shoot(name + ".png", std::stod(exposure));
    rows += name + ".png,cam0," + name + ",on," + exposure + ",,\n";
  }
  WriteSession("", rows);
  const LinearizedPhotos linearized = Linearized();
  ASSERT_THAT(WarningCodes(), ElementsAre("counts_cut_off"));
  EXPECT_THAT(context_.warnings[0].message,
              HasSubstr("3 photos of camera cam0 end at one largest count, 20000"));
  const LuminanceImage image = Luminance(linearized, 2);
  const Photo counts = ReadPhoto(folder_.Path("v2.png"));
  EXPECT_TRUE(image.saturated.any() && image.valid.any());
  EXPECT_FALSE((image.valid && counts.rgb_counts[1] >= 0.97f * 20000).any());
  EXPECT_TRUE((image.saturated || counts.rgb_counts[1] < 0.97f * 20000).all());
}

TEST_F(LinearizeTest, RowsOfOneViewAndStateAreMerged) {
  std::string rows;
  for (const double exposure : {0.125, 4.0, 0.5}) {
    const std::string name = "e" + std::to_string(exposure) + ".png";
    Shoot(name, exposure);
    rows += name + ",cam0,v0,on," + std::to_string(exposure) + ",,\n";
  }
  WriteSession("", rows);
  const LinearizedPhotos linearized = Linearized();
  ASSERT_THAT(linearized.photos, SizeIs(1));
  ASSERT_THAT(linearized.photos[0].bracket, SizeIs(3));
  EXPECT_THAT(linearized.photos[0].file, HasSubstr("e4.0"));
  EXPECT_THAT(context_.warnings, IsEmpty());
  const LuminanceImage image = Luminance(linearized);
  ASSERT_TRUE(image.valid.all());
  // Column means of 120 pixels; the darkest has 160 electrons of noise 13.
  for (int u = 0; u < kWidth; ++u)
    EXPECT_NEAR(image.relative_luminance.col(u).mean() / scene_[0](0, u), 1, 0.03) << u;
}

TEST_F(LinearizeTest, AnExposureThatLiesIsNamedAndCorrected) {
  const std::vector<double> taken{4, 1, 0.5, 0.0625}, stated{4, 1, 0.25, 0.0625};
  std::string rows;
  for (size_t i = 0; i < taken.size(); ++i) {
    const std::string name = "e" + std::to_string(i) + ".png";
    Shoot(name, taken[i]);
    rows += name + ",cam0,v0,on," + std::to_string(stated[i]) + ",,\n";
  }
  WriteSession("", rows);
  const LinearizedPhotos linearized = Linearized();
  ASSERT_THAT(WarningCodes(), ElementsAre("exposure_metadata"));
  EXPECT_THAT(context_.warnings[0].message, HasSubstr("photos.csv:4 (e2.png)"));
  EXPECT_THAT(context_.warnings[0].message, HasSubstr("ISO"));
  for (const PhotoExposure& exposure : linearized.photos[0].bracket) {
    const size_t i = static_cast<size_t>(exposure.line - 2);
    EXPECT_NEAR(exposure.relative_exposure_s / taken[i], 1, 0.01) << i;
  }
}

TEST_F(LinearizeTest, IsoAndApertureCount) {
  Shoot("a.png", 0.25);
  Shoot("b.png", 0.25);
  WriteSession("", "a.png,cam0,v0,on,0.25,4,100\nb.png,cam0,v1,on,0.25,5.6,200\n");
  const LinearizedPhotos linearized = Linearized();
  EXPECT_DOUBLE_EQ(linearized.photos[0].bracket[0].relative_exposure_s, 0.25);
  EXPECT_NEAR(linearized.photos[1].bracket[0].relative_exposure_s, 0.25 * 2 * std::pow(4 / 5.6, 2), 1e-12);
}

TEST_F(LinearizeTest, SettingsKnownOfSomePhotosOnlyAreWarnedOf) {
  Shoot("a.png", 0.25);
  Shoot("b.png", 0.25);
  WriteSession("", "a.png,cam0,v0,on,0.25,4,100\nb.png,cam0,v1,on,0.25,4,\n");
  Linearized();
  ASSERT_THAT(WarningCodes(), ElementsAre("exposure_incomplete"));
  EXPECT_THAT(context_.warnings[0].message, HasSubstr("iso is known of 1 of the 2 photos"));
}

TEST_F(LinearizeTest, TimesThatTheTableLeavesOutComeFromThePhoto) {
  support::TestDng dng;
  dng.width_px = kWidth;
  dng.height_px = kHeight;
  dng.counts.assign(static_cast<size_t>(kWidth) * kHeight, 3000);
  dng.black = {500, 500, 500, 500};
  dng.white = 15500;
  dng.exposure_s = {1, 8};
  support::WriteTestDng(folder_.Path("a.dng"), dng);
  WriteSession("", "a.dng,cam0,v0,on,,,\n");
  const LinearizedPhotos linearized = Linearized();
  EXPECT_DOUBLE_EQ(linearized.photos[0].bracket[0].relative_exposure_s, 0.125);
  EXPECT_NEAR(Luminance(linearized).relative_luminance(5, 5), 2500.0 / 15000 / 0.125, 1e-5);
  EXPECT_THAT(context_.warnings, IsEmpty());

  WriteSession("", "a.dng,cam0,v0,on,0.5,,\n");
  Linearized();
  ASSERT_THAT(WarningCodes(), ElementsAre("exposure_metadata"));
  EXPECT_THAT(context_.warnings[0].message,
              HasSubstr("exposure_s is 0.5 in the table and 0.125 in the photo's own"));

  WriteSession("black_level = 500", "a.dng,cam0,v0,on,0.125,,\n");
  const LinearizedPhotos with_black = Linearized();
  EXPECT_THROW(Luminance(with_black), std::runtime_error);
}

TEST_F(LinearizeTest, ATimeThatNobodyStatesIsAskedFor) {
  Shoot("a.png", 0.25);
  WriteSession("", "a.png,cam0,v0,on,,,\n");
  EXPECT_THAT(Refusal(), HasSubstr("photos.csv:2: exposure_s: expected the exposure time in s"));
}

TEST_F(LinearizeTest, AnEstimatedResponseServesAgainAsAFile) {
  model_.bits = 8;
  model_.full_scale_counts = 255;
  model_.response = support::SrgbEncoded;
  std::string rows;
  for (const double exposure : {8.0, 4.0, 2.0, 1.0, 0.5, 0.25, 0.125}) {
    const std::string name = "e" + std::to_string(exposure) + ".png";
    Shoot(name, exposure);
    rows += name + ",cam0,v0,on," + std::to_string(exposure) + ",,\n";
  }
  WriteSession("response = \"estimate\"", rows);
  const LinearizedPhotos estimated = Linearized();
  ASSERT_THAT(context_.choices, SizeIs(1));
  EXPECT_EQ(context_.choices[0].what, "response of cam0");
  const LuminanceImage image = Luminance(estimated);
  // Up to one factor: ratios of columns to the middle one.
  const auto ratio_error = [&](const LuminanceImage& of) {
    double worst = 0;
    const double middle = of.relative_luminance.col(80).mean() / scene_[0](0, 80);
    for (int u = 20; u < kWidth; ++u)
      worst = std::max(worst, std::abs(of.relative_luminance.col(u).mean() / scene_[0](0, u) / middle - 1));
    return worst;
  };
  EXPECT_LT(ratio_error(image), 0.03);

  std::filesystem::copy_file(folder_.Path("out/response_cam0.csv"), folder_.Path("curve.csv"));
  WriteSession("response = \"curve.csv\"", rows);
  context_ = {};
  context_.out = folder_.Path("out");
  EXPECT_LT(ratio_error(Luminance(Linearized())), 0.03);
}

// A maker's bend of sRGB, from a pair of exposures.
TEST_F(LinearizeTest, TwoExposuresOfAViewTellTheCurve) {
  model_.bits = 8;
  model_.full_scale_counts = 255;
  model_.response = [](double light) { return support::SrgbEncoded(std::pow(light, 0.9)); };
  Shoot("a.png", 1);
  Shoot("b.png", 0.5);
  WriteSession("response = \"estimate\"", "a.png,cam0,v0,on,1,,\nb.png,cam0,v0,on,0.5,,\n");
  const LuminanceImage image = Luminance(Linearized());
  ASSERT_THAT(context_.choices, SizeIs(1));
  EXPECT_EQ(context_.choices[0].chosen, "sRGB to a power");
  const double first = image.relative_luminance.col(20).mean() / scene_[0](0, 20);
  for (int u = 20; u < kWidth; u += 10)
    EXPECT_NEAR(image.relative_luminance.col(u).mean() / scene_[0](0, u) / first, 1, 0.03) << u;
}

TEST_F(LinearizeTest, AResponseThatNothingDeterminesIsRefusedWithTheRemedy) {
  model_.bits = 8;
  model_.full_scale_counts = 255;
  Shoot("a.png", 1);
  WriteSession("response = \"estimate\"", "a.png,cam0,v0,on,1,,\n");
  EXPECT_THAT(Refusal(), HasSubstr("camera[0].response: expected photos that determine it"));
  EXPECT_THAT(Refusal(), HasSubstr("two exposures"));
}

TEST_F(LinearizeTest, AFlatFieldTakesVignettingAway) {
  const auto transmission = [](int v, int u) {
    return static_cast<float>(support::NaturalVignetting(
        std::hypot(u - (kWidth - 1) / 2.0, v - (kHeight - 1) / 2.0) / (std::hypot(kWidth, kHeight) / 2),
        0.6));
  };
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      for (ImagePlane& plane : scene_) plane(v, u) = 0.8f * transmission(v, u);
    }
  }
  Shoot("flat.png", 1);
  for (ImagePlane& plane : scene_) plane *= 0.5f;
  Shoot("a.png", 1);
  WriteSession("vignetting = \"flat.png\"", "a.png,cam0,v0,on,1,,\n");
  const LuminanceImage image = Luminance(Linearized());
  for (const auto& [v, u] : {std::pair(0, 0), std::pair(50, 70), std::pair(100, 140)})
    EXPECT_NEAR(image.relative_luminance.block(v, u, 20, 20).mean() / 0.4, 1, 0.01) << v;
}

TEST_F(LinearizeTest, AmbientReadingsAreSubtractedWhereTheyWereTaken) {
  folder_.Write("luxmeter.csv",
                "id,x_m,y_m,z_m,nx,ny,nz,state,lux\n"
                "L1,1,2,0.75,0,0,1,on,320\nL1,1,2,0.75,0,0,1,off,20\nL2,1,3,0.75,0,0,1,on,200\n");
  Shoot("a.png", 1);
  WriteSession("", "a.png,cam0,v0,on,1,,\n", "on = { A = 1 }\noff = {}",
               "[luxmeter]\nreadings = \"luxmeter.csv\"\n");
  const std::vector<LuminaireReading> readings =
      LinearizeSession(ReadSession(folder_.Path("session.toml")), context_).readings;
  ASSERT_THAT(readings, SizeIs(2));
  EXPECT_EQ(readings[0].illuminance_lx, 300);
  EXPECT_EQ(readings[0].ambient_lx, 20);
  EXPECT_EQ(readings[0].given.illuminance_lx, 320);
  EXPECT_EQ(readings[1].illuminance_lx, 200);
  ASSERT_THAT(WarningCodes(), ElementsAre("ambient_in_readings"));
  EXPECT_THAT(context_.warnings[0].message, HasSubstr("L2"));
}

// The wall's photos, named by a session.
class ObservedLightTest : public LinearizeTest {
 protected:
  ObservedLightTest() {
    std::string rows;
    for (const RegisteredView& view : wall_.views) {
      folder_.Write(view.view + ".png", "");
      rows += view.view + ".png,cam0," + view.view + ",on,0.25,,\n";
    }
    WriteSession("vignetting = \"estimate\"", rows);
    session_ = ReadSession(folder_.Path("session.toml"));
    RunContext quiet = context_;
    photos_ = MakeBrackets(session_, session_.photos, quiet);
    registered_.cameras = {wall_.camera};
    registered_.registration.views = wall_.views;
  }

  std::vector<Observation> Calibrated(bool vignetted, const std::vector<double>& exposure_factor) {
    nlohmann::json artifact;
    return WithSelfCalibration(session_, photos_, registered_, wall_.patches, {},
                               wall_.Observe(vignetted, exposure_factor, rng_), context_, artifact);
  }

  support::WallPhotos wall_;
  Session session_;
  LinearizedPhotos photos_;
  RegisteredSession registered_;
};

TEST_F(ObservedLightTest, VignettingThatIsAskedForIsNoWarning) {
  Calibrated(true, {1, 1.01, 0.99, 1.005, 1, 0.995, 1.01, 0.99});
  EXPECT_THAT(context_.warnings, IsEmpty());
  EXPECT_THAT(context_.choices, SizeIs(1));
}

TEST_F(ObservedLightTest, OnlyThePhotoThatLiesIsNamed) {
  std::vector<double> factors(8, 1.0);
  Calibrated(false, factors);
  EXPECT_THAT(context_.warnings, IsEmpty());
  EXPECT_EQ(context_.choices.at(0).chosen, "as recorded");
  factors[3] = 2;
  const auto corrected = Calibrated(false, factors);
  ASSERT_THAT(WarningCodes(), ElementsAre("exposure_metadata"));
  EXPECT_THAT(context_.warnings[0].message, HasSubstr("photos.csv:5 (v3.png)"));
  // The prior of the eight holds their mean, which the one that is off moves a little.
  EXPECT_THAT(context_.warnings[0].message, AnyOf(HasSubstr("1.99"), HasSubstr("2.00")));
  // It is as bright as the others then.
  for (const Observation& o : corrected) EXPECT_NEAR(o.relative_luminance / wall_.Truth(o.element), 1, 0.04);
}

// The wall's photos by two cameras in turn, the second of 0.64 of the first's sensitivity.
class ObservedRigTest : public ObservedLightTest {
 protected:
  void GiveFactors(double first, double second) {
    photos_.cameras.at(0).given.cdm2_per_count_s = first;
    photos_.cameras.at(1).given.cdm2_per_count_s = second;
  }

  ObservedRigTest() {
    std::string rows;
    for (size_t v = 0; v < wall_.views.size(); ++v) {
      RegisteredView& view = wall_.views[v];
      view.camera = static_cast<int>(v % 2);
      rows += view.view + ".png,cam" + (v % 2 == 0 ? "0," : "1,") + view.view + ",on,0.25,,\n";
    }
    WriteSession("", rows, "on = { A = 1 }", "[[camera]]\nid = \"cam1\"\nintrinsics = \"cam0.yaml\"\n");
    session_ = ReadSession(folder_.Path("session.toml"));
    RunContext quiet = context_;
    photos_ = MakeBrackets(session_, session_.photos, quiet);
    registered_.cameras = {wall_.camera, wall_.camera};
    registered_.registration.views = wall_.views;
    for (size_t v = 1; v < factors_.size(); v += 2) factors_[v] = 0.64;
  }

  std::vector<Observation> Observed() { return wall_.Observe(false, factors_, rng_); }

  std::vector<Observation> Calibrated(std::vector<Observation> observations) {
    return WithSelfCalibration(
        session_, photos_, registered_, wall_.patches, {},
        InOneUnit(std::move(observations), RoomPhotosOf(session_, photos_), wall_.views), context_,
        artifact_);
  }

  std::vector<double> factors_ = std::vector<double>(8, 1.0);
  nlohmann::json artifact_;
};

TEST_F(ObservedRigTest, TheGainIsAChoiceAndOnlyThePhotoThatLiesIsNamed) {
  factors_[3] *= 2;
  const std::vector<Observation> corrected = Calibrated(Observed());
  ASSERT_THAT(WarningCodes(), ElementsAre("exposure_metadata"));
  EXPECT_THAT(context_.warnings[0].message, HasSubstr("(v3.png)"));
  ASSERT_THAT(context_.choices, SizeIs(2));
  EXPECT_EQ(context_.choices[0].what, "gain of cam1");
  EXPECT_THAT(context_.choices[0].chosen, HasSubstr("of cam0's"));
  const nlohmann::json& gain = artifact_.at("camera_gains").at(0);
  EXPECT_EQ(gain["camera"], "cam1");
  EXPECT_EQ(gain["relative_to"], "cam0");
  EXPECT_EQ(gain["source"], "photos");
  const double sigma = gain["relative_sigma"];
  EXPECT_NEAR(gain["gain"].get<double>(), 0.64, 0.64 * 3 * sigma);
  // Exposures that err by 5 % each: means of 4 photos and of 3, without the one that lies. A fifth for weights.
  std::printf("relative sigma of cam1's gain %.4f\n", sigma);
  EXPECT_GT(sigma, 0);
  EXPECT_LT(sigma, 1.2 * 0.05 * std::sqrt(1. / 4 + 1. / 3));
  for (const Observation& o : corrected) EXPECT_NEAR(o.relative_luminance / wall_.Truth(o.element), 1, 0.04);
}

TEST_F(ObservedRigTest, EqualCamerasLeaveNoTrace) {
  factors_.assign(8, 1.0);
  Calibrated(Observed());
  EXPECT_THAT(context_.warnings, IsEmpty());
  ASSERT_THAT(context_.choices, SizeIs(1));
  EXPECT_EQ(context_.choices[0].chosen, "as recorded");
  EXPECT_FALSE(artifact_.contains("camera_gains"));
}

// The first camera sees the left of the wall, the second its right.
TEST_F(ObservedRigTest, CamerasWithoutCommonSurfacesAreNamed) {
  std::vector<Observation> apart;
  for (const Observation& o : Observed()) {
    if ((o.element % 40 < 20) == (o.view % 2 == 0)) apart.push_back(o);
  }
  Calibrated(apart);
  ASSERT_THAT(WarningCodes(), ElementsAre("camera_gain_undetermined"));
  EXPECT_THAT(context_.warnings[0].message, HasSubstr("camera cam1 against that of camera cam0"));
  EXPECT_FALSE(artifact_.contains("camera_gains"));
}

TEST_F(ObservedRigTest, GivenFactorsAreUsedAndNotAdjusted) {
  GiveFactors(0.32, 0.5);
  const std::vector<Observation> corrected = Calibrated(Observed());
  EXPECT_THAT(context_.warnings, IsEmpty());
  EXPECT_EQ(context_.choices.at(0).chosen, "0.64 of cam0's");
  EXPECT_EQ(artifact_.at("camera_gains").at(0).at("source"), "session");
  for (const Observation& o : corrected) EXPECT_NEAR(o.relative_luminance / wall_.Truth(o.element), 1, 0.04);
}

TEST_F(ObservedRigTest, GivenFactorsThatPhotosContradictAreNamed) {
  GiveFactors(0.5, 0.5);
  const std::vector<Observation> observed = Observed(), kept = Calibrated(observed);
  ASSERT_THAT(WarningCodes(), ElementsAre("camera_scales_contradict"));
  EXPECT_THAT(context_.warnings[0].message, HasSubstr("photos of camera \"cam1\""));
  for (size_t i = 0; i < kept.size(); ++i)
    EXPECT_EQ(kept[i].relative_luminance, observed[i].relative_luminance);
}

}  // namespace
}  // namespace luxfit
