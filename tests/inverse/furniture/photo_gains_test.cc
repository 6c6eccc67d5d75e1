// The office that an independent renderer photographed, its photos darkened and brightened: signatures come out as of
// the photos as they were, up to a factor common to a state, and the furniture that is found with them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "apps/session/tag_map.h"
#include "calib/lens/camera_file.h"
#include "inverse/furniture/photo_gains.h"
#include "inverse/observe/observe_photos.h"
#include "inverse/observe/room_furniture.h"
#include "inverse/observe/room_signatures.h"
#include "tests/support/office_photos.h"
#include "tests/support/office_views.h"

namespace luxfit {
namespace {

using Change = std::function<ImagePlane(size_t photo, const ImagePlane&)>;

struct Office {
  Scene mesh = support::EmptyOffice();
  Room room = MakeRoom(mesh);
  RoomPhotos photos = support::OfficePhotos();
  std::vector<Camera> cameras{ReadCamera(support::kOfficeFolder + "cam0.yaml")};
  std::vector<SurveyedTag> survey = ReadTagMap(support::kOfficeFolder + "tags.json");
  int states = static_cast<int>(support::OfficeStates().states.size());
  std::vector<RegisteredView> views =
      ObservePhotos(room, cameras, survey, photos, support::OfficeStates()).registration.views;

