// Photos of a closed cube of 2 m with an isotropic lamp of 1 lm in it, from closed forms.
//
//   Y = rho / pi (D + rho / (A (1 - rho)))
//
// D: inverse-square cosine law; behind it the integrating sphere's interreflection, which in a cube is even
// to about a tenth of itself. Camera scale 1, variance that of 1 %. Source: Jacquez and Kuppenheim (1955).
#ifndef LUXFIT_TESTS_SUPPORT_INVERSE_CUBE_PHOTOS_H_
#define LUXFIT_TESTS_SUPPORT_INVERSE_CUBE_PHOTOS_H_

#include <cmath>
#include <vector>

#include "forward/light/room.h"
#include "inverse/observe/observe.h"
#include "tests/support/closed_forms.h"
#include "tests/support/scenes.h"

namespace luxfit::support {

inline Room CubeRoom(int rays_per_element = 64) {
  return MakeRoom(ClosedRoom({2, 2, 2}), {{0.5, 0.25}, {rays_per_element}});
}

inline double CubeIndirectLx(double rho) { return rho / (24 * (1 - rho)); }

// One of each element, in state 0. `rho` by channel; luminance is that of the second.
inline std::vector<Observation> CubePhotos(const Room& cube, const Eigen::Vector3d& lamp,
                                           const Eigen::Vector3d& rho) {
  std::vector<Observation> observations;
  for (size_t e = 0; e < cube.patches.elements.size(); ++e) {
    const Element& element = cube.patches.elements[e];
    const Eigen::Vector3d to_lamp = lamp - element.center;
    const double direct_lx = element.normal.dot(to_lamp) / (4 * kPi * std::pow(to_lamp.norm(), 3));
    Observation o;
    o.element = static_cast<int>(e);
    o.pixels = 100;
    for (int c = 0; c < 3; ++c) o.relative_rgb[c] = rho[c] / kPi * (direct_lx + CubeIndirectLx(rho[c]));
    o.relative_luminance = o.relative_rgb[1];
    o.variance = std::pow(0.01 * o.relative_luminance, 2);
    observations.push_back(o);
  }
  return observations;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_INVERSE_CUBE_PHOTOS_H_
