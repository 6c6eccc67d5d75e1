// Returns a room with the same elements, whose patches are the clusters of the given one's (Patch::cluster).
//
//   F_eJ = sum_{j in J} F_ej        e: element, J: cluster of patches j
//
// Light that a cluster reflects counts as even over it. Visibility and the form factors of sensors are those of the
// elements, so they serve both rooms. A cluster's elements are those that name it: first_element and element_count are 0,
// since they are not numbered consecutively. Throws std::invalid_argument for a sparse room, which has no matrices to add up.
//
// Source: Smits, Arvo, Greenberg (1994), "A clustering algorithm for radiosity in complex environments".
#ifndef LUXFIT_FORWARD_LIGHT_INTERNAL_CLUSTERED_ROOM_H_
#define LUXFIT_FORWARD_LIGHT_INTERNAL_CLUSTERED_ROOM_H_

#include "forward/light/room.h"

namespace luxfit {

// Returns whether clusters are so many fewer than patches that they save time worth their memory.
bool HasClusters(const Patches& patches);

Room ClusteredRoom(const Room& room);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LIGHT_INTERNAL_CLUSTERED_ROOM_H_
