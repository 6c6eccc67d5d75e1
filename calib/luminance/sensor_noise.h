// Models the noise of a count, as a share of full scale x = (count - black) / (full scale - black).
//
//   sigma^2(x) = read^2 + shot x
//
// read: read noise and quantisation; shot: the counts of one electron, 1 / full well.
//
// Source: EMVA 1288, sec. 2; Hasinoff, Durand, Freeman, "Noise-optimal capture for high dynamic range
// photography" (2010), eq. 2.
#ifndef LUXFIT_CALIB_LUMINANCE_SENSOR_NOISE_H_
#define LUXFIT_CALIB_LUMINANCE_SENSOR_NOISE_H_

namespace luxfit {

struct SensorNoise {
  // Defaults: a plain sensor, full well 20 000 electrons, read noise and quantisation of 4 electrons.
  double read = 2e-4;
  double shot = 5e-5;

  double Variance(double share_of_full_scale) const {
    return read * read + shot * (share_of_full_scale > 0 ? share_of_full_scale : 0);
  }
};

// Returns the noise to assume for counts of so many bits. 8 bits round to 1 / 255 of full scale, and lossy
// files to more, so no electron shows.
SensorNoise DefaultNoise(int bits_per_channel);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_SENSOR_NOISE_H_