  RoomPhotos Changed(const Change& change) const {
    RoomPhotos changed = photos;
    changed.read = [this, change](size_t i) {
      LuminanceImage image = *photos.read(i);
      image.relative_luminance = change(i, image.relative_luminance);
      return std::make_shared<const LuminanceImage>(std::move(image));
    };
    return changed;
  }
  std::vector<SignatureView> Corrected(const RoomPhotos& of) const {
    const std::vector<SignatureView> given = SignaturesOf(of, cameras, views, states);
    return WithoutGains(given, EstimatePhotoGains(mesh, given, FurnitureOptions().tolerance));
  }
  RevisedRoom Furniture(const RoomPhotos& of) const {
    return LookForFurniture(mesh, room.scene, of, cameras, views, states, {}, survey);
  }
};

const Office& TheOffice() {
  static const Office office;
  return office;
}

ImagePlane Flicker(size_t photo, const ImagePlane& y) {
  return static_cast<float>(1 + 0.03 * std::sin(2.4 * static_cast<double>(photo + 1))) * y;
}

ImagePlane DarkCorners(size_t /*photo*/, const ImagePlane& y) {
  const auto width = static_cast<int>(y.cols()), height = static_cast<int>(y.rows());
  Vignetting lens = NoVignetting(width, height);
  lens.coefficients = Eigen::VectorXd::Constant(1, -0.35);
  return y * VignettingImage(lens, width, height);
}

// Returns the median of how far the pixels' signatures lie from those of the photos as they were, less what is common to
// a state: the largest of any view and state, of ln Y.
double WorstShift(const std::vector<SignatureView>& given, const std::vector<SignatureView>& right) {
  std::vector<std::vector<double>> shift(static_cast<size_t>(given.front().states));
  for (size_t v = 0; v < given.size(); ++v) {
    std::vector<std::vector<double>> of_state(shift.size());
    for (size_t i = 0; i < given[v].log_luminance.size(); ++i) {
      const double d = given[v].log_luminance[i] - right[v].log_luminance[i];
      if (std::isfinite(d)) of_state[i % shift.size()].push_back(d);
    }
    for (size_t s = 0; s < shift.size(); ++s) {
      std::vector<double>& d = of_state[s];
      if (d.empty()) continue;  // no photo
      std::nth_element(d.begin(), d.begin() + d.size() / 2, d.end());
      shift[s].push_back(d[d.size() / 2]);
    }
  }
  double worst = 0;
  for (const std::vector<double>& of_state : shift) {
    double mean = 0;
    for (const double d : of_state) mean += d / static_cast<double>(of_state.size());
    for (const double d : of_state) worst = std::max(worst, std::abs(d - mean));
  }
  return worst;
}

void ExpectSameFurniture(const RoomPhotos& photos) {
  const RevisedRoom found = TheOffice().Furniture(photos), right = TheOffice().Furniture(TheOffice().photos);
  EXPECT_TRUE(found.walls.empty());
  ASSERT_EQ(found.furniture.found.size(), right.furniture.found.size());
  for (size_t k = 0; k < right.furniture.found.size(); ++k) {
    EXPECT_LT((found.furniture.found[k].box.min_m - right.furniture.found[k].box.min_m).norm(), 0.03);
    EXPECT_LT((found.furniture.found[k].box.max_m - right.furniture.found[k].box.max_m).norm(), 0.03);
  }
}

TEST(PhotoGains, PhotosThatAgreeStayAsTheyAre) {
  const Office& office = TheOffice();
  const auto given = SignaturesOf(office.photos, office.cameras, office.views, office.states);
  EXPECT_EQ(WorstShift(office.Corrected(office.photos), given), 0);
}

TEST(PhotoGains, FlickerIsTakenOut) {
  const Office& office = TheOffice();
  const RoomPhotos photos = office.Changed(Flicker);
  const auto right = SignaturesOf(office.photos, office.cameras, office.views, office.states);
  EXPECT_GT(WorstShift(SignaturesOf(photos, office.cameras, office.views, office.states), right), 0.02);
  EXPECT_LT(WorstShift(office.Corrected(photos), right), 0.004);
  ExpectSameFurniture(photos);
}

TEST(PhotoGains, DarkCornersAreTakenOut) {
  const Office& office = TheOffice();
  const RoomPhotos photos = office.Changed(DarkCorners);
  const auto right = SignaturesOf(office.photos, office.cameras, office.views, office.states);
  EXPECT_LT(WorstShift(office.Corrected(photos), right), 0.004);
  ExpectSameFurniture(photos);
}

// Waves of light that differ from photo to photo, as maps of tones leave them.
ImagePlane Waves(size_t photo, const ImagePlane& y) {
  ImagePlane changed = 1.1F * y;
  for (Eigen::Index v = 0; v < y.rows(); ++v)
    for (Eigen::Index u = 0; u < y.cols(); ++u) {
      const double phase = 0.05 * static_cast<double>(u) + 0.04 * static_cast<double>(v);
      changed(v, u) *= static_cast<float>(1 + 0.1 * std::sin(phase + 2 * static_cast<double>(photo)));
    }
  return changed;
}

TEST(PhotoGains, WhatTheyDoNotExplainStaysAsItIs) {
  const Office& office = TheOffice();
  const RoomPhotos photos = office.Changed(Waves);
  const auto given = SignaturesOf(photos, office.cameras, office.views, office.states);
  EXPECT_GT(
      EstimatePhotoGains(office.mesh, given, FurnitureOptions().tolerance).log_gain.cwiseAbs().maxCoeff(),
      0.01);
  EXPECT_EQ(WorstShift(office.Corrected(photos), given), 0);
}

TEST(PhotoGains, StatedGainsAreDividedOut) {
  const Office& office = TheOffice();
  RoomPhotos two = office.photos;
  two.cameras.push_back(two.cameras.front());
  two.cameras[0].cdm2_per_unit = 100;
  two.cameras[1].cdm2_per_unit = 50;  // counts twice as much
  std::vector<Camera> cameras{office.cameras[0], office.cameras[0]};
  std::vector<RegisteredView> views = office.views;
  views.front().camera = 1;
  for (RoomPhoto& photo : two.photos)
    if (photo.view == views.front().view) photo.camera = 1;
  const auto one = SignaturesOf(office.photos, office.cameras, office.views, office.states);
  const auto of_two = SignaturesOf(two, cameras, views, office.states);
  EXPECT_NEAR(WorstShift(of_two, one), (1 - 1. / static_cast<double>(views.size())) * std::log(2), 1e-5);
}

}  // namespace
}  // namespace luxfit
