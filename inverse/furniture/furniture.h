// Finds furniture that the mesh lacks, as upright boxes, where photos of several views agree on its faces.
//
//   face = the rectangle of a swept plane with the largest sum of votes          internal/plane_sweep.h
//   box  = face, extended behind it to the floor or the wall, or 4 cm thick (internal/solid_box.h)
//
// Planes are swept upwards and along the room's two main horizontal directions, every 2 cm. The strongest face is
// taken first; what it explains of the views' pixels takes no part in later ones. A view counts for a face only
// where the mesh does not explain what it sees. With two states and more, what is left is swept again at 5/3 of the tolerance, for
// varnished tops.
//
// Metres, world frame. Boxes stand along the room's main directions. Mirrors, black and thin things, and what fewer
// than three views see, are not found. What is not a box becomes the boxes of its large flat faces.
// Source: own; Collins (1996) for the sweep, Bentley (1984) for rectangles.
#ifndef LUXFIT_INVERSE_FURNITURE_FURNITURE_H_
#define LUXFIT_INVERSE_FURNITURE_FURNITURE_H_

#include <Eigen/Core>
#include <vector>

#include "forward/mesh/outline.h"
#include "forward/room/scene.h"
#include "inverse/furniture/signature_view.h"

namespace luxfit {

struct FurnitureOptions {
  // Two signatures agree within this, of ln Y: three times what registration and interpolation leave on matt walls.
  double tolerance = 0.015;
  // Smaller faces hide and absorb little, and mirror images in a shiny board made one of 0.15 m2 in a classroom.
  double least_face_m2 = 0.2;
  int most_boxes = 40;
  // Where no solid is: meters stood there, or tags lie there, world frame. A face that would bury one by up to 5 cm
  // moves to it; a box that would bury one deeper is none.
  std::vector<Eigen::Vector3d> free_places;
};

struct FoundBox {
  RoomBox box;              // named "found 1" and so on, the largest face first
  double face_area_m2 = 0;  // of the cells that views agree on
  int views = 0;            // that agree on the face
  double sigma_m = 0;       // of the face along its normal
  bool is_upright = false;  // the face is upright; else it is the top
  bool is_thin = false;     // views look through behind the face
};

// Views have the same states. Fewer than three find nothing.
std::vector<FoundBox> FindFurniture(const Scene& scene, const std::vector<SignatureView>& views,
                                    const FurnitureOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_FURNITURE_H_
