// Observe, on the office that an independent renderer photographed. Light adds: with lamp C as the ambient light, the
// photos of all lamps have to show what the photos of A, B and D show together.
#include "inverse/observe/evidence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/session/tag_map.h"
#include "calib/lens/camera_file.h"
#include "forward/mesh/mesh_file.h"
#include "forward/room/scene.h"
#include "inverse/observe/observe_photos.h"
#include "tests/support/office_photos.h"
#include "tests/support/office_truth.h"

namespace luxfit {
namespace {

using support::kOfficeFolder;
using support::OfficeStateIndex;
using testing::ElementsAre;
using testing::IsEmpty;

struct SeenOffice {
  Room room;
  RoomPhotos photos;
  PhotoObservations seen;
};

const SeenOffice& TheOffice() {
  static const SeenOffice office = [] {
    Room room = MakeRoom(ReadScene(kOfficeFolder + "room.obj"));
    RoomPhotos photos = support::OfficePhotos();
    PhotoObservations seen =
        ObservePhotos(room, {ReadCamera(kOfficeFolder + "cam0.yaml")},
                      ReadTagMap(kOfficeFolder + "tags.json"), photos, support::OfficeStates());
    return SeenOffice{std::move(room), std::move(photos), std::move(seen)};
  }();
  return office;
}

// C is the light of the street: states are "street" and "lamps", in which A, B and D are on as one.
ObservedPhotos ObserveWithStreet(const std::string& view_without_street) {
  const RoomPhotos& all = TheOffice().photos;
  std::vector<size_t> at;
  for (size_t i = 0; i < all.photos.size(); ++i) {
    const RoomPhoto& photo = all.photos[i];
    const bool is_street = photo.state == OfficeStateIndex("C") && photo.view != view_without_street;
    if (is_street || photo.state == OfficeStateIndex("all")) at.push_back(i);
  }
  RoomPhotos photos = PhotosAt(all, at);
  for (RoomPhoto& photo : photos.photos) photo.state = photo.state == OfficeStateIndex("C") ? 0 : 1;
  const StateTable states{
      {"street", "lamps"}, {"lamps"}, {Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1)}};
  ObserveOptions options;
  options.tags = ReadTagMap(kOfficeFolder + "tags.json");
  return Observe(TheOffice().room, photos, TheOffice().seen.cameras, TheOffice().seen.registration, states,
                 options);
}

// Relative luminance of A, B and D together, by view and element; only where all three are observed.
std::map<std::pair<int, int>, double> SumOfLamps() {
  std::map<std::pair<int, int>, std::pair<double, int>> sums;
  for (const Observation& o : TheOffice().seen.observed.evidence.observations) {
    const bool is_lamp = o.state == OfficeStateIndex("A") || o.state == OfficeStateIndex("B") ||
                         o.state == OfficeStateIndex("D");
    if (!is_lamp) continue;
    sums[{o.view, o.element}].first += o.relative_luminance;
    ++sums[{o.view, o.element}].second;
  }
  std::map<std::pair<int, int>, double> sum;
  for (const auto& [place, s] : sums)
    if (s.second == 3) sum[place] = s.first;
  return sum;
}

TEST(EvidenceTest, AmbientLightIsSubtracted) {
  const ObservedPhotos observed = ObserveWithStreet("");
  EXPECT_TRUE(observed.has_ambient);
  EXPECT_THAT(observed.views_without_ambient, ElementsAre("v08"));  // the fixture has no photo of C there
  const std::map<std::pair<int, int>, double> sum = SumOfLamps();
  std::vector<double> off;
  for (const Observation& o : observed.evidence.observations) {
    ASSERT_EQ(o.state, 1);  // the street alone is no evidence
    const auto expected = sum.find({o.view, o.element});
    if (expected != sum.end()) off.push_back(std::abs(o.relative_luminance / expected->second - 1));
  }
  ASSERT_GT(off.size(), 1000U);
  std::nth_element(off.begin(), off.begin() + static_cast<std::ptrdiff_t>(off.size() * 9 / 10), off.end());
  const double ninth = off[off.size() * 9 / 10];
  std::printf("%zu places, nine tenths off by less than %.2f %%\n", off.size(), 100 * ninth);
  EXPECT_LT(ninth, 0.0032);  // 0.21 %: the photos' noise, three exposures against two
}

TEST(EvidenceTest, AViewWithoutAPhotoOfTheAmbientLightTakesThatOfOthers) {
  const std::vector<RegisteredView>& views = TheOffice().seen.registration.views;
  const ObservedPhotos observed = ObserveWithStreet(views.front().view);
  EXPECT_THAT(observed.views_without_ambient, ElementsAre(views.front().view, "v08"));
  const std::map<std::pair<int, int>, double> sum = SumOfLamps();
  std::vector<double> off;
  for (const Observation& o : observed.evidence.observations) {
    const auto expected = sum.find({o.view, o.element});
    if (o.view == 0 && expected != sum.end())
      off.push_back(std::abs(o.relative_luminance / expected->second - 1));
  }
  ASSERT_GT(off.size(), 300U);
  std::nth_element(off.begin(), off.begin() + static_cast<std::ptrdiff_t>(off.size() * 9 / 10), off.end());
  const double ninth = off[off.size() * 9 / 10];
  std::printf("%zu places, nine tenths off by less than %.2f %%\n", off.size(), 100 * ninth);
  EXPECT_LT(ninth, 0.02);
}

TEST(EvidenceTest, ACleanOfficeHasNothingToSay) {
  const PhotoObservations& seen = TheOffice().seen;
  EXPECT_THAT(seen.misplaced, IsEmpty());
  EXPECT_EQ(seen.used.size(), TheOffice().photos.photos.size());
  EXPECT_FALSE(seen.observed.has_ambient);
  EXPECT_THAT(seen.observed.evidence.photos_as_if, IsEmpty());
  EXPECT_THAT(seen.observed.evidence.states_as_if, IsEmpty());
  ASSERT_TRUE(seen.observed.radiometry);
  EXPECT_EQ(seen.observed.radiometry->found.Chosen().name, "as recorded");
  EXPECT_EQ(seen.observed.evidence.pose_covariance.size(), 0);
  size_t elements = 0;
  for (const size_t of_photo : seen.observed.elements) elements += of_photo;
  EXPECT_EQ(elements, seen.observed.evidence.observations.size());
}

// The unit is that of the first camera that has photos and a stated factor.
TEST(EvidenceTest, StatedFactorsBringCamerasToOneUnit) {
  RoomPhotos photos;
  photos.cameras.resize(2);
  photos.photos = {{"v", 1, 0, 1}};
  EXPECT_EQ(UnitCamera(photos), 0);
  EXPECT_FALSE(StatedScale(photos));
  photos.cameras[0].cdm2_per_unit = 100;  // it has no photos
  photos.cameras[1].cdm2_per_unit = 200;
  EXPECT_EQ(UnitCamera(photos), 1);
  EXPECT_EQ(*StatedScale(photos), 1.0 / 200);
  EXPECT_THAT(StatedGains(photos), ElementsAre(2, 1));
  photos.photos.push_back({"w", 0, 0, 1});
  EXPECT_EQ(UnitCamera(photos), 0);
  EXPECT_THAT(StatedGains(photos), ElementsAre(1, 0.5));
}

TEST(EvidenceTest, WhatDoesNotFitTogetherIsRefused) {
  const SeenOffice& office = TheOffice();
  StateTable fewer = support::OfficeStates();
  fewer.states.pop_back();
  fewer.dimming.pop_back();
  EXPECT_THROW(Observe(office.room, office.photos, office.seen.cameras, office.seen.registration, fewer),
               std::invalid_argument);
  EXPECT_THROW(Observe(office.room, office.photos, {}, office.seen.registration, support::OfficeStates()),
               std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
