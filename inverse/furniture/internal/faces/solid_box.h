// Makes the box behind a face.
//
// A top reaches to the floor where views agree on a side under it, an upright face to the mesh behind it if that is
// within 1.2 m and views do not look through there, and from there to the floor likewise. Else the box is 4 cm thick. There is none where views look
// through the box itself, or where it would bury a place that is free by more than 5 cm; by less, the face moves to it.
#ifndef LUXFIT_INVERSE_FURNITURE_INTERNAL_FACES_SOLID_BOX_H_
#define LUXFIT_INVERSE_FURNITURE_INTERNAL_FACES_SOLID_BOX_H_

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "forward/room/visibility.h"
#include "inverse/furniture/internal/faces/face.h"
#include "inverse/furniture/internal/view_rays.h"

namespace luxfit {

struct SolidBox {
  Eigen::AlignedBox3d box;  // along the room's axes
  bool is_thin = false;
};

// `rays`, `free_places`: along the room's axes.
std::optional<SolidBox> SolidBehind(const Face& face, const RoomAxes& axes, const RayScene& mesh,
                                    const SweptViews& swept, const std::vector<ViewRay>& rays,
                                    const std::vector<Eigen::Vector3d>& free_places);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_INTERNAL_FACES_SOLID_BOX_H_
