// Gives rectangles on a scene's facets materials of their own: doors, windows, boards and posters that the mesh lacks.
//
//   rectangle = { corner + s edge_u + t edge_v : 0 <= s, t <= 1 }
//
// A parallelogram in the rectangle's plane that faces as it does, with edges parallel to its own, is cut into what the rectangle
// covers and up to four strips beside it. Other facets stay whole, and so do scenes that cover their facets in part (Scene::surface).
// A strip narrower than 5 mm goes to the rectangle. Metres, world frame.
#ifndef LUXFIT_FORWARD_CHANGES_PAINTED_RECTANGLES_H_
#define LUXFIT_FORWARD_CHANGES_PAINTED_RECTANGLES_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "forward/room/scene.h"

namespace luxfit {

struct PaintedRectangle {
  std::string name;                        // also its material's
  Eigen::Vector3d corner, edge_u, edge_v;  // edge_u x edge_v points to its front
};

Scene WithPaintedRectangles(Scene scene, const std::vector<PaintedRectangle>& rectangles);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_CHANGES_PAINTED_RECTANGLES_H_
