#include "inverse/observe/camera/calibrated_observations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tests/support/inverse/wall_photos.h"

namespace luxfit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

struct Calibrated {
  SelfCalibration found;
  RadiometryFindings findings;
  std::vector<Observation> observations;
};

class CalibratedObservationsTest : public testing::Test {
 protected:
  Calibrated Calibrate(const std::vector<Observation>& observations, StatedVignetting stated) const {
    std::vector<StatedPhoto> photos = PhotosIn(observations);
    for (StatedPhoto& photo : photos) photo.exposure_s = 0.25;
    const std::vector<PhotoSample> samples =
        SamplesOf(observations, photos, wall_.patches, {wall_.camera}, wall_.views);
    const OpenRadiometry open{true, {true}, {true}};
    const SelfCalibration found = SelfCalibrate(wall_.patches, {Eigen::VectorXd::Ones(1)}, samples, open);
    return {found, FindingsOf(found, open, {stated}), WithCorrections(observations, samples, found)};
  }

  support::WallPhotos wall_;
  // The draws of tests/apps/stages/linearize_test.cc.
  std::mt19937_64 rng_{7};
};

TEST_F(CalibratedObservationsTest, VignettingAndSmallGainsAreTakenOut) {
  const std::vector<double> factors{1, 1.01, 0.99, 1.005, 1, 0.995, 1.01, 0.99};
  const Calibrated calibrated = Calibrate(wall_.Observe(true, factors, rng_), StatedVignetting::kEstimate);
  ASSERT_THAT(calibrated.findings.cameras, SizeIs(1));
  EXPECT_FALSE(calibrated.findings.cameras[0].darkens);
  EXPECT_FALSE(calibrated.findings.cameras[0].vignetting_is_undetermined);
  EXPECT_THAT(calibrated.findings.wrong_photos, IsEmpty());
  double scale = 0;
  for (const Observation& o : calibrated.observations) scale += o.relative_luminance / wall_.Truth(o.element);
  scale /= static_cast<double>(calibrated.observations.size());
  double squares = 0;
  for (const Observation& o : calibrated.observations)
    squares += std::pow(o.relative_luminance / wall_.Truth(o.element) / scale - 1, 2);
  // Noise of 0.5 % stays; the corners were 66 % down.
  EXPECT_LT(std::sqrt(squares / static_cast<double>(calibrated.observations.size())), 0.008);
}

TEST_F(CalibratedObservationsTest, VignettingThatIsDeniedIsFound) {
  const std::vector<Observation> dark = wall_.Observe(true, std::vector<double>(8, 1.0), rng_);
  const Calibrated calibrated = Calibrate(dark, StatedVignetting::kNone);
  EXPECT_TRUE(calibrated.findings.cameras.at(0).darkens);
  EXPECT_FALSE(calibrated.findings.cameras.at(0).vignetting_is_undetermined);
}

TEST_F(CalibratedObservationsTest, OnlyThePhotoThatLiesIsFound) {
  std::vector<double> factors(8, 1.0);
  factors[3] = 2;
  const Calibrated calibrated = Calibrate(wall_.Observe(false, factors, rng_), StatedVignetting::kEstimate);
  EXPECT_THAT(calibrated.findings.wrong_photos, ElementsAre(3));
  // It is as bright as the others then.
  for (const Observation& o : calibrated.observations)
    EXPECT_NEAR(o.relative_luminance / wall_.Truth(o.element), 1, 0.04);
}

// Views take turns between two cameras, the second of 0.64 of the first's sensitivity.
TEST_F(CalibratedObservationsTest, OnlyThePhotoThatLiesIsFoundInARig) {
  std::vector<double> factors(8, 1.0);
  for (size_t view = 1; view < 8; view += 2) {
    factors[view] = 0.64;
    wall_.views[view].camera = 1;
  }
  factors[3] *= 2;
  std::vector<Observation> observations = wall_.Observe(false, factors, rng_);
  std::vector<StatedPhoto> photos = PhotosIn(observations);
  for (StatedPhoto& photo : photos) photo.exposure_s = 0.25;
  const std::vector<PhotoSample> samples =
      SamplesOf(observations, photos, wall_.patches, {wall_.camera, wall_.camera}, wall_.views);
  const OpenRadiometry open{true, {true, true}, {true, true}};
  const SelfCalibration found = SelfCalibrate(wall_.patches, {Eigen::VectorXd::Ones(1)}, samples, open);
  const std::vector<StatedVignetting> stated(2, StatedVignetting::kNone);
  EXPECT_THAT(FindingsOf(found, open, stated).wrong_photos, ElementsAre(3));
  const CameraGain& second = found.camera_gains.at(1);
  EXPECT_NEAR(second.log_gain, std::log(0.64), 3 * second.sigma);
  // Exposures that err by 5 % each: the means of 4 photos of one camera and 3 of the other, without the one that lies,
  // differ by 3.8 %. Closed form, and a fifth for weights.
  std::printf("sigma of the second camera's log gain %.4f\n", second.sigma);
  EXPECT_GT(second.sigma, 0);
  EXPECT_LT(second.sigma, 1.2 * 0.05 * std::sqrt(1. / 4 + 1. / 3));
  // All are as bright as the first camera's photos then.
  for (const Observation& o : WithCorrections(std::move(observations), samples, found))
    EXPECT_NEAR(o.relative_luminance / wall_.Truth(o.element), 1, 0.04);
}

// Too few surfaces: nothing is corrected, and only a vignetting that was asked for is missed.
TEST_F(CalibratedObservationsTest, WithoutSharedSurfacesNothingIsCorrected) {
  std::vector<Observation> few = wall_.Observe(false, std::vector<double>(8, 1.0), rng_);
  few.resize(10);
  const Calibrated asked = Calibrate(few, StatedVignetting::kEstimate);
  EXPECT_FALSE(asked.found.is_possible);
  EXPECT_TRUE(asked.findings.cameras.at(0).vignetting_is_undetermined);
  EXPECT_FALSE(Calibrate(few, StatedVignetting::kNone).findings.cameras.at(0).vignetting_is_undetermined);
  for (size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(asked.observations[i].relative_luminance, few[i].relative_luminance);
    EXPECT_EQ(asked.observations[i].variance, few[i].variance);
  }
}

TEST_F(CalibratedObservationsTest, PhotosAreNumberedAsTheyAppear) {
  std::vector<Observation> observations(3);
  observations[0].view = observations[2].view = 4;
  observations[1].state = 2;
  const std::vector<StatedPhoto> photos = PhotosIn(observations);
  ASSERT_THAT(photos, SizeIs(2));
  EXPECT_EQ(photos[0].view, 4);
  EXPECT_EQ(photos[1].state, 2);
  // Their exposures are not stated yet.
  EXPECT_THROW(SamplesOf(observations, photos, wall_.patches, {wall_.camera}, wall_.views),
               std::invalid_argument);
  EXPECT_THROW(SamplesOf(observations, {}, wall_.patches, {wall_.camera}, wall_.views),
               std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
