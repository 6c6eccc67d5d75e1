// From photos to luminaires without a session file: the whole way through the libraries, on the office that an independent
// renderer photographed.
#include <gtest/gtest.h>

#include <vector>

#include "apps/session/tag_map.h"
#include "calib/lens/camera_file.h"
#include "forward/mesh/mesh_file.h"
#include "forward/room/scene.h"
#include "inverse/fit/fit_room.h"
#include "inverse/observe/observe_photos.h"
#include "tests/support/office_fit.h"
#include "tests/support/office_photos.h"
#include "tests/support/office_truth.h"

namespace luxfit {
namespace {

using support::kOfficeFolder;

// The office's session reaches 2.4 mm and 1.03 %; a different order of photos within a view changes little.
TEST(FromPhotos, TheOfficesLuminairesAreFoundWithoutASessionFile) {
  const Room room = MakeRoom(ReadScene(kOfficeFolder + "room.obj"));
  const std::vector<Camera> cameras{ReadCamera(kOfficeFolder + "cam0.yaml")};
  const std::vector<SurveyedTag> tags = ReadTagMap(kOfficeFolder + "tags.json");
  const PhotoObservations seen =
      ObservePhotos(room, cameras, tags, support::OfficePhotos(), support::OfficeStates());
  const std::vector<EstimatedLuminaire> found = support::FitOffice(room, seen.observed.evidence);
  EXPECT_EQ(found.size(), 4u);
  const support::OfficeError worst = support::WorstOfOffice(found);
  EXPECT_LT(worst.position_m, 0.0065);
  EXPECT_LT(worst.flux_share, 0.016);  // 1.03 % by `luxfit fit`
}

TEST(FromPhotos, WhatDoesNotFitTogetherIsRefused) {
  const Room room = MakeRoom(ReadScene(kOfficeFolder + "room.obj"));
  RoomObservations given;
  EXPECT_THROW(FitRoom(room, given), std::invalid_argument);  // no luminaire
  given.luminaires.emplace_back();
  given.dimming = {Eigen::VectorXd::Ones(1)};
  EXPECT_THROW(FitRoom(room, given), std::invalid_argument);  // nothing to fit to
  given.meter.readings = {support::OfficeScaleReading()};
  EXPECT_THROW(FitRoom(room, given), std::invalid_argument);  // a state that there is not
  given.meter.readings[0].state = 0;
  given.albedo.resize(1);
  EXPECT_THROW(FitRoom(room, given), std::invalid_argument);  // one albedo for several materials
  EXPECT_THROW(ObservePhotos(room, {}, {}, RoomPhotos{{}, {RoomPhoto{}}, {}}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
