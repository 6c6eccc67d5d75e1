// The office that an independent renderer photographed, its photos and states described wrongly: the mistake is named, and
// nothing is where the description is right.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "apps/session/tag_map.h"
#include "calib/lens/camera_file.h"
#include "forward/light/room.h"
#include "forward/mesh/mesh_file.h"
#include "forward/room/scene.h"
#include "inverse/observe/as_if/internal/srgb_observations.h"
#include "inverse/observe/as_if/photos_as_if.h"
#include "inverse/observe/as_if/states_as_if.h"
#include "inverse/observe/observe_photos.h"
#include "tests/support/office_photos.h"
#include "tests/support/office_truth.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::kOfficeFolder;
using support::OfficeStates;
using testing::HasSubstr;

enum State { kA, kB, kC, kD, kAll, kEvening };
enum Lamp { kLampA, kLampB, kLampC, kLampD };

struct Office {
  Room room;
  std::vector<Observation> observations;
  std::vector<RegisteredView> views;
};

const Office& TheOffice() {
  static const Office office = [] {
    const std::vector<Camera> cameras{ReadCamera(kOfficeFolder + "cam0.yaml")};
    Room room = MakeRoom(ReadScene(kOfficeFolder + "room.obj"));
    PhotoObservations observed = ObservePhotos(room, cameras, ReadTagMap(kOfficeFolder + "tags.json"),
                                               support::OfficePhotos(), support::OfficeStates());
    return Office{std::move(room), std::move(observed.observed.evidence.observations),
                  std::move(observed.registration.views)};
  }();
  return office;
}

// Returns the observations as they are once the states of a view's photos are written for each other; all views: -1.
std::vector<Observation> Exchanged(std::vector<Observation> observations, int view, int a, int b) {
  for (Observation& o : observations)
    if (view < 0 || o.view == view) o.state = o.state == a ? b : (o.state == b ? a : o.state);
  return observations;
}

std::vector<PhotoAsIf> FoundPhotos(const std::vector<Observation>& observations) {
  return FindPhotosAsIf(TheOffice().room.patches, observations);
}

std::vector<StateExplanation> FoundStates(const std::vector<Observation>& observations,
                                          const StateTable& table) {
  return FindStatesAsIf(TheOffice().room.patches, observations, table);
}

TEST(MisdescribedOffice, ARightDescriptionIsLeftAlone) {
  EXPECT_TRUE(FoundPhotos(TheOffice().observations).empty());
  EXPECT_TRUE(FoundStates(TheOffice().observations, OfficeStates()).empty());
}

bool HasPhoto(int view, int state) {
  const std::vector<Observation>& all = TheOffice().observations;
  return std::any_of(all.begin(), all.end(),
                     [&](const Observation& o) { return o.view == view && o.state == state; });
}

// Every exchange of two photos of one view.
TEST(MisdescribedOffice, TwoPhotosOfAViewExchanged) {
  int cases = 0, named = 0, wrong = 0;
  double worst = 0, least = 1;
  for (int view = 0; view < static_cast<int>(TheOffice().views.size()); ++view) {
    for (int a = kA; a <= kEvening; ++a) {
      for (int b = a + 1; b <= kEvening; ++b) {
        if (!HasPhoto(view, a) || !HasPhoto(view, b)) continue;
        const std::vector<PhotoAsIf> found = FoundPhotos(Exchanged(TheOffice().observations, view, a, b));
        int of_both = 0;
        for (const PhotoAsIf& p : found) {
          const bool is_right = p.view == view && p.is_exchanged && p.state + p.as_if == a + b &&
                                (p.state == a || p.state == b);
          ++(is_right ? of_both : wrong);
          worst = std::max(worst, p.difference_as_if);
          least = std::min(least, p.difference);
        }
        ++cases;
        named += of_both == 2 ? 1 : 0;
        if (of_both != 2)
          std::printf("%s: states %d and %d are not named\n",
                      TheOffice().views[static_cast<size_t>(view)].view.c_str(), a, b);
      }
    }
  }
  std::printf(
      "%d of %d exchanges named, %d photos named wrongly; differences at least %.1f %%, so read %.1f %%\n",
      named, cases, wrong, 100 * least, 100 * worst);
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(named, cases);
}

