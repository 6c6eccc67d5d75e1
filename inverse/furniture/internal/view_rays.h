// Holds rays of the views' pixels to the mesh, and counts those that pass through a box.
//
// A pixel that the mesh explains says that the way to the mesh is free; one that it does not says that something
// stands on the way.
#ifndef LUXFIT_INVERSE_FURNITURE_INTERNAL_VIEW_RAYS_H_
#define LUXFIT_INVERSE_FURNITURE_INTERNAL_VIEW_RAYS_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "inverse/furniture/internal/mesh_agreement.h"

namespace luxfit {

struct ViewRay {
  Eigen::Vector3d from, to;
  bool is_free = false;
};

// Returns those of every third cell, in which views can be compared. `axes_from_world` turns them.
std::vector<ViewRay> ViewRays(const std::vector<SignatureView>& views, const std::vector<MeshAgreement>& mesh,
                              const Eigen::Matrix3d& axes_from_world);

// Tells whether the line from a to b meets the box.
bool Meets(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& a, const Eigen::Vector3d& b);

// Holds how many rays pass through a box, and how many of them are free.
struct RayCount {
  int all = 0, free = 0;
};
// Counts the rays that meet the box, and not `before`.
RayCount CountRays(const std::vector<ViewRay>& rays, const Eigen::AlignedBox3d& box,
                   const Eigen::AlignedBox3d& before);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_INTERNAL_VIEW_RAYS_H_
