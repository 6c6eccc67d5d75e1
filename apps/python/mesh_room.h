// Keeps a room of the Python module with what it was made of, so that it can be made again with other furniture.
#ifndef LUXFIT_APPS_PYTHON_MESH_ROOM_H_
#define LUXFIT_APPS_PYTHON_MESH_ROOM_H_

#include "forward/light/room.h"
#include "forward/room/scene.h"

namespace luxfit {

struct MeshRoom : Room {
  Scene mesh;  // as given
  RoomOptions options;
};

}  // namespace luxfit

#endif  // LUXFIT_APPS_PYTHON_MESH_ROOM_H_