CountedShares OfficeShares() {
  CountedShares shares;
  const std::vector<RegisteredView>& views = TheOffice().views;
  for (const std::vector<std::string>& row : support::OfficeTable("photos.csv")) {
    for (size_t v = 0; v < views.size(); ++v)
      if (views[v].view == row[2])
        shares[{static_cast<int>(v), support::OfficeStateIndex(row[3])}] = std::stod(row[4]);
  }
  return shares;
}

// IEC 61966-2-1, of means over elements: tests/validation/catalogue encodes pixels.
std::vector<Observation> EncodedInSrgb(std::vector<Observation> observations, std::pair<int, int> photo,
                                       double exposure_s) {
  for (Observation& o : observations) {
    if (std::pair(o.view, o.state) != photo) continue;
    for (double& y : o.relative_rgb) {
      const double x = exposure_s * y;
      y = (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055) / exposure_s;
    }
    const double luminance = LuminanceOptions().weights.dot(o.relative_rgb);
    o.variance *= std::pow(luminance / o.relative_luminance, 2);
    o.relative_luminance = luminance;
  }
  return observations;
}

// Each photo in turn encoded among linear ones. Three views show the state evening: of those that share a surface, one that
// differs leaves but one to speak against it.
TEST(MisdescribedOffice, APhotoEncodedInSrgb) {
  const CountedShares shares = OfficeShares();
  const auto find = [&](const std::vector<Observation>& observations) {
    return FindPhotosAsIf(TheOffice().room.patches, observations, shares);
  };
  EXPECT_TRUE(find(TheOffice().observations).empty());
  int named = 0;
  double worst = 0, least = 1;
  for (const auto& [photo, exposure_s] : shares) {
    const std::vector<PhotoAsIf> found = find(EncodedInSrgb(TheOffice().observations, photo, exposure_s));
    const std::string name =
        TheOffice().views[static_cast<size_t>(photo.first)].view + ", state " + std::to_string(photo.second);
    for (const PhotoAsIf& p : found) {
      EXPECT_TRUE(p.is_srgb && std::pair(p.view, p.state) == photo) << name;
      worst = std::max(worst, p.difference_as_if);
      least = std::min(least, p.difference);
    }
    named += found.size() == 1 ? 1 : 0;
    if (photo.second != kEvening) {
      EXPECT_EQ(found.size(), 1u) << name;
    }
    if (found.empty()) std::printf("%s is not named\n", name.c_str());
  }
  std::printf("%d of %zu encoded photos named; differences at least %.1f %%, so read at most %.1f %%\n",
              named, shares.size(), 100 * least, 100 * worst);
}

// All photos encoded look like states that do not add up. Linear ones do not look encoded where the table is wrong.
TEST(MisdescribedOffice, ATableIsNotAccusedOfAToneCurve) {
  const CountedShares shares = OfficeShares();
  const Patches& patches = TheOffice().room.patches;
  std::vector<Observation> encoded = TheOffice().observations;
  for (const auto& [photo, exposure_s] : shares)
    encoded = EncodedInSrgb(std::move(encoded), photo, exposure_s);
  EXPECT_FALSE(FoundStates(encoded, OfficeStates()).empty());
  EXPECT_TRUE(FindStatesAsIf(patches, encoded, OfficeStates(), DecodedSrgb(encoded, shares)).empty());
  StateTable table = OfficeStates();
  table.dimming[kEvening][kLampA] = 1;
  const std::vector<Observation>& linear = TheOffice().observations;
  EXPECT_FALSE(FindStatesAsIf(patches, linear, table, DecodedSrgb(linear, shares)).empty());
}

TEST(MisdescribedOffice, APhotoOfAnotherStateIsNamedAlone) {
  std::vector<Observation> observations;
  for (Observation o : TheOffice().observations) {
    if (o.view == 3 && o.state == kD) continue;
    observations.push_back(o);
    if (o.view == 3 && o.state == kC) {
      o.state = kD;
      observations.push_back(o);  // the photo of C was copied over that of D
    }
  }
  const std::vector<PhotoAsIf> found = FoundPhotos(observations);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].view, 3);
  EXPECT_EQ(found[0].state, kD);
  EXPECT_EQ(found[0].as_if, kC);
  EXPECT_FALSE(found[0].is_exchanged);
}

