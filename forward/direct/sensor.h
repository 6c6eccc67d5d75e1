// Describes light meters by place and response to direction, and returns their illuminance.
//
//   E = int L(d) w(d) dOmega                                d: unit vector towards the light
//     = Phi sum_q w_q I(gamma_q) w(d_q) / r_q^2             direct, lx
//     + sum_e M_e 1/pi int_e w(d) dOmega                    indirect, over elements: SensorFormFactors
//
//   cosine           w = max(0, cos theta)                        theta from the normal
//   table            w = s(theta), the meter's measured response to a beam, 1 at normal incidence
//   cylindrical      w = sin(epsilon) / pi                        epsilon from the axis (the normal)
//   semicylindrical  w = sin(epsilon) (1 + cos(alpha)) / pi       alpha: azimuth about it, from `facing`
//   spherical        w = 1 / 4                                    mean spherical (scalar) illuminance
//
// A uniform luminance L gives E = pi L for all of them (for a table: pi L times its own integral over the
// cosine's). A table's deviation from the cosine is interpolated, so that a cosine sampled coarsely stays a
// cosine. Past the table's last angle, if that is below 90 degrees, the last ratio to the cosine holds; else
// w = 0.
//
// Angles are in rad, positions in m, in the world frame. All kinds but cosine and table see the full sphere
// and must stand in free air.
//
// Source: cylindrical: EN 12464-1:2021, sec. 3 and CIE S 017; semicylindrical: EN 13201-3:2015, eq. for E_sc
// with (1 + cos alpha_sc) sin epsilon / pi; spherical: Lynes et al. (1966), "The flow of light into
// buildings" (scalar illuminance); response curves: CIE S 023 (f2). Weighted isocell: Masset, Bruls, Kerschen
// (2011), "Partition of the circle in cells of equal area and shape"; the disc's radius is mapped by the
// response's cumulative distribution.
#ifndef LUXFIT_FORWARD_DIRECT_SENSOR_H_
#define LUXFIT_FORWARD_DIRECT_SENSOR_H_

#include <Eigen/Core>
#include <vector>

#include "forward/direct/direct_light.h"
#include "forward/luminaire/luminaire.h"
#include "forward/room/patches.h"
#include "forward/room/visibility.h"

namespace luxfit {

enum class ResponseKind { kCosine, kTable, kCylindrical, kSemicylindrical, kSpherical };

struct SensorResponse {
  ResponseKind kind = ResponseKind::kCosine;
  std::vector<double> angle_rad = {};  // table only: from 0, ascending, up to pi
  std::vector<double> relative = {};   // the first is 1
  Eigen::Vector3d facing = {1, 0, 0};  // semicylinder only; made perpendicular to the normal
};
bool operator==(const SensorResponse& a, const SensorResponse& b);

// Returns a table made relative to its first value. Throws std::invalid_argument unless there are two or more
// angles, they ascend from 0 to at most pi, and the values are >= 0, the first > 0.
SensorResponse TableResponse(std::vector<double> angle_rad, std::vector<double> relative);

struct Sensor {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;  // unit; the axis of a cylinder
  SensorResponse response = {};
};
bool operator==(const Sensor& a, const Sensor& b);

// Holds w(d) and its derivative with respect to d, perpendicular to d.
struct DirectionWeight {
  double value = 0;
  Eigen::Vector3d d_direction = Eigen::Vector3d::Zero();
};
DirectionWeight WeightOf(const Sensor& sensor, const Eigen::Vector3d& direction);

// Returns the unoccluded illuminance with derivatives: DirectIlluminancePerLumen for any response.
DirectIlluminance SensorIlluminancePerLumen(const Luminaire& luminaire, const Sensor& sensor);

// Returns the share of the luminaire's surface points (`order` a side), weighed by the response, that the
// sensor sees.
double SensorVisibleFraction(const RayScene& rays, const Luminaire& luminaire, const Sensor& sensor,
                             int order);

constexpr int kSensorRays = 16384;

// Returns one weight per element: illuminance of the sensor per exitance of the element. The weights sum to 1
// in a closed room (not for a table, see above). About `ray_count` rays are importance-sampled by the
// response. A ray that meets the back of a facet brings nothing. Throws std::invalid_argument if ray_count <
// 1.
Eigen::VectorXf SensorFormFactors(const RayScene& rays, const Patches& patches, const Sensor& sensor,
                                  int ray_count = kSensorRays);

// Holds the rays of SensorFormFactors: each unit direction stands for the same part of `total`.
struct SensorRays {
  Eigen::Matrix3Xd directions;
  double total = 1;  // illuminance over pi L for a uniform luminance L
};
SensorRays SampleResponse(const Sensor& sensor, int ray_count);

// Returns where the rays of a sensor start: just off the surface it lies on, for sensors that see a
// hemisphere.
Eigen::Vector3d RayOrigin(const Sensor& sensor);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_DIRECT_SENSOR_H_
