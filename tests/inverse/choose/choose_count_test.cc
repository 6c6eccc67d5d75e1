#include "inverse/choose/internal/choose_count.h"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "forward/light/light_tracer.h"
#include "forward/luminaire/luminaire_parts.h"
#include "inverse/model/internal/measured_indirect.h"
#include "tests/support/closed_forms.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

constexpr double kRho = 0.5;

Luminaire Downlight(const Eigen::Vector3d& position, double flux_lm) {
  Luminaire lamp;
  lamp.position = position;
  lamp.flux_lm = flux_lm;
  lamp.distribution = Distribution::kLambertian;
  return lamp;
}

// A room of 4 m x 3 m x 2.5 m under some luminaires that are all on, photographed by the light tracer, which
// shares no patch with the form factors: 1 to 2 % of noise in the indirect light.
class CountedRoom : public testing::Test {
 protected:
  LightData Photograph(const std::vector<Luminaire>& lamps) const {
    std::vector<Sensor> sensors;
    std::vector<int> elements;
    for (size_t e = 0; e < room_.patches.elements.size(); e += 2) {
      const Element& element = room_.patches.elements[e];
      sensors.push_back({element.center, element.normal, {}});
      elements.push_back(static_cast<int>(e));
    }
    LightTracerOptions options;
    options.paths_per_sensor = 512;
    const TracedIlluminance traced = TraceIlluminance(room_.scene, room_.rays, lamps,
                                                      Eigen::VectorXd::Constant(1, kRho), sensors, options);
    LightData data;
    data.dimming = {Eigen::VectorXd()};
    for (size_t i = 0; i < elements.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      Observation o;
      o.element = elements[i];
      o.relative_luminance =
          1e-4 * kRho / support::kPi * (traced.direct.row(row).sum() + traced.indirect.row(row).sum());
      o.variance = std::pow(0.01 * o.relative_luminance, 2);
      data.observations.push_back(o);
    }
    return data;
  }

  int Count(const std::vector<Luminaire>& lamps, const std::vector<SeenPlace>& places = {}) const {
    return ChooseLuminaireCount(room_, WithMeasuredIndirect(room_, Photograph(lamps)), unknown_, {}, places)
        .chosen;
  }

  Room room_ = MakeRoom(support::ClosedRoom({4, 3, 2.5}), {{0.5, 0.25}, {64}});
  LightState unknown_ = [] {
    LightState state;
    state.albedo = Eigen::VectorXd::Constant(1, 0.5);
    state.albedo_free = {true};
    return state;
  }();
};

TEST_F(CountedRoom, OneTwoAndThreeAreCounted) {
  const Luminaire a = Downlight({1.1, 1.2, 2.4}, 2000), b = Downlight({3.1, 2.1, 2.35}, 1500),
                  c = Downlight({2.9, 0.6, 2.4}, 1000);
  EXPECT_EQ(Count({a}), 1);
  EXPECT_EQ(Count({a, b}), 2);
  EXPECT_EQ(Count({a, b, c}), 3);
}

// A panel is one luminaire, though several points would do as well.
TEST_F(CountedRoom, ALargeOneIsNotSeveral) {
  Luminaire panel = Downlight({2.1, 1.4, 2.4}, 3000);
  panel.shape = LuminaireShape::kRectangle;
  panel.size_m = {1.0, 1.0};
  EXPECT_EQ(Count({panel}), 1);
}

SeenPlace Seen(const Eigen::Vector3d& position) {
  SeenPlace place;
  place.position = position;
  place.sigma_m = 0.03;
  place.views = 3;
  place.area_m2 = 0.09;
  return place;
}

// Each lights the ceiling, too: lobes to one side would need another one above each.
TEST_F(CountedRoom, PendantsThatShineUpAndDownAreAsManyAsPhotosShow) {
  std::vector<Luminaire> lamps;
  std::vector<SeenPlace> places;
  for (const double x : {0.8, 2.0, 3.2}) {
    Luminaire pendant = Downlight({x, 1.5, 1.8}, 1500);
    pendant.distribution = Distribution::kMeasured;
    pendant.table = std::make_shared<IntensityTable>(TwoSidedTable(0.4));
    lamps.push_back(pendant);
    places.push_back(Seen(pendant.position + Eigen::Vector3d(-0.02, 0.02, 0.01)));
  }
  EXPECT_EQ(Count(lamps, places), 3);
  places.pop_back();
  lamps.pop_back();
  EXPECT_EQ(Count(lamps, places), 2);
}

// To the ceiling 0.4 m above, a point at its middle would be another luminaire.
TEST_F(CountedRoom, ALongPendantIsOne) {
  Luminaire pendant = Downlight({1.9, 1.4, 2.1}, 3000);
  pendant.shape = LuminaireShape::kRectangle;
  pendant.size_m = {1.6, 0.2};
  pendant.distribution = Distribution::kMeasured;
  pendant.table = std::make_shared<IntensityTable>(TwoSidedTable(0.4));
  SeenPlace place = Seen(pendant.position + Eigen::Vector3d(0.02, -0.02, 0.01));
  place.area_m2 = 0.32;
  place.size_m = {1.65, 0.22};
  EXPECT_EQ(Count({pendant}, {place}), 1);
  const Luminaire downlight = Downlight({3.1, 2.4, 2.4}, 800);
  EXPECT_EQ(Count({pendant, downlight}, {place}), 2);  // which photos do not show
}

