// Measured luminous intensity distribution of a luminaire: a table over C and gamma, interpolated.
//
//   I(C, gamma) bilinear in both angles between the table's, 0 outside them           cd per lm
//   Phi = sum over cells of dC mean_C(int I sin(gamma) dgamma)                        exact for the
//   interpolant: int_a^b (I_a + (I_b - I_a) (g - a) / (b - a)) sin g dg
//     = I_a cos a - I_b cos b + (I_b - I_a) (sin b - sin a) / (b - a)
//
// A table holds cd per lm of the LUMINAIRE's total flux, so Phi of it is 1: files are normalised by the
// integral above when they are read, and Luminaire::flux_lm scales them. Angles in rad.
//
// Direction of (C, gamma) in the luminaire's frame: (sin gamma cos C, sin gamma sin C, -cos gamma). gamma = 0
// is the nadir (the aim), the C0 half-plane lies along the heading, and C runs counter-clockwise seen from
// above (from behind a luminaire that is aimed down): C90 is +y of the luminaire's frame.
//
// The derivative with respect to direction is exact for the interpolant, which has kinks at the table's
// angles; at the poles, where C means nothing, the part along C is left out. Sources: CIE 121-1996 and EN
// 13032-1 (C-gamma system); ANSI/IESNA LM-63-2002, sec. 3 (type C: horizontal angles counter-clockwise,
// photometric zero straight down).
#ifndef LUXFIT_FORWARD_LUMINAIRE_PHOTOMETRY_H_
#define LUXFIT_FORWARD_LUMINAIRE_PHOTOMETRY_H_

#include <Eigen/Core>
#include <vector>

namespace luxfit {

struct IntensityTable {
  std::vector<double> c_rad;  // rising; a whole circle ends 2 pi after its first angle, with the same values
  std::vector<double> gamma_rad;  // rising, in [0, pi]
  std::vector<double> cd_per_lm;  // c_rad x gamma_rad, gamma running fastest
  double peak_cd_per_lm = 0;      // the largest of them: the higher, the narrower the lobe
  // Turns the luminaire's frame into the table's: the identity but for photometry about a horizontal axis
  // (IES type B).
  Eigen::Matrix3d table_from_luminaire = Eigen::Matrix3d::Identity();
};

// What the planes that were measured say of those that were not.
enum class PlaneSymmetry {
  kNone,        // all round
  kRotational,  // one plane stands for all
  kC0C180,      // mirrored in the plane C0-C180
  kC90C270,     // mirrored in the plane C90-C270
  kQuadrant,    // mirrored in both
  kPartial      // what is not covered is dark
};

// Luminous intensity of every plane (c x gamma, gamma running fastest, any unit) expanded to the whole
// circle. Throws std::invalid_argument for sizes that do not fit, angles that do not rise, gamma outside [0,
// pi], or negative or non-finite intensities.
IntensityTable ExpandPlanes(const std::vector<double>& c_rad, const std::vector<double>& gamma_rad,
                            const std::vector<double>& intensity, PlaneSymmetry symmetry);

// Flux of the interpolant, in lm if the table is in cd.
double FluxIntegral(const IntensityTable& table);

// The same distribution with a flux of 1 lm. Throws std::invalid_argument if it has none.
IntensityTable Normalized(const IntensityTable& table);

// Whether the intensity is the same all round gamma = 0, to 1 % of the peak.
bool IsSymmetricAboutAim(const IntensityTable& table);

// Intensity towards a unit vector of the luminaire's frame, and its gradient on the sphere (perpendicular to
// it).
struct TableIntensity {
  double cd_per_lm = 0;
  Eigen::Vector3d d_direction = Eigen::Vector3d::Zero();  // per rad
};
TableIntensity IntensityTowards(const IntensityTable& table, const Eigen::Vector3d& direction);

// Whether one plane stands for all, about the aim. Fits of free tables ask for no other.
bool IsOnePlaneAboutAim(const IntensityTable& table);

// The same by cos(gamma), of a table that is one plane about the aim.
struct PlaneIntensity {
  double cd_per_lm = 0;
  double d_cosine = 0;  // 0 at gamma = 0 and pi
};
PlaneIntensity IntensityInOnePlane(const IntensityTable& table, double cosine_gamma);

// The distribution on a whole circle of C and gamma from 0 to pi in the luminaire's own frame. Steps in
// degrees divide 360 and 180. Between grid points it is interpolated anew: error of the order of the squared
// step.
IntensityTable Resampled(const IntensityTable& table, int c_step_deg, int gamma_step_deg);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LUMINAIRE_PHOTOMETRY_H_