TEST(MisdescribedOffice, ExposuresOffByAFifthAreNoOtherState) {
  std::mt19937_64 rng = support::TestRng();
  std::normal_distribution<double> normal;
  std::map<std::pair<int, int>, double> factor;
  std::vector<Observation> observations = TheOffice().observations;
  for (Observation& o : observations) {
    const auto at = factor.emplace(std::pair(o.view, o.state), std::exp(0.2 * normal(rng))).first;
    o.relative_luminance *= at->second;
    o.variance *= at->second * at->second;
  }
  EXPECT_TRUE(FoundPhotos(observations).empty());
  EXPECT_TRUE(FoundStates(observations, OfficeStates()).empty());
}

std::vector<Observation> WithTwiceTheLight(int state) {
  std::vector<Observation> observations = TheOffice().observations;
  for (Observation& o : observations)
    if (o.state == state) o.relative_luminance *= 2, o.variance *= 4;
  return observations;
}

// A dimmed state and longer exposures are one: self-calibration takes it out.
TEST(MisdescribedOffice, AllPhotosOfAStateTwiceAsBrightAreNoMistake) {
  EXPECT_TRUE(FoundPhotos(WithTwiceTheLight(kA)).empty());
  EXPECT_TRUE(FoundStates(WithTwiceTheLight(kA), OfficeStates()).empty());
}

// B shines in two states: nothing tells which of both is off.
TEST(MisdescribedOffice, WhatExplainsThePhotosEquallyIsNamedBesideIt) {
  const std::vector<StateExplanation> found = FoundStates(WithTwiceTheLight(kB), OfficeStates());
  ASSERT_EQ(found.size(), 2u);
  EXPECT_THAT(InWords(found), HasSubstr("all of state B gave 2.00 times the light"));
  EXPECT_THAT(InWords(found), HasSubstr("B was at 0.50 in state all"));
}

void ExpectExplained(const StateTable& table, const std::vector<std::string>& as_if) {
  const std::vector<StateExplanation> found = FoundStates(TheOffice().observations, table);
  ASSERT_EQ(found.size(), as_if.size()) << (found.empty() ? "" : InWords(found));
  std::printf("%s\n", InWords(found).c_str());
  std::string all;
  for (const StateExplanation& e : found) all += e.as_if + "\n";
  for (const std::string& words : as_if) EXPECT_THAT(all, HasSubstr(words));
  EXPECT_LT(found[0].difference, 0.02);
  EXPECT_GT(found[0].difference_as_given, 3 * found[0].difference);
}

TEST(MisdescribedOffice, AWrongDimmingValue) {
  for (const double given : {1.0, 0.6, 0.03}) {
    StateTable table = OfficeStates();
    table.dimming[kEvening][kLampA] = given;
    ExpectExplained(table, {"A was at 0.30 in state evening"});
  }
}

TEST(MisdescribedOffice, ALuminaireMissingFromAState) {
  for (const int lamp : {kLampA, kLampB, kLampC, kLampD}) {
    StateTable table = OfficeStates();
    table.dimming[kAll][lamp] = 0;
    ExpectExplained(table, {table.luminaires[static_cast<size_t>(lamp)] + " was on at 1.00 in state all"});
  }
}

TEST(MisdescribedOffice, ALuminaireSaidToBeOn) {
  StateTable table = OfficeStates();
  table.dimming[kEvening][kLampB] = 1;
  ExpectExplained(table, {"B was off in state evening, where [states] has 1.00"});
}

TEST(MisdescribedOffice, TwoStatesExchanged) {
  StateTable table = OfficeStates();
  std::swap(table.dimming[kA], table.dimming[kB]);
  ExpectExplained(table, {"states A and B were exchanged", "A and B were exchanged in state evening"});
  table = OfficeStates();
  std::swap(table.dimming[kAll], table.dimming[kEvening]);
  ExpectExplained(table, {"states all and evening were exchanged"});
}

TEST(MisdescribedOffice, AsManyStatesAsLuminairesTellNothing) {
  std::vector<Observation> observations;
  for (const Observation& o : TheOffice().observations)
    if (o.state < kAll) observations.push_back(o);
  StateTable table = OfficeStates();
  std::swap(table.dimming[kA], table.dimming[kB]);
  EXPECT_TRUE(FoundStates(observations, table).empty());
}

}  // namespace
}  // namespace luxfit
