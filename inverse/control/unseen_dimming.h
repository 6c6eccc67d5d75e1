// Which luminaires can be dimmed without the people present noticing.
//
//   E_p(d) = sum_k d_k E_pk              illuminance at the eye of person p, across the gaze
//   min sum_k p_k d_k,  0 <= d <= d0     such that
//   E_p(d) >= (1 - drop) E_p(d0)         for every person
//   d_k >= (1 - drop) d0_k               for luminaires whose own body somebody has in view
//
// What reaches the eye is what adapts it: a drop of it below the threshold of slow changes passes unnoticed,
// wherever in the room the light went. A luminaire that is looked at gives itself away before that. Slow
// dimming is assumed; surfaces that only one luminaire lights are not looked at one by one.
//
// lx, W. Throws std::invalid_argument for sizes that do not fit and a drop outside 0..1.
// Source: linear programme of inverse/control/dimming_plan.h; illuminance at the eye as the measure of what a person
// perceives of a room's light: Cuttle (2010), "Towards the third stage of the lighting profession".
#ifndef LUXFIT_INVERSE_CONTROL_UNSEEN_DIMMING_H_
#define LUXFIT_INVERSE_CONTROL_UNSEEN_DIMMING_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "forward/luminaire/luminaire.h"
#include "forward/room/visibility.h"

namespace luxfit {

struct Gaze {
  std::string id;
  Eigen::Vector3d eye_m;
  Eigen::Vector3d direction;  // unit
};

// Whether the luminaire's centre shines to the eye from within the field of view and nothing stands between.
// The default is the field that both eyes share.
constexpr double kFieldHalfAngleRad = 1.0472;  // 60 degrees
bool IsInView(const RayScene& rays, const Luminaire& luminaire, const Gaze& gaze,
              double half_angle_rad = kFieldHalfAngleRad);

struct UnseenDimming {
  Eigen::VectorXd dimming;         // least power of all together
  Eigen::VectorXd alone;           // how far down each can go by itself
  std::vector<double> drop;        // of each person by `dimming`, 0..1
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

#endif  // LUXFIT_INVERSE_CONTROL_UNSEEN_DIMMING_H_
