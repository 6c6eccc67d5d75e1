// A shop of 28 luminaires: four rows of five panels, and two tracks of four spots that are aimed at the walls.
//
//   8 +--------------------+   P: panels 0.6 m x 0.6 m, one switch a row
//     | s  s   track   s s |   s: spots of 26 degrees, one switch a track, each with an aim of its own
//     | P  P   P   P   P   |   12 m x 8 m, 3.2 m high, with three shelves 1.4 m high
//     | s  s   track   s s |
//   0 +--------------------+
//     0                   12
//
// The light tracer makes photos and readings (tests/support/inverse/traced_room.h).
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "forward/light/room.h"
#include "tests/support/inverse/traced_room.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

using Eigen::Vector3d;

constexpr Eigen::Index kRows = 4, kPanelsInRow = 5, kTracks = 2, kSpotsOnTrack = 4;
constexpr Eigen::Index kPanels = kRows * kPanelsInRow, kLuminaires = kPanels + kTracks * kSpotsOnTrack;

Scene Shop() {
  Scene scene = support::ClosedRoom({12, 8, 3.2}, {"wall", "wall", "wall", "wall", "floor", "ceiling"});
  for (const double x : {2.5, 5.5, 8.5})
    support::AddBox(scene, {Vector3d(x, 2.5, 0), Vector3d(x + 0.8, 5.5, 1.4)}, support::Facing::kOutward,
                    {"shelf"});
  return scene;
}

Luminaire Panel(int row, int place) {
  Luminaire panel;
  panel.id = "P" + std::to_string(row + 1) + std::to_string(place + 1);
  panel.position = {1.6 + 2.2 * place, 1.4 + 1.75 * row, 3.19};
  panel.shape = LuminaireShape::kRectangle;
  panel.size_m = {0.6, 0.6};
  panel.flux_lm = 3000;
  return panel;
}

Luminaire Spot(int track, int place) {
  Luminaire spot;
  spot.id = "S" + std::to_string(track + 1) + std::to_string(place + 1);
  spot.position = {2.0 + 2.6 * place, track == 0 ? 1.3 : 6.6, 2.8};
  spot.aim = Vector3d(0.25 * place - 0.4, track == 0 ? -0.6 : 0.7, -0.6).normalized();
  spot.distribution = Distribution::kCosinePower;
  spot.cosine_exponent = 26;
  spot.flux_lm = 1400;
  return spot;
}

support::TracedRoom TrueRoom() {
  support::TracedRoom room;
  room.truth = Shop();
  room.albedo = Eigen::Vector4d(0.65, 0.3, 0.75, 0.4);
  for (int row = 0; row < kRows; ++row)
    for (int i = 0; i < kPanelsInRow; ++i) room.luminaires.push_back(Panel(row, i));
  for (int track = 0; track < kTracks; ++track)
    for (int i = 0; i < kSpotsOnTrack; ++i) room.luminaires.push_back(Spot(track, i));
  room.dimming.assign(static_cast<size_t>(kRows + kTracks + 1), Eigen::VectorXd::Zero(kLuminaires));
  for (Eigen::Index row = 0; row < kRows; ++row)
    room.dimming[static_cast<size_t>(row)].segment(row * kPanelsInRow, kPanelsInRow).setOnes();
  for (Eigen::Index track = 0; track < kTracks; ++track)
    room.dimming[static_cast<size_t>(kRows + track)]
        .segment(kPanels + track * kSpotsOnTrack, kSpotsOnTrack)
        .setOnes();
  room.dimming.back().setOnes();
  room.eyes = {{0.4, 0.4, 1.7}, {11.6, 0.4, 1.6}, {11.6, 7.6, 1.7}, {0.4, 7.6, 1.6}, {6, 0.4, 1.6},
               {6, 7.6, 1.7},   {0.4, 4, 1.7},    {11.6, 4, 1.6},   {4.4, 4, 1.7},   {7.4, 4, 1.6}};
  for (const double y : {1.0, 4.0, 7.0})
    for (const double x : {1.0, 4.4, 7.4, 10.5}) room.places.push_back({{x, y, 0.9}, {0, 0, 1}, {}});
  return room;
}

TEST(Shop, EveryLuminaireIsFound) {
  const support::TracedRoom room = TrueRoom();
  RoomOptions options;
  options.patches.patch_size_m = 0.6;
  options.patches.element_size_m = 0.2;
  const Room model = MakeRoom(room.truth, options);
  std::mt19937_64 rng(3);
  support::TracedRoomOptions traced;
  traced.paths_per_point = 64;
  const RoomObservations given = support::ObserveTraced(room, model, rng, traced);
  support::ExpectFound(room, model, given);
}

}  // namespace
}  // namespace luxfit
