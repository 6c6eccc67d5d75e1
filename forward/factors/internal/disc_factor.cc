#include "forward/factors/internal/disc_factor.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>

namespace luxfit {
namespace {

using Complex = std::complex<double>;

// (z - ln(1 + z)) / z^2 for |z| < 1; below 0.1 by its series, to 1e-16.
Complex LogRemainder(Complex z) {
  if (std::norm(z) > 0.01) return (z - std::log(1.0 + z)) / (z * z);
  Complex sum = 0;
  for (int k = 16; k >= 2; --k) sum = 1.0 / k - z * sum;
  return sum;
}

// The disc's own axes: u towards its centre as seen along its plane, w = aim. In them the rim is
// (rho + R cos phi, R sin phi, height), counter-clockwise about the aim.
struct DiscFrame {
  DiscFrame(const Eigen::Vector3d& to_center, const Eigen::Vector3d& aim) {
    axes.col(2) = aim;
    axes.col(0) = to_center - to_center.dot(aim) * aim;
    if (axes.col(0).norm() < 1e-12 * to_center.norm()) axes.col(0) = aim.unitOrthogonal();
    // Twice, as near the axis the first difference is mostly rounding.
    axes.col(0) = (axes.col(0) - axes.col(0).dot(aim) * aim).normalized();
    axes.col(1) = aim.cross(axes.col(0));
    rho = to_center.dot(axes.col(0));
    height = to_center.dot(aim);
  }
  Eigen::Matrix3d axes;
  double rho, height;
};

// Squared distance to the rim: mean + swing cos phi = scale / 2 |1 + m e^(i phi)|^2.
struct RimDistance {
  RimDistance(const DiscFrame& disc, double radius) {
    const double h2 = disc.height * disc.height;
    const double near = disc.rho - radius, far = disc.rho + radius;
    mean = disc.rho * disc.rho + h2 + radius * radius;
    swing = 2 * radius * disc.rho;
    root = std::sqrt((near * near + h2) * (far * far + h2));
    scale = mean + root;
    m = swing / scale;
  }
  double mean, swing, root;  // root^2 = mean^2 - swing^2
  double scale, m;
};

// Antiderivatives at e = e^(i phi), or their differences between the ends of an arc; those of the whole rim
// are 0 but for the angle.
struct Antiderivatives {
  double angle = 2 * M_PI;  // phi - 2 arg(1 + m e)
  Complex over = 0;         // e / r^2
  Complex log = 0;          // ln(1 + m e) / m
  Complex rest = 0;         // (log - scale / 2 over) / m
};

Antiderivatives Between(const RimDistance& rim, Complex direction, double half_angle) {
  const auto at = [&](double sign) {
    const Complex e = direction * std::polar(1.0, sign * half_angle), z = rim.m * e;
    const Complex remainder = LogRemainder(z);
    const double squared = std::norm(1.0 + z);
    return Antiderivatives{sign * half_angle - 2 * std::arg(1.0 + z), 2.0 / (rim.scale * squared) * e,
                           e * (1.0 - z * remainder), e * ((2 * e.real() + rim.m) / squared - e * remainder)};
  };
  const Antiderivatives low = at(-1), high = at(1);
  return {high.angle - low.angle, high.over - low.over, high.log - low.log, high.rest - low.rest};
}

// int e^(i k phi) / r^(2 j) dphi: `first` and `second` for j = 1 and 2.
struct RimIntegrals {
  RimIntegrals(const RimDistance& rim, const Antiderivatives& ends) {
    constexpr Complex kI(0, 1);
    first0 = ends.angle / rim.root;
    first1 = -rim.m * first0 - 2.0 / rim.scale * kI * ends.log;
    second0 = (rim.mean * first0 - rim.swing * ends.over.imag()) / (rim.root * rim.root);
    second1 = (-kI * ends.over - rim.swing * second0) / rim.mean;
    second2 = second0 - 2 * first0 / rim.scale - 4 / (rim.scale * rim.scale) * kI * ends.rest;
  }
  double first0, second0;
  Complex first1, second1, second2;
};

// oint r x dr / r^2 along the arc, in the disc's axes.
Eigen::Vector3d ArcVector(const DiscFrame& disc, const RimDistance& rim, const Antiderivatives& ends,
                          const RimIntegrals& integrals, double radius) {
  // rho first1 + R first0, in which both cancel where the disc is seen edge on: root^2 = bulge^2 + (2 rho
  // h)^2.
  const double bulge = disc.height * disc.height + radius * radius - disc.rho * disc.rho;
  const double reach = 2 * disc.rho * disc.height;
  const double sum = bulge < 0 ? reach * reach / (rim.root - bulge) : rim.root + bulge;
  const double upright = (radius * integrals.first0 * sum + 2 * disc.rho * ends.log.imag()) / rim.scale;
  return radius * Eigen::Vector3d(-disc.height * integrals.first1.real(),
                                  -disc.height * integrals.first1.imag(), upright);
}

// angle (a x b) / |a x b| of the edge from a to b.
Eigen::Vector3d EdgeVector(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d cross = a.cross(b);
  const double sine = cross.norm();
  return sine > 0 ? Eigen::Vector3d(std::atan2(sine, a.dot(b)) / sine * cross) : cross;
}

}  // namespace

DiscFactor PointToDisc(const Eigen::Vector3d& p, const Eigen::Vector3d& normal, const Eigen::Vector3d& center,
                       const Eigen::Vector3d& aim, double radius_m) {
  const Eigen::Vector3d to_center = center - p;
  const DiscFrame disc(to_center, aim);
  // In its plane: on its rim every integral is infinite.
  if (disc.height >= -1e-14 * radius_m) return {};
  const Eigen::Vector3d n = disc.axes.transpose() * normal;
  const double facing = normal.dot(to_center), slope = radius_m * std::hypot(n.x(), n.y());
  if (facing <= -slope) return {};
  const RimDistance rim(disc, radius_m);
  Antiderivatives ends;
  Eigen::Vector3d chord = Eigen::Vector3d::Zero();
  if (!(facing >= slope)) {  // the receiver's plane cuts it; NaN too is led this way
    const Complex direction = radius_m * Complex(n.x(), n.y()) / slope;
    const double half_angle = std::acos(-facing / slope);
    ends = Between(rim, direction, half_angle);
    const auto rim_point = [&](double angle) {
      const Complex e = radius_m * direction * std::polar(1.0, angle);
      return Eigen::Vector3d(disc.rho + e.real(), e.imag(), disc.height);
    };
    chord = EdgeVector(rim_point(half_angle), rim_point(-half_angle));
  }
  const RimIntegrals integrals(rim, ends);
  const Eigen::Vector3d d_normal =
      -1 / (2 * M_PI) * (ArcVector(disc, rim, ends, integrals, radius_m) + chord);
  // int (n . r) {1, cos phi, sin phi} / r^4 dphi
  const Complex &first = integrals.second1, &second = integrals.second2;
  const double x = radius_m * n.x(), y = radius_m * n.y(), whole = integrals.second0;
  const double even = facing * whole + x * first.real() + y * first.imag();
  const double cosine = facing * first.real() + 0.5 * (x * (whole + second.real()) + y * second.imag());
  const double sine = facing * first.imag() + 0.5 * (x * second.imag() + y * (whole - second.real()));
  const Eigen::Vector3d d_center(-disc.height * cosine, -disc.height * sine,
                                 disc.rho * cosine + radius_m * even);
  return {std::max(n.dot(d_normal), 0.0), radius_m / M_PI * (disc.axes * d_center), disc.axes * d_normal,
          // F keeps its value when centre and radius grow together.
          -radius_m * disc.height / M_PI * even};
}

}  // namespace luxfit
