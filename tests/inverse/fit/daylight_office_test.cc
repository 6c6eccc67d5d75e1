// The office that an independent renderer photographed, with the light of luminaire D as daylight that changes while the photos are
// taken. A, B and C come out as in steady light.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "apps/session/tag_map.h"
#include "calib/lens/camera_file.h"
#include "forward/mesh/mesh_file.h"
#include "inverse/observe/observe_photos.h"
#include "tests/support/office_fit.h"

namespace luxfit {
namespace {

using support::kOfficeFolder;
using support::OfficeStateIndex;

enum State { kA, kB, kC, kAll, kOff };

StateTable States() {
  StateTable table{{"A", "B", "C", "all", "off"}, {"A", "B", "C"}, {}};
  for (int k = 0; k < 3; ++k) table.dimming.emplace_back(Eigen::VectorXd::Unit(3, k));
  table.dimming.emplace_back(Eigen::VectorXd::Ones(3));
  table.dimming.emplace_back(Eigen::VectorXd::Zero(3));
  return table;
}

// Says how bright the daylight is in a photo. `number`: of the photo's view, from 0.
using Daylight = std::function<double(int number, State state)>;

const RoomPhotos& OfficePhotosOnce() {
  static const RoomPhotos photos = support::OfficePhotos();
  return photos;
}

// `has_off`: whether the view of that number was photographed with all luminaires off.
RoomPhotos WithDaylight(const Daylight& daylight, const std::function<bool(int number)>& has_off) {
  const RoomPhotos& office = OfficePhotosOnce();
  const std::map<int, State> states{{OfficeStateIndex("A"), kA},
                                    {OfficeStateIndex("B"), kB},
                                    {OfficeStateIndex("C"), kC},
                                    {OfficeStateIndex("all"), kAll},
                                    {OfficeStateIndex("D"), kOff}};
  std::map<std::string, size_t> of_daylight;
  for (size_t i = 0; i < office.photos.size(); ++i)
    if (office.photos[i].state == OfficeStateIndex("D")) of_daylight[office.photos[i].view] = i;
  RoomPhotos photos{office.cameras, {}, nullptr};
  std::vector<LuminanceImage> images;
  for (size_t i = 0; i < office.photos.size(); ++i) {
    RoomPhoto photo = office.photos[i];
    const auto state = states.find(photo.state);
    const auto off = of_daylight.find(photo.view);
    if (state == states.end() || off == of_daylight.end()) continue;
    const auto number = static_cast<int>(std::distance(of_daylight.begin(), off));
    if (state->second == kOff && !has_off(number)) continue;
    // The photo of all luminaires has the light of D once.
    const double own = state->second == kOff || state->second == kAll ? 1 : 0;
    photo.state = state->second;
    photos.photos.push_back(photo);
    images.push_back(
        WithoutAmbient(*office.read(i), *office.read(off->second), own - daylight(number, state->second)));
  }
  photos.read = InMemory(std::move(images));
  return photos;
}

struct Fitted {
  RoomFit fit;
  ObservedPhotos observed;
  double position_m = 0, ratio = 0;  // worst, of places and of fluxes over their mean error
};

Fitted Fit(
    const Daylight& daylight, const std::function<bool(int)>& has_off = [](int) { return true; }) {
  static const Room room = MakeRoom(ReadScene(kOfficeFolder + "room.obj"));
  Fitted fitted;
  fitted.observed =
      ObservePhotos(room, {ReadCamera(kOfficeFolder + "cam0.yaml")}, ReadTagMap(kOfficeFolder + "tags.json"),
                    WithDaylight(daylight, has_off), States())
          .observed;
  RoomObservations given;
  for (const char* id : {"A", "B", "C"}) {
    given.luminaires.emplace_back();
    given.luminaires.back().luminaire.id = id;
  }
  given.dimming = States().dimming;
  const Evidence& evidence = fitted.observed.evidence;
  given.observations = evidence.observations;
  given.seen = evidence.seen;
  given.outlines = evidence.outlines;
  given.views = evidence.views;
  given.ambient_spread = evidence.ambient_spread;
  for (const std::vector<std::string>& row : support::OfficeTable("luxmeter.csv")) {
    if (row[0] != "L3" || row[7] != "A") continue;
    const auto at = [&](size_t i) { return std::stod(row[i]); };
    given.meter.readings = {{{{at(1), at(2), at(3)}, {at(4), at(5), at(6)}, {}}, kA, at(8), 0, true, -1}};
  }
  fitted.fit = FitRoom(room, given);
  std::vector<double> off;
  const nlohmann::json truth = support::OfficeTruth();
  for (const EstimatedLuminaire& l : EstimatedLuminaires(fitted.fit)) {
    for (const nlohmann::json& lamp : truth.at("lamps")) {
      if (lamp.at("id").get<std::string>() != l.id) continue;
      fitted.position_m =
          std::max(fitted.position_m, (l.position - support::VectorOf(lamp.at("position"))).norm());
      off.push_back(l.flux / lamp.at("flux_lm").get<double>());
    }
  }
  EXPECT_EQ(off.size(), 3U);
  const auto [least, greatest] = std::minmax_element(off.begin(), off.end());
  fitted.ratio = *greatest / *least - 1;
  std::printf("worst place %.2f mm, fluxes of each other %.2f %%, %zu shares, spread %.3f\n",
              1000 * fitted.position_m, 100 * fitted.ratio, fitted.observed.ambient.share.size(),
              fitted.observed.ambient.spread);
  return fitted;
}

bool Warns(const Fitted& fitted) {
  const auto& warnings = fitted.fit.findings.warnings;
  return std::any_of(warnings.begin(), warnings.end(),
                     [](const Warning& w) { return w.code == "ambient_changed"; });
}

// Steady light: 4.7 mm and 0.8 % (the office itself: 2.4 mm, 0.8 %).
void ExpectAsInSteadyLight(const Fitted& fitted) {
  EXPECT_EQ(fitted.fit.fit.status, FitStatus::kConverged);
  EXPECT_LT(fitted.position_m, 0.008);
  EXPECT_LT(fitted.ratio, 0.015);
}

TEST(DaylightOffice, SteadyLightIsSubtractedAsItIs) {
  const Fitted fitted = Fit([](int, State) { return 1.0; });
  ExpectAsInSteadyLight(fitted);
  EXPECT_TRUE(fitted.observed.ambient.share.empty());
  EXPECT_LT(fitted.observed.ambient.spread, 0.01);
  EXPECT_FALSE(fitted.fit.fit.state.ambient_shares_free);
  EXPECT_FALSE(Warns(fitted));
}

TEST(DaylightOffice, DuskFallsFromViewToView) {
  const Fitted fitted = Fit([](int number, State state) { return 1 - 0.04 * (number + 0.2 * state); });
  ExpectAsInSteadyLight(fitted);
  EXPECT_TRUE(Warns(fitted));
}

// Within a state views hardly differ: only the fit tells.
TEST(DaylightOffice, DuskFallsFromStateToState) {
  const Fitted fitted = Fit([](int number, State state) { return 1 - 0.06 * (state + 0.1 * number); });
  ExpectAsInSteadyLight(fitted);
  EXPECT_TRUE(fitted.fit.fit.state.ambient_shares_free);
  EXPECT_TRUE(Warns(fitted));
}

TEST(DaylightOffice, CloudsChangeItFromPhotoToPhoto) {
  const Fitted fitted =
      Fit([](int number, State state) { return 2 + 0.6 * std::sin(7.3 * number + 2.9 * state); });
  ExpectAsInSteadyLight(fitted);
  EXPECT_FALSE(fitted.observed.ambient.share.empty());
  EXPECT_TRUE(Warns(fitted));
}

TEST(DaylightOffice, TwoViewsTellTheOthers) {
  const Fitted fitted = Fit([](int, State) { return 1.0; }, [](int number) { return number % 4 == 0; });
  ExpectAsInSteadyLight(fitted);
  EXPECT_GE(fitted.observed.views_without_ambient.size(), 5U);
}

}  // namespace
}  // namespace luxfit
