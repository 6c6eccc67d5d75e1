// A camera whose sensor has spectral sensitivities, and light of given spectra: what a camera's matrix does not tell exactly.
//
//   g_c = int S s_c / int S V       S: spectrum, s_c: sensitivity, V: CIE's for luminance
//
// Sensitivities are bells about 600, 540 and 455 nm. The matrix from them to XYZ is the least squares one over Planck's radiators on
// smooth reflectances, as a maker fits it. LEDs are a blue line and the bells of two phosphors.
// Source of the observer: C. Wyman, P.-P. Sloan, P. Shirley (2013), "Simple Analytic Approximations to the CIE XYZ Color Matching
// Functions", JCGT 2(2), eq. 4.
#ifndef LUXFIT_TESTS_SUPPORT_CALIB_SPECTRAL_CAMERA_H_
#define LUXFIT_TESTS_SUPPORT_CALIB_SPECTRAL_CAMERA_H_

#include <Eigen/Dense>
#include <cmath>
#include <functional>

namespace luxfit::support {

using Spectrum = std::function<double(double)>;  // of the wavelength in nm

inline double Bell(double nm, double peak, double below, double above) {
  const double t = (nm - peak) / (nm < peak ? below : above);
  return std::exp(-0.5 * t * t);
}

inline Eigen::Vector3d Observer(double nm) {
  return {1.056 * Bell(nm, 599.8, 37.9, 31.0) + 0.362 * Bell(nm, 442.0, 16.0, 26.7) -
              0.065 * Bell(nm, 501.1, 20.4, 26.2),
          0.821 * Bell(nm, 568.8, 46.9, 40.5) + 0.286 * Bell(nm, 530.9, 16.3, 31.1),
          1.217 * Bell(nm, 437.0, 11.8, 36.0) + 0.681 * Bell(nm, 459.0, 26.0, 13.8)};
}

inline Eigen::Vector3d Sensor(double nm) {
  return {0.7 * Bell(nm, 600, 32, 38), Bell(nm, 538, 42, 40), 0.6 * Bell(nm, 455, 28, 30)};
}

inline Eigen::Vector3d Integral(const Spectrum& spectrum,
                                const std::function<Eigen::Vector3d(double)>& weight) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (double nm = 380; nm <= 780; nm += 2) sum += spectrum(nm) * weight(nm);
  return sum;
}

inline Spectrum Planck(double kelvin) {
  return [kelvin](double nm) { return 1e17 / (std::pow(nm, 5) * std::expm1(1.438777e7 / (nm * kelvin))); };
}

// `blue`: height of the line, `red`: of the second phosphor's bell, over the first one's.
inline Spectrum Led(double blue, double red) {
  return [=](double nm) {
    return blue * Bell(nm, 452, 9, 11) + Bell(nm, 545, 35, 50) + red * Bell(nm, 620, 40, 50);
  };
}

inline Eigen::Vector3d XyzOf(const Spectrum& spectrum) { return Integral(spectrum, Observer); }

// Returns the counts of red, green and blue a unit of luminance.
inline Eigen::Vector3d CountsPerLuminance(const Spectrum& spectrum) {
  return Integral(spectrum, Sensor) / XyzOf(spectrum).y();
}

// Returns M of XYZ = M rgb.
inline Eigen::Matrix3d MatrixOfSensor() {
  Eigen::Matrix3d of_both = Eigen::Matrix3d::Zero(), of_counts = Eigen::Matrix3d::Zero();
  for (double kelvin = 2500; kelvin <= 7500; kelvin += 1000) {
    const Spectrum light = Planck(kelvin);
    for (double edge = 420; edge <= 660; edge += 40) {
      for (const double sign : {-1.0, 0.0, 1.0}) {
        const Spectrum lit = [&](double nm) {
          return light(nm) * (0.15 + 0.6 / (1 + std::exp(sign * (nm - edge) / 25)));
        };
        const double unit = 1 / XyzOf(lit).y();
        const Eigen::Vector3d xyz = unit * XyzOf(lit), rgb = unit * Integral(lit, Sensor);
        of_both += xyz * rgb.transpose();
        of_counts += rgb * rgb.transpose();
      }
    }
  }
  return of_both * of_counts.inverse();
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_CALIB_SPECTRAL_CAMERA_H_
