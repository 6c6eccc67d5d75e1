// Photos of a box under an isotropic point of 1 lm, without any reflection, from a closed form.
//
//   Y_e = rho / pi Omega_e / (4 pi A_e)        mean over the element, as photos show it
//
// Omega: solid angle that the element fills, seen from the point. Camera scale 1, variance that of 0.2 %. Elements
// are rectangles. Pair them with LightData::indirect_is_held, so that the model has no reflection either.
// Source: Khadjavi (1968), "Calculation of solid angle subtended by rectangular apertures".
#ifndef LUXFIT_TESTS_SUPPORT_INVERSE_DIRECT_PHOTOS_H_
#define LUXFIT_TESTS_SUPPORT_INVERSE_DIRECT_PHOTOS_H_

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "forward/light/room.h"
#include "inverse/observe/observe.h"
#include "tests/support/closed_forms.h"

namespace luxfit::support {

// Returns the value of the rectangle a x b at distance h, with a corner on the normal through the point. Odd in a and b.
inline double CornerSolidAngle(double a, double b, double h) {
  return std::atan(a * b / (h * std::sqrt(a * a + b * b + h * h)));
}

inline double SolidAngle(const Element& element, const Eigen::Vector3d& p) {
  const Eigen::Vector3d d = element.center - p;
  const double a = element.edge_u.norm(), b = element.edge_v.norm(), h = -element.normal.dot(d);
  const double x = element.edge_u.dot(d) / a, y = element.edge_v.dot(d) / b;
  const double x0 = x - a / 2, x1 = x + a / 2, y0 = y - b / 2, y1 = y + b / 2;
  return CornerSolidAngle(x1, y1, h) - CornerSolidAngle(x0, y1, h) - CornerSolidAngle(x1, y0, h) +
         CornerSolidAngle(x0, y0, h);
}

// One of each element.
inline std::vector<Observation> DirectPhotos(const Room& box, const Eigen::Vector3d& p_lamp, double rho,
                                             int state = 0) {
  std::vector<Observation> observations;
  observations.reserve(box.patches.elements.size());
  for (const Element& element : box.patches.elements) {
    Observation o;
    o.element = static_cast<int>(observations.size());
    o.state = state;
    o.pixels = 100;
    o.relative_luminance = rho / kPi * SolidAngle(element, p_lamp) / (4 * kPi * element.area_m2);
    o.variance = std::pow(0.002 * o.relative_luminance, 2);
    observations.push_back(o);
  }
  return observations;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_INVERSE_DIRECT_PHOTOS_H_
