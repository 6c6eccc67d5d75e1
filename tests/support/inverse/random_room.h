// Furnished rooms drawn at random, for sweeps: plan, furniture, reflectances, luminaires, switches, views and readings.
//
// Boxes of 3 to 10 m, corridors, and L-shapes, 2.4 to 3.4 m high; desks and cabinets that do not overlap; one to twelve luminaires of
// one or two kinds: panels, strips, downlights, globes on pendants; spots (half of the peak at 10 to 30 degrees) that shine straight down,
// turned by up to 40 degrees, or at a wall beside them (washers); and pendants that shine up and down. Switched alone or kind by kind, and all
// on in the last state. World frame, metres; a corner of the room at the origin. Nothing here was chosen by how well it is fitted.
#ifndef LUXFIT_TESTS_SUPPORT_INVERSE_RANDOM_ROOM_H_
#define LUXFIT_TESTS_SUPPORT_INVERSE_RANDOM_ROOM_H_

#include <Eigen/Geometry>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "tests/support/inverse/traced_room.h"

namespace luxfit::support {

struct Furniture {
  Eigen::AlignedBox3d box;
  std::string material;
};

struct RandomRoom {
  TracedRoom room;
  Scene shell;  // without furniture
  std::vector<Furniture> pieces;
  Scene mesh;         // what the fit is given: as `room.truth` is drawn
  std::string words;  // "L of 7.2 m x 5.1 m x 2.7 m, 4 boxes, 6 panels + 2 globes in 3 states, 8 views"
  std::vector<std::string> kinds;  // by luminaire: "panels"
  double area_m2 = 0;              // of the floor
};

RandomRoom DrawRoom(std::mt19937_64& rng);

// A room drawn by a seed, its model of patches of 0.4 m, and what photos of few paths a point and a luxmeter tell of it.
struct ObservedRandomRoom {
  RandomRoom drawn;
  Room model;
  RoomObservations given;
};
ObservedRandomRoom ObserveRandomRoom(std::uint64_t seed);

// The same with photos and readings of the last state alone, in which all luminaires are on.
ObservedRandomRoom ObserveRandomRoomAllOn(std::uint64_t seed);

// Materials come in the order of the pieces: those of the first few pieces begin those of all.
Scene WithFurniture(Scene shell, const std::vector<Furniture>& pieces);

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_INVERSE_RANDOM_ROOM_H_
