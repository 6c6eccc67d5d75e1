// Makes a closed room of three lengths, or of an outline on the floor with heights, boxes and rectangles on
// walls.
//
//   wall i = { c_i + s d_i + z e_z : 0 <= s <= L_i, 0 <= z <= h_i(s) }      d_i = (c_(i+1) - c_i) / L_i
//   h_i(s) = H_i + (H_(i+1) - H_i) s / L_i                                  H: heights over the corners
//
// Metres, world frame: x and y of the corners are the world's, the floor is z = 0, z is up. Corners may run
// either way round, and the outline may be concave. Wall i runs from corner i to the next, the last one back
// to the first. The ceiling is the plane through the corners' heights. Where they lie in no plane, it is
// folded along lines between corners: those that leave the fewest planes, the shorter where two leave as
// many. This makes a ridge of the two corners at the gables' tops.
//
// Walls, floor and ceiling face inwards, boxes outwards. Facets are parallelograms wherever the shape allows,
// so that patches are regular: walls are cut into rectangles beside the rectangles drawn on them, floors and
// plane ceilings whose corners have right angles likewise. Other polygons become triangles.
//
// Materials: "floor", "ceiling", "wall 1" to "wall n", and the names of boxes and rectangles. Things of equal
// name have one material.
//
// SceneFrom throws std::invalid_argument for an outline in which FindFault finds a fault.
#ifndef LUXFIT_FORWARD_MESH_OUTLINE_H_
#define LUXFIT_FORWARD_MESH_OUTLINE_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "forward/room/scene.h"

namespace luxfit {

// Furniture: a box with upright sides, turned about the vertical line through its middle.
struct RoomBox {
  std::string name;
  Eigen::Vector3d min_m = Eigen::Vector3d::Zero(), max_m = Eigen::Vector3d::Zero();  // before it is turned
  double turn_rad = 0;  // counter-clockwise seen from above
};

// A door, a window or a board: a part of a wall with a material of its own.
struct WallRectangle {
  std::string name;
  int wall = 0;                  // of RoomOutline, the first is 0
  double from_m = 0, to_m = 0;   // along the wall, from its first corner
  double low_m = 0, high_m = 0;  // above the floor
};

struct RoomOutline {
  std::vector<Eigen::Vector2d> corners_m;
  std::vector<double> heights_m;  // one for all corners, or one a corner
  std::vector<RoomBox> boxes;
  std::vector<WallRectangle> rectangles;
};

// Returns a room with a corner at the origin; its walls are y = 0, x = size, y = size, x = 0.
RoomOutline OutlineOfBox(const Eigen::Vector3d& size_m);

enum class OutlinePart { kCorners, kHeights, kBox, kRectangle };
struct OutlineFault {
  OutlinePart part = OutlinePart::kCorners;
  int index = 0;        // of the box or the rectangle
  std::string message;  // "expected ..., got ...; remedy", lengths in m, corners and walls counted from 1
};

// Returns the first thing that is wrong: corners that are too few, too close or make walls cross, a number of
// heights that is not that of the corners, boxes outside the room, rectangles that leave their wall or overlap.
std::optional<OutlineFault> FindFault(const RoomOutline& outline);

Scene SceneFrom(const RoomOutline& outline);

// Returns the scene with the boxes' six sides each, of materials named as the boxes.
Scene WithBoxes(Scene scene, const std::vector<RoomBox>& boxes);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_MESH_OUTLINE_H_
