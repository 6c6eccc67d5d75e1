// Lists how readings are mistaken: each a way to read their table otherwise.
//
//   x and y exchanged, x or y counted from the opposite wall, and what these make together
//   directions reversed
//   places, or heights alone, in another unit
//   meter on top of what stands at its place
//   all heights off by one length, free in steps of 5 cm
//   all heads tilted alike, by 3 to 12 degrees, towards one of eight directions
//   two states written for each other
//   the readings that set the scale off by a factor, free; all readings, where something else sets the scale
//
// Frame: the room's, m. Mirrored places are mirrored in the room's bounding box.
#ifndef LUXFIT_INVERSE_CHECK_INTERNAL_MISREADING_H_
#define LUXFIT_INVERSE_CHECK_INTERNAL_MISREADING_H_

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "inverse/check/explain_readings.h"

namespace luxfit {

// Reads the table in one way.
struct Rereading {
  std::string as_if;                                // completes "the readings look as if ..."
  std::function<Sensor(const Sensor&)> place = {};  // empty: as given
  std::pair<int, int> exchanged_states = {-1, -1};
};

// Holds one mistake in all the ways that it can be made; which one is chosen by the readings.
struct Misreading {
  std::vector<Rereading> ways;
  std::string remedy;
  bool has_own_scale = false;  // true: the readings that do not set the scale choose g
};

std::vector<Misreading> Misreadings(const ExplainingLight& light);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHECK_INTERNAL_MISREADING_H_
