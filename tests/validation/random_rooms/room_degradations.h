// Makes a room drawn at random differ from what is said of it: a table of degradations, one at a time, each with levels.
//
//   faces_removed         %     of the furniture, which the mesh lacks
//   faces_added           %     of the mesh's furniture, which the room lacks
//   texture               %     of reflectance, 1 sigma, from tile to tile of half a metre, on floor and walls
//   posters               1     on the walls, 0.7 m x 1 m, of any reflectance; the mesh lacks them
//   noise                 %     of a pixel's value
//   views_dropped         %     of the views
//   luminaire_dimmed      %     of its light that one luminaire gives in the last state, where the table has 100
//   photos_exchanged            two photos of one view
//   photo_exposure        x     one photo's exposure against the stated one
//   reading               x     one reading that checks against the true one
//   scale_reading         x     the reading that sets the scale
//
// Those that luxfit chart --stability has, too, have its names and units. Each either changes the room before the light
// tracer photographs it, or what photos and readings tell.
#ifndef LUXFIT_TESTS_VALIDATION_RANDOM_ROOMS_ROOM_DEGRADATIONS_H_
#define LUXFIT_TESTS_VALIDATION_RANDOM_ROOMS_ROOM_DEGRADATIONS_H_

#include <optional>
#include <random>
#include <string>
#include <vector>

#include "inverse/fit/room_observations.h"
#include "tests/support/inverse/random_room.h"

namespace luxfit {

// Says which warning names the cause: its code, and words that its message has. No code: no warning is of this cause.
struct NamedCause {
  std::string code;
  std::vector<std::string> words;
};

struct RoomDegradation {
  std::string name;
  std::vector<double> levels;
  // One of the two is set. Each returns the cause; nothing where the room does not allow it.
  std::optional<NamedCause> (*of_room)(double level, std::mt19937_64& rng, support::RandomRoom& drawn);
  std::optional<NamedCause> (*of_data)(double level, std::mt19937_64& rng, RoomObservations& given);
};

const std::vector<RoomDegradation>& RoomDegradations();

}  // namespace luxfit

#endif  // LUXFIT_TESTS_VALIDATION_RANDOM_ROOMS_ROOM_DEGRADATIONS_H_
