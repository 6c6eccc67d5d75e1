// Describes directional light by nine coefficients: real spherical harmonics up to second order.
//
//   max(0, n . w) ~ ClampedCosine(n) . Harmonics(w),      within 0.1 for all n, w
//
// Source: Ramamoorthi and Hanrahan (2001), "An efficient representation for irradiance environment maps", eq.
// 8, 19.
#ifndef LUXFIT_FORWARD_RADIOSITY_INTERNAL_DIRECTIONAL_H_
#define LUXFIT_FORWARD_RADIOSITY_INTERNAL_DIRECTIONAL_H_

#include <Eigen/Core>

namespace luxfit {

using DirectionalLight = Eigen::Matrix<float, 9, 1>;

inline DirectionalLight Harmonics(const Eigen::Vector3d& w) {
  const float x = static_cast<float>(w.x()), y = static_cast<float>(w.y()), z = static_cast<float>(w.z());
  DirectionalLight h;
  h << 0.282095f, 0.488603f * y, 0.488603f * z, 0.488603f * x, 1.092548f * x * y, 1.092548f * y * z,
      0.315392f * (3 * z * z - 1), 1.092548f * x * z, 0.546274f * (x * x - y * y);
  return h;
}

inline DirectionalLight ClampedCosine(const Eigen::Vector3d& normal) {
  constexpr float kPi = 3.14159265f;
  DirectionalLight c = Harmonics(normal);
  c[0] *= kPi;
  c.segment<3>(1) *= 2 * kPi / 3;
  c.tail<5>() *= kPi / 4;
  return c;
}

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_RADIOSITY_INTERNAL_DIRECTIONAL_H_
