// Returns the luminance of a lit room along any ray.
//
//   L = rho E / pi,   E = E_direct(at the very point, occlusion tested) + E_indirect      cd/m2
//   L = Phi I(gamma) / (A cos gamma)                a luminous surface seen directly
//   L = Phi I / (pi r^2)                            a sphere
//
// E_indirect is interpolated between vertices (forward/views/internal/vertex_interpolation.h) or gathered by
// rays. Channels are columns of the reflectances: each colour has its own interreflection, and the direct
// light is computed once for all. Backs of facets, and rays that leave the scene, are black. Luminaires do
// not hide what is behind their backs.
//
// Throws std::invalid_argument unless the reflectances have one row per material of the scene.
// Source: Cohen and Wallace (1993), "Radiosity and Realistic Image Synthesis", ch. 9 (direct light per pixel,
// interpolated or gathered indirect light).
#ifndef LUXFIT_FORWARD_VIEWS_SURFACE_VIEW_H_
#define LUXFIT_FORWARD_VIEWS_SURFACE_VIEW_H_

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "forward/light/room.h"
#include "forward/luminaire/luminaire.h"

namespace luxfit {

struct VertexInterpolation;

// Holds a room with its light solved; all luminaires on, each with its flux_lm.
struct LitRoom {
  std::vector<Luminaire> luminaires;
  Eigen::MatrixXd albedo;              // materials x channels
  Eigen::MatrixXf element_direct_lx;   // elements x 1
  Eigen::MatrixXf element_exitance;    // elements x channels, lm/m2
  Eigen::MatrixXf vertex_indirect_lx;  // vertices x channels
  std::shared_ptr<const VertexInterpolation> interpolation;
};
LitRoom LightRoom(const Room& room, const std::vector<Luminaire>& luminaires, const Eigen::MatrixXd& albedo);

struct ViewOptions {
  int gather_rays = 0;  // 0: indirect light is interpolated; else gathered by so many rays per point
  // Cells a side of a luminaire on which shadows are tested, refined where they begin. 1 is five times as
  // fast as 4 and misses what hides less than a luminaire's corners.
  int shadow_grid = 4;
};

// Returns the illuminance (lx, one per channel) of a point of a facet's front.
Eigen::RowVectorXd SurfaceIlluminance(const Room& room, const LitRoom& lit, int facet, double u, double v,
                                      const ViewOptions& options = {});

// Returns the luminance (rays x channels) seen from `origin` along unit directions.
Eigen::MatrixXd RenderView(const Room& room, const LitRoom& lit, const Eigen::Vector3d& origin,
                           const Eigen::Matrix3Xd& directions, const ViewOptions& options = {});

// Holds the illuminance (lx, one per channel) that the exitance (elements x channels) gives a sensor, by its
// rays (SampleResponse). `back_share` is the share of rays that met the back of a facet, as all do inside a
// solid.
struct Gathered {
  Eigen::RowVectorXd illuminance_lx;
  double back_share = 0;
};
Gathered GatherIlluminance(const Room& room, const Eigen::MatrixXf& element_exitance, const Sensor& sensor,
                           const SensorRays& sensor_rays);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_VIEWS_SURFACE_VIEW_H_
