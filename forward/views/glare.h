// Returns discomfort glare: the unified glare rating (UGR) of an observer in a lit room, and the daylight glare
// probability (DGP) of what an eye sees.
//
//   UGR = 8 log10(0.25 / L_b  sum_k L_k^2 omega_k / p_k^2),     L_b = E_indirect / pi
//   ln p = (35.2 - 0.31889 tau - 1.22 exp(-2 tau / 9)) 1e-3 sigma
//        + (21 + 0.26667 tau - 0.002963 tau^2) 1e-5 sigma^2                       sigma, tau in degrees
//   p = 1 + (0.8 below R = 0.6 D, else 1.2) R / D,  R^2 = H^2 + T^2               below the line of sight
//
// sigma is the angle between the line of sight and the source; tau is the angle of the plane that holds both
// from the vertical. L_k is the luminance of the luminous surface as seen, omega its solid angle, p Guth's
// position index. E_indirect is the vertical illuminance at the eye without the luminaires' own light. A
// luminaire is summed over its luminous surface piece by piece (occlusion tested), which for a small one is
// CIE 117's single term. As CIE 117 says, sources outside its table (T/R > 3, H/R > 1.9, behind the observer)
// do not count.
//
// A luminaire dimmed to d sends d times the luminance: sums of d^2 luminaire_sum and of d E_indirect give any
// state. The rating is undefined for a point, whose luminous area is not known.
//
//   DGP = 5.87e-5 E_v + 9.18e-2 log10(1 + sum_k L_k^2 omega_k / (E_v^1.87 p_k^2)) + 0.16
//
// E_v: all light at the eye, lx. DGP holds for 0.2 to 0.8 and E_v above 380 lx. Its p covers the whole hemisphere:
// R / D below the line of sight counts as 3 at most, p is at most 16. Below 1000 lx, DGP has the factor
// x / (1 + x), x = exp(0.024 E_v - 4), as in evalglare.
//
// The formula of p is within 12 % of Guth's diagram and 5 % over most of it (Levin 1975), which is up to 0.8
// and mostly less than 0.4 in UGR. Units are cd/m2, sr, lx; world frame, z up.
// Source: CIE 117-1995, eq. 4.1 and table 4.1; Levin (1975), "Position index in VCP calculations", eq. 6;
// Iwata and Tokura (1998) for below the line of sight; Wienold and Christoffersen (2006) for DGP, and Wienold
// (2012), "New features of evalglare", for low light.
#ifndef LUXFIT_FORWARD_VIEWS_GLARE_H_
#define LUXFIT_FORWARD_VIEWS_GLARE_H_

#include <Eigen/Core>

#include "forward/luminaire/luminaire.h"
#include "forward/room/visibility.h"

namespace luxfit {

struct Observer {
  Eigen::Vector3d eye;
  Eigen::Vector3d sight;  // unit, not vertical
};

// Returns Guth's position index of a direction; infinity where CIE 117 leaves it out.
double PositionIndex(const Observer& observer, const Eigen::Vector3d& towards);

// Returns the same over the whole hemisphere, at most 16; infinity behind the observer.
double HemisphereIndex(const Observer& observer, const Eigen::Vector3d& towards);

struct GlareSource {
  bool is_defined = true;      // false: a point
  double sum = 0;              // sum L^2 omega / p^2, cd^2 m^-4 sr
  double solid_angle_sr = 0;   // solid angle of its visible part, wherever it stands
  double luminance_cd_m2 = 0;  // its mean over that
  double least_index = 0;      // least index of its pieces that count; 0: none does
};

// Returns the glare of one luminaire fully on (its flux_lm), from `order` pieces a side of its surface.
GlareSource GlareOf(const RayScene& rays, const Luminaire& luminaire, const Observer& observer,
                    int order = 8);

// Returns UGR; negative infinity where nothing glares. Throws std::invalid_argument for a background that is
// not positive.
double UnifiedGlareRating(double sum, double background_cd_m2);

// Returns DGP, at most 1. `sum`: of L^2 omega / p^2, with p by HemisphereIndex. Throws std::invalid_argument for an
// illuminance that is not positive.
double DaylightGlareProbability(double sum, double vertical_lx);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_VIEWS_GLARE_H_
