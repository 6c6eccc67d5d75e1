// Illuminance in closed form, independent of forward/.
//
// lx for flux in lm, metres. Lamps face straight down (-z), receivers straight up where they have no normal.
#ifndef LUXFIT_TESTS_SUPPORT_CLOSED_FORMS_H_
#define LUXFIT_TESTS_SUPPORT_CLOSED_FORMS_H_

#include <Eigen/Core>
#include <cmath>

namespace luxfit::support {

constexpr double kPi = 3.14159265358979323846;

// Inverse-square cosine law for a point of intensity I(gamma) = cd_per_lm(cos gamma) that shines down only,
// E = Phi I cos(theta) / r^2, theta from the receiver's normal.
template <typename Intensity>
double PointLx(double flux_lm, const Intensity& cd_per_lm, const Eigen::Vector3d& p_lamp,
               const Eigen::Vector3d& p_receiver, const Eigen::Vector3d& normal = Eigen::Vector3d::UnitZ()) {
  const Eigen::Vector3d to_lamp = p_lamp - p_receiver;
  const double down = to_lamp.z() / to_lamp.norm(), cosine = normal.dot(to_lamp) / to_lamp.norm();
  return down <= 0 || cosine <= 0 ? 0 : flux_lm * cd_per_lm(down) * cosine / to_lamp.squaredNorm();
}

inline double IsotropicCdPerLm(double) { return 1 / (4 * kPi); }
inline double LambertianCdPerLm(double cosine) { return cosine / kPi; }

// Configuration factor from a point to a parallel rectangle a x b at distance h, with a corner on the point's
// normal. Odd in a and b, so that signed corners superpose. Source: Howell, "A Catalog of Radiation Heat
// Transfer Configuration Factors", B-3.
inline double CornerFactor(double a, double b, double h) {
  const double x = a / h, y = b / h, rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
  return (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2 * kPi);
}

// From a point to a rectangle in the plane perpendicular to its own: the rectangle reaches `a` along the
// point's normal and `b` to one side, from the foot of the perpendicular, `c` > 0 away, on. Differences of a
// superpose. Source: Howell, B-4.
inline double PerpendicularCornerFactor(double a, double b, double c) {
  const double d = std::hypot(a, c);
  return (std::atan(b / c) - c / d * std::atan(b / d)) / (2 * kPi);
}

// To the rectangle size_x x size_y centred at `center`, by superposition of its corners.
inline double RectangleFactor(const Eigen::Vector3d& center, double size_x, double size_y,
                              const Eigen::Vector3d& p_receiver) {
  const Eigen::Vector3d d = center - p_receiver;
  const double x0 = d.x() - size_x / 2, x1 = d.x() + size_x / 2;
  const double y0 = d.y() - size_y / 2, y1 = d.y() + size_y / 2;
  return CornerFactor(x1, y1, d.z()) - CornerFactor(x0, y1, d.z()) - CornerFactor(x1, y0, d.z()) +
         CornerFactor(x0, y0, d.z());
}

// E = pi L F, L = Phi / (pi A).
inline double LambertianRectangleLx(double flux_lm, const Eigen::Vector3d& center, double size_x,
                                    double size_y, const Eigen::Vector3d& p_receiver) {
  return flux_lm / (size_x * size_y) * RectangleFactor(center, size_x, size_y, p_receiver);
}

// At a point of a wall, whose normal is horizontal: the rectangle's edges lie along that normal and across it.
inline double LambertianRectangleOnWallLx(double flux_lm, const Eigen::Vector3d& center,
                                          const Eigen::Vector2d& size_m, const Eigen::Vector3d& p_receiver,
                                          const Eigen::Vector3d& normal) {
  const Eigen::Vector3d d = center - p_receiver;
  if (d.z() <= 0) return 0;
  const double along = normal.head<2>().dot(d.head<2>()), across = normal.x() * d.y() - normal.y() * d.x();
  const double half_along = normal.head<2>().cwiseAbs().dot(size_m) / 2;
  const double half_across = (std::abs(normal.y()) * size_m.x() + std::abs(normal.x()) * size_m.y()) / 2;
  const auto strip = [&](double b) {
    return PerpendicularCornerFactor(along + half_along, b, d.z()) -
           PerpendicularCornerFactor(along - half_along, b, d.z());
  };
  return flux_lm / size_m.prod() * (strip(across + half_across) - strip(across - half_across));
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_CLOSED_FORMS_H_
