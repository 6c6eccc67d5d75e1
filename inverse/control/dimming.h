// Estimates how far luminaires are dimmed, and finds how far they can be.
//
// - EstimateDimming: the dimming that one photo shows; LightByDimming: the light at places by it.
// - PlanDimming: the levels of least power that keep light within bounds.
// - DimUnseen: the levels of least power that the people present do not notice.
//
// Light is linear in the dimming of a luminaire, from 0 (off) to 1 (fully on). Units: lx, W. The equations,
// assumptions, exceptions and sources stand before each of the three.
#ifndef LUXFIT_INVERSE_CONTROL_DIMMING_H_
#define LUXFIT_INVERSE_CONTROL_DIMMING_H_

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "forward/luminaire/luminaire.h"
#include "forward/room/visibility.h"
#include "inverse/control/lux_map.h"

namespace luxfit {

// Estimates the dimming of every luminaire from one photo of a room whose luminaires are known.
//
//   E_e = sum_k d_k E_ek + r_e,   min sum_e ((E_e - sum_k d_k E_ek) / sigma_e)^2 over d >= 0
//
// E_e: illuminance that the camera measures at element e. E_ek: that of luminaire k fully on, as fitted. d
// needs no absolute scale, since E_e and E_ek share it; the exposure must be right. r: light that the
// luminaires do not give, from other sources: daylight, luminaires that the fit does not know.
//
// A luminaire has a large sigma where its light on the elements seen nearly equals that of others. The
// residuals enlarge all sigmas where the light is far from the model. With too few elements, is_determined is
// false.
//
// Units: lx. Throws std::invalid_argument for elements out of range and sigmas that are not above 0.
// Source: Lawson and Hanson (1974), "Solving Least Squares Problems", ch. 23.

struct CurrentDimming {
  bool is_determined = false;      // false: too few elements for the luminaires were seen
  Eigen::VectorXd dimming;         // by luminaire, 0: off
  Eigen::MatrixXd covariance;      // luminaires at 0 have the sigma that they would have if free
  double mean_unexplained_lx = 0;  // mean of r over the elements seen
  double unexplained_share = 0;    // sum of |r| over sum of E
  double residual_scale = 1;       // robust sigma of r / sigma_e: 1 where model and noise explain all
  int elements = 0;
};

// `element_lx`: elements x luminaires, each fully on.
CurrentDimming EstimateDimming(const Eigen::MatrixXd& element_lx,
                               const std::vector<ElementIlluminance>& measured);

// LightByDimming returns the light at places by that dimming. `place_lx`: places x luminaires.
// `log_flux_covariance`: of the fit.
//
//   sigma^2 = g C_d g^T + (d g) C_flux (d g)^T + (model E)^2 + (mean unexplained)^2,   g: the place's row
struct PlaceIlluminance {
  double illuminance_lx = 0, sigma_lx = 0;
};
std::vector<PlaceIlluminance> LightByDimming(const Eigen::MatrixXd& place_lx, const CurrentDimming& current,
                                             const Eigen::MatrixXd& log_flux_covariance,
                                             double relative_model_sigma);

// Finds the dimming levels of least power that keep light within bounds, by a linear programme.
//
//   min p . d   over   lower <= d <= upper,   least_i <= a_i . d <= most_i
//
// d: dimming by luminaire, p: power of each fully on (W), a_i: light that each luminaire fully on gives
// requirement i. Light is linear in dimming, so means over areas, uniformity (E_j - U0 mean(E) >= 0) and
// single points are all requirements. The programme meets them at the least power. Least squares on the
// required values would also spend power on light that no requirement needs.
//
// Where not all requirements can be met, the levels minimise the sum of shortages, each over its bound.
// is_reached is then false, and `shortage` says where and how much.
//
// Throws std::invalid_argument for sizes that do not fit, powers below 0, and bounds that cross.
// Source: Dantzig (1963), "Linear Programming and Extensions"; solved by COIN-OR's Clp (primal and dual
// simplex).

struct LightRequirement {
  std::string name;
  Eigen::VectorXd light;  // by luminaire, fully on
  double least = 0;
  double most = std::numeric_limits<double>::infinity();
};

struct DimmingBounds {
  Eigen::VectorXd lower, upper;  // by luminaire
};
DimmingBounds FullRange(Eigen::Index luminaires);  // 0 to 1

struct DimmingPlan {
  bool is_reached = false;  // true: every requirement is met
  Eigen::VectorXd dimming;
  double power_w = 0;
  std::vector<double> shortage;  // by requirement: below least (or above most), 0 where met
};

DimmingPlan PlanDimming(const Eigen::VectorXd& power_w, const std::vector<LightRequirement>& requirements,
                        const DimmingBounds& bounds);

// Lowers every coefficient by the uncertainty of the light. A requirement that these coefficients meet is met
// with a probability of at least 95 % (errors of the luminaires are added, as if all erred alike).
//
//   a_ik (1 - 1.645 sigma_k)
LightRequirement WithMargin(LightRequirement requirement, const Eigen::VectorXd& relative_sigma);

// Finds how far luminaires can be dimmed without the people present noticing.
//
//   E_p(d) = sum_k d_k E_pk              illuminance at the eye of person p, across the gaze
//   min sum_k p_k d_k,  0 <= d <= d0     such that
//   E_p(d) >= (1 - drop) E_p(d0)         for every person
//   d_k >= (1 - drop) d0_k               for luminaires whose own body somebody has in view
//
// The eye adapts to the light that reaches it. A drop below the threshold of slow changes passes unnoticed,
// wherever in the room the light decreases. A luminaire in view is noticed before that. Assumes slow dimming,
// and does not examine single surfaces that only one luminaire lights.
//
// Units: lx, W. Throws std::invalid_argument for sizes that do not fit and a drop outside 0..1.
// Sources: linear programme of PlanDimming; Cuttle (2010), "Towards the third stage of the lighting
// profession" (illuminance at the eye as the measure of a room's perceived light).

struct Gaze {
  std::string id;
  Eigen::Vector3d eye_m;
  Eigen::Vector3d direction;  // unit
};

// IsInView returns whether the luminaire's centre shines to the eye from within the field of view, with
// nothing between. The default is the field that both eyes share.
constexpr double kFieldHalfAngleRad = 1.0472;  // 60 degrees
bool IsInView(const RayScene& rays, const Luminaire& luminaire, const Gaze& gaze,
              double half_angle_rad = kFieldHalfAngleRad);

struct UnseenDimming {
  Eigen::VectorXd dimming;         // all luminaires together at the least power
  Eigen::VectorXd alone;           // lowest dimming of each by itself
  std::vector<double> drop;        // for each person by `dimming`, 0..1
  std::vector<double> drop_sigma;  // from the fluxes' uncertainty; the scale that all share cancels
  double power_w = 0, power_before_w = 0;
};

struct EyeLight {
  Eigen::MatrixXd light_lx;                                    // persons x luminaires, fully on
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> in_view;  // likewise
};

UnseenDimming DimUnseen(const EyeLight& eyes, const Eigen::VectorXd& now, const Eigen::VectorXd& power_w,
                        double drop, const Eigen::MatrixXd& log_flux_covariance);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CONTROL_DIMMING_H_
