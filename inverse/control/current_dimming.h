// Which luminaires are on, and how far, in one photo of a room whose luminaires are known.
//
//   E_e = sum_k d_k E_ek + r_e,   min sum_e ((E_e - sum_k d_k E_ek) / sigma_e)^2 over d >= 0
//
// E_e: illuminance measured at element e by the camera, E_ek: that of luminaire k fully on, as fitted. d
// needs no absolute scale, since E_e and E_ek share it; exposure does enter. What the luminaires leave (r) is
// light of other sources: daylight, lamps that the fit does not know. A luminaire whose light nearly equals
// that of others in what is seen has a large sigma, and so has any where all light is far from the model:
// sigmas are enlarged by the residuals.
//
// lx. Throws std::invalid_argument for elements out of range and sigmas that are not above 0.
// Source: Lawson and Hanson (1974), "Solving Least Squares Problems", ch. 23.
#ifndef LUXFIT_INVERSE_CONTROL_CURRENT_DIMMING_H_
#define LUXFIT_INVERSE_CONTROL_CURRENT_DIMMING_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/control/lux_map.h"

namespace luxfit {

struct CurrentDimming {
  bool is_determined = false;      // else fewer elements than luminaires were seen
  Eigen::VectorXd dimming;         // by luminaire, 0: off
  Eigen::MatrixXd covariance;      // of those above 0; those at 0 have the sigma they would have if free
  double mean_unexplained_lx = 0;  // mean of r over the elements seen
  double unexplained_share = 0;    // sum of |r| over sum of E
  double residual_scale = 1;       // robust sigma of r / sigma_e: 1 where model and noise explain all
  int elements = 0;
};

// `element_lx`: elements x luminaires.
CurrentDimming EstimateDimming(const Eigen::MatrixXd& element_lx,
                               const std::vector<ElementIlluminance>& measured);

// Light at places by that dimming: `place_lx` places x luminaires, `log_flux_covariance` of the fit.
//
//   sigma^2 = g C_d g^T + (d g) C_flux (d g)^T + (model E)^2 + (mean unexplained)^2,   g: the place's row
struct PlaceIlluminance {
  double illuminance_lx = 0, sigma_lx = 0;
};
std::vector<PlaceIlluminance> LightByDimming(const Eigen::MatrixXd& place_lx, const CurrentDimming& current,
                                             const Eigen::MatrixXd& log_flux_covariance,
                                             double relative_model_sigma);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CONTROL_CURRENT_DIMMING_H_
