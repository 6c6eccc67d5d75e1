// Finds the correlated colour temperature of light.
//
//   T = argmin |(u, v) - (u_P(T), v_P(T))|     (u, v): CIE 1960 chromaticity; P: Planck's radiator
//   duv = that distance, positive above the locus (towards green)
//
// The locus is Krystek's, within 9e-5 of Planck's from 1000 to 15 000 K, the range in which T is sought. A colour farther than 0.05
// from the locus has no correlated colour temperature.
// Sources: CIE 15:2018, 9.5; M. Krystek (1985), "An algorithm to calculate correlated colour temperature", Color Res. Appl. 10, 38-40;
// ANSI C78.377 (duv).
#ifndef LUXFIT_CALIB_COLOUR_COLOUR_TEMPERATURE_H_
#define LUXFIT_CALIB_COLOUR_COLOUR_TEMPERATURE_H_

#include <Eigen/Core>
#include <optional>

namespace luxfit {

struct ColourTemperature {
  double kelvin = 0, kelvin_sigma = 0;
  double duv = 0, duv_sigma = 0;
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();  // CIE 1931
};

// `xyz`: CIE 1931 tristimulus values, in any unit; `covariance`: of their logarithms (relative). Empty where the colour has none.
std::optional<ColourTemperature> ColourTemperatureOf(const Eigen::Vector3d& xyz,
                                                     const Eigen::Matrix3d& covariance);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_COLOUR_COLOUR_TEMPERATURE_H_