// Bright things that give no light are seen as surely.
TEST_F(CountedRoom, LuminairesThatPhotosShowAreCountedAndOtherBrightThingsAreNot) {
  std::vector<Luminaire> lamps;
  std::vector<SeenPlace> places;
  for (int i = 0; i < 6; ++i) {
    Luminaire lamp = Downlight({0.8 + 1.2 * (i % 3), i < 3 ? 0.9 : 2.1, 2.4}, 800);
    lamp.shape = LuminaireShape::kRectangle;
    lamp.size_m = {0.3, 0.3};
    lamps.push_back(lamp);
    places.push_back(Seen(lamp.position + Eigen::Vector3d(0.02, -0.02, 0.01)));
  }
  EXPECT_EQ(Count(lamps, places), 6);
  places.push_back(Seen({2.1, 1.5, 0.3}));  // a mirror image: it shines upwards, and gives no light
  EXPECT_EQ(Count(lamps, places), 6);
  places[6].position.z() = 2.2;
  places[6].views = 2;  // may be chance
  EXPECT_EQ(Count(lamps, places), 6);
}

// The first two alone explain the light badly: beside a luminaire that lacks, one of them may seem dark.
TEST_F(CountedRoom, ADoubtfulPlaceCountsWhereItHelps) {
  const std::vector<Luminaire> lamps = {Downlight({1.1, 1.2, 2.4}, 2000), Downlight({3.1, 2.1, 2.35}, 1500),
                                        Downlight({2.9, 0.6, 2.4}, 1000)};
  std::vector<SeenPlace> places;
  places.reserve(lamps.size());
  for (const Luminaire& lamp : lamps) places.push_back(Seen(lamp.position));
  places[0].views = 2;
  EXPECT_EQ(Count(lamps, places), 3);
  places.push_back(Seen({2.0, 1.5, 2.2}));
  places[3].views = 2;
  EXPECT_EQ(Count(lamps, places), 3);
}

// Photos show the first three, alike; the fourth lights a room that they alone explain badly.
TEST_F(CountedRoom, AlikeOnesStayWhereTheyExplainTheLightBadly) {
  const std::vector<Luminaire> lamps = {Downlight({0.9, 1.2, 2.4}, 800), Downlight({2.1, 1.2, 2.4}, 800),
                                        Downlight({3.3, 1.2, 2.4}, 800), Downlight({3.6, 2.6, 0.9}, 3000)};
  std::vector<SeenPlace> places;
  places.reserve(3);
  for (int i = 0; i < 3; ++i) places.push_back(Seen(lamps[static_cast<size_t>(i)].position));
  EXPECT_EQ(Count(lamps, places), 4);
}

// Three bright posters share their light, and go together.
TEST_F(CountedRoom, AlikeOnesThatGiveNoLightAreLeftOut) {
  const std::vector<Luminaire> lamps = {Downlight({1.1, 1.2, 2.4}, 2000), Downlight({3.1, 2.1, 2.35}, 1500)};
  std::vector<SeenPlace> places;
  places.reserve(lamps.size());
  for (const Luminaire& lamp : lamps) places.push_back(Seen(lamp.position));
  places[1].area_m2 = 0.04;  // unlike the first
  for (const double x : {0.8, 2.0, 3.2}) places.push_back(Seen({x, 0.02, 1.3}));
  EXPECT_EQ(Count(lamps, places), 2);
}

// One that photos do not show is found by its light.
TEST_F(CountedRoom, WhatPhotosDoNotShowIsAdded) {
  const Luminaire a = Downlight({1.1, 1.2, 2.4}, 2000), b = Downlight({3.1, 2.1, 2.35}, 1500);
  EXPECT_EQ(Count({a, b}, {Seen(a.position)}), 2);
}

TEST_F(CountedRoom, TheLargestNumberAllowedIsSaid) {
  ChooseCountOptions options;
  options.max_count = 1;
  const LightData data = WithMeasuredIndirect(
      room_, Photograph({Downlight({1.1, 1.2, 2.4}, 2000), Downlight({3.1, 2.1, 2.35}, 1500)}));
  EXPECT_TRUE(ChooseLuminaireCount(room_, data, unknown_, {}, {}, {}, options).reached_max);
  options.max_count = -1;
  EXPECT_THROW(ChooseLuminaireCount(room_, data, unknown_, {}, {}, {}, options), std::invalid_argument);
}

TEST_F(CountedRoom, NothingSeenIsNothingCounted) {
  LightData data;
  data.dimming = {Eigen::VectorXd()};
  data.indirect_is_held = true;
  EXPECT_EQ(ChooseLuminaireCount(room_, data, unknown_).chosen, 0);
}

}  // namespace
}  // namespace luxfit
