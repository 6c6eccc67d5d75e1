#include "calib/luminance/sensor_noise.h"

namespace luxfit {

SensorNoise DefaultNoise(int bits_per_channel) {
  SensorNoise noise;
  if (bits_per_channel == 8) {
    noise.read = 1.0 / 255;
    noise.shot = 0;
  }
  return noise;
}

}  // namespace luxfit
