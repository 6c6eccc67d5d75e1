// Form factor from a point to a disc in closed form, nothing standing between, with derivatives.
//
//   F = -1/(2 pi) n . oint r x dr / r^2                       over the rim of what lies in front of the
//   dF/dc = 1/pi int (n . r) r x dr / r^4                     receiver's plane; c: the disc's centre
//
// r: from the point to the rim. Where the plane cuts the disc, the rim is an arc and a chord that lies in the
// plane. Neither the chord's motion nor that of its ends counts in a derivative, as the integrand n . r is 0
// there: so dF/dc is over the arc alone. On the circle r^2 = A + B cos(phi), and both integrals are
// elementary.
//
// Shares in [0, 1], metres, world frame. A point in the plane of the disc or behind it sees nothing of it.
// NaN in is NaN out. Sources: Lambert (1760), "Photometria"; Baum, Rushmeier, Winget (1989), eq. 3 (contour);
// Hamilton and Morgan (1952), NACA TN 2836 (whole discs).
#ifndef LUXFIT_FORWARD_FACTORS_INTERNAL_DISC_FACTOR_H_
#define LUXFIT_FORWARD_FACTORS_INTERNAL_DISC_FACTOR_H_

#include <Eigen/Core>

namespace luxfit {

struct DiscFactor {
  double factor = 0;
  Eigen::Vector3d d_center = Eigen::Vector3d::Zero();  // 1/m
  Eigen::Vector3d d_normal = Eigen::Vector3d::Zero();  // of the receiver
  double d_radius = 0;                                 // 1/m
};

// Share of the cosine-weighted hemisphere over a point that the front of a disc covers. `normal` and `aim`
// (where the front faces) are unit vectors, radius_m > 0.
DiscFactor PointToDisc(const Eigen::Vector3d& p, const Eigen::Vector3d& normal, const Eigen::Vector3d& center,
                       const Eigen::Vector3d& aim, double radius_m);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_FACTORS_INTERNAL_DISC_FACTOR_H_
