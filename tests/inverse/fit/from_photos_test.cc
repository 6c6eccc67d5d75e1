// From photos to luminaires without a session file: the whole way through the libraries, on the office that an independent
// renderer photographed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "apps/session/tag_map.h"
#include "calib/lens/camera_file.h"
#include "forward/room/scene.h"
#include "inverse/fit/fit_room.h"
#include "inverse/observe/observe_photos.h"
#include "tests/support/office_photos.h"
#include "tests/support/office_truth.h"

namespace luxfit {
namespace {

using support::kOfficeFolder;

// L3 with everything on: what the office's own session takes for its scale.
MeterReading ScaleReading() {
  for (const std::vector<std::string>& row : support::OfficeTable("luxmeter.csv")) {
    if (row[0] != "L3" || row[7] != "all") continue;
    const auto at = [&](size_t i) { return std::stod(row[i]); };
    return {{{at(1), at(2), at(3)}, {at(4), at(5), at(6)}, {}},
            support::OfficeStateIndex("all"),
            at(8),
            0,
            true,
            -1};
  }
  throw std::runtime_error("luxmeter.csv: expected L3 in state all");
}

std::vector<EstimatedLuminaire> FitTheOffice() {
  const std::string& office = kOfficeFolder;
  const Room room = MakeRoom(ReadScene(office + "room.obj"));
  const std::vector<Camera> cameras{ReadCamera(office + "cam0.yaml")};
  const std::vector<SurveyedTag> tags = ReadTagMap(office + "tags.json");
  const Evidence observed =
      ObservePhotos(room, cameras, tags, support::OfficePhotos(), support::OfficeStates()).observed.evidence;
  RoomObservations given;
  for (const char* id : {"A", "B", "C", "D"}) {
    given.luminaires.emplace_back();
    given.luminaires.back().luminaire.id = id;
  }
  given.dimming = support::OfficeStates().dimming;
  given.observations = observed.observations;
  given.seen = observed.seen;
  given.outlines = observed.outlines;
  given.meter.readings = {ScaleReading()};
  return EstimatedLuminaires(FitRoom(room, given));
}

// The office's session reaches 4.2 mm and 0.57 % (README.md); a different order of photos within a view changes little.
TEST(FromPhotos, TheOfficesLuminairesAreFoundWithoutASessionFile) {
  const std::vector<EstimatedLuminaire> found = FitTheOffice();
  ASSERT_EQ(found.size(), 4u);
  for (const nlohmann::json& truth : support::OfficeTruth().at("lamps")) {
    const auto at = std::find_if(found.begin(), found.end(), [&](const EstimatedLuminaire& l) {
      return l.id == truth.at("id").get<std::string>();
    });
    ASSERT_NE(at, found.end());
    EXPECT_LT((at->position - support::VectorOf(truth.at("position"))).norm(), 0.0065) << at->id;
    EXPECT_NEAR(at->flux / truth.at("flux_lm").get<double>(), 1, 0.009) << at->id;
  }
}

TEST(FromPhotos, WhatDoesNotFitTogetherIsRefused) {
  const Room room = MakeRoom(ReadScene(kOfficeFolder + "room.obj"));
  RoomObservations given;
  EXPECT_THROW(FitRoom(room, given), std::invalid_argument);  // no luminaire
  given.luminaires.emplace_back();
  given.dimming = {Eigen::VectorXd::Ones(1)};
  EXPECT_THROW(FitRoom(room, given), std::invalid_argument);  // nothing to fit to
  given.meter.readings = {ScaleReading()};
  EXPECT_THROW(FitRoom(room, given), std::invalid_argument);  // a state that there is not
  given.meter.readings[0].state = 0;
  given.albedo.resize(1);
  EXPECT_THROW(FitRoom(room, given), std::invalid_argument);  // one albedo for several materials
  EXPECT_THROW(ObservePhotos(room, {}, {}, RoomPhotos{{}, {RoomPhoto{}}, {}}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
