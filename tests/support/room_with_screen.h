// A small room of 3.2 m x 2.2 m x 2.4 m with a screen that stands free in it: some places see luminaires in part.
#ifndef LUXFIT_TESTS_SUPPORT_ROOM_WITH_SCREEN_H_
#define LUXFIT_TESTS_SUPPORT_ROOM_WITH_SCREEN_H_

#include "tests/support/scenes.h"

namespace luxfit::support {

inline Scene RoomWithScreen() {
  Scene scene = ClosedRoom({3.2, 2.2, 2.4}, {"wall", "wall", "wall", "wall", "floor", "wall"});
  AddBox(scene, {Eigen::Vector3d(1.55, 0.6, 0.2), Eigen::Vector3d(1.65, 1.6, 1.2)}, Facing::kOutward,
         {"screen"});
  return scene;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_ROOM_WITH_SCREEN_H_
