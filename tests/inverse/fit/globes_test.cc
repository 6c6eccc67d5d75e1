// Globes on pendants: half of their light goes up, where a lobe that is aimed down sends none.
//
// Found by study_random_rooms: four of them ended as Lambertian points, fluxes 40 to 50 % too low. The light tracer makes
// photos and readings (tests/support/inverse/traced_room.h).
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <random>
#include <string>

#include "forward/light/room.h"
#include "tests/support/inverse/traced_room.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

using Eigen::Vector3d;

support::TracedRoom TrueRoom() {
  support::TracedRoom room;
  room.truth = support::ClosedRoom({5.4, 5.2, 3.0}, {"wall", "wall", "wall", "wall", "floor", "ceiling"});
  support::AddBox(room.truth, {Vector3d(3.6, 3.9, 0.7), Vector3d(5.2, 4.7, 0.73)}, support::Facing::kOutward,
                  {"desk"});
  room.albedo = Eigen::Vector4d(0.69, 0.37, 0.82, 0.16);
  for (const Vector3d& p : {Vector3d(4.7, 1.7, 2.36), {0.55, 2.35, 2.36}, {2.7, 2.1, 2.36}, {1, 4, 2.36}}) {
    Luminaire globe;
    globe.id = std::string(1, static_cast<char>('A' + room.luminaires.size()));
    globe.position = p;
    globe.shape = LuminaireShape::kSphere;
    globe.size_m.setConstant(0.28);
    globe.distribution = Distribution::kIsotropic;
    globe.flux_lm = 1200;
    room.luminaires.push_back(globe);
  }
  room.dimming.assign(5, Eigen::VectorXd::Zero(4));
  for (Eigen::Index k = 0; k < 4; ++k) room.dimming[static_cast<size_t>(k)][k] = 1;
  room.dimming.back().setOnes();
  room.eyes = {{0.4, 0.4, 1.6}, {5, 0.4, 1.5},   {5, 3.5, 1.6},
               {0.4, 4.8, 1.5}, {2.7, 4.8, 1.7}, {2.7, 0.4, 1.6}};
  for (const double y : {0.9, 2.6})
    for (const double x : {0.9, 2.7, 4.5}) room.places.push_back({{x, y, 0.85}, {0, 0, 1}, {}});
  return room;
}

TEST(Globes, ShineToAllSides) {
  const support::TracedRoom room = TrueRoom();
  RoomOptions options;
  options.patches.patch_size_m = 0.4;
  options.patches.element_size_m = 0.2;
  const Room model = MakeRoom(room.truth, options);
  std::mt19937_64 rng(3);
  const RoomObservations given = support::ObserveTraced(room, model, rng);
  support::FoundLimits limits;
  limits.off_mm = 10;
  limits.common_error_mm = 5;
  support::ExpectFound(room, model, given, limits);
}

}  // namespace
}  // namespace luxfit
