// Draws a rig and the boards that it saw, from above or from the side, to scale and in millimetres.
//
//   plan   right: x, up: z         seen from above, where the first camera looks up the page
//   side   right: z, down: y       seen from the first camera's right side
//
// The frame is that of the rig's first camera: x right, y down, z forward. Dimension lines give the distance
// of each camera from the first one (plan) and of the nearest and farthest board (side).
#ifndef LUXFIT_APPS_CHARTS_RIG_SVG_H_
#define LUXFIT_APPS_CHARTS_RIG_SVG_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

namespace luxfit {

struct DrawnCamera {
  std::string name;
  Eigen::Isometry3d rig_from_cam = Eigen::Isometry3d::Identity();
  // Unit directions of the image's corners in the camera's axes, clockwise. NaN: that edge is not drawn.
  std::array<Eigen::Vector3d, 4> corner_directions;
};

struct DrawnRig {
  std::vector<DrawnCamera> cameras;                    // at least one
  std::vector<std::array<Eigen::Vector3d, 4>> boards;  // corners of each board in turn, in the rig's frame
};

enum class RigView { kPlan, kSide };

std::string RigSvg(const DrawnRig& rig, RigView view);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CHARTS_RIG_SVG_H_
