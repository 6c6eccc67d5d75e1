// 100 lm Lambertian, 1 m on axis: 100 / pi lx.
#include <cmath>
#include <cstdio>

#include "calib/camera.h"
#include "forward/direct_light.h"
#include "inverse/luxmeter_check.h"

int main() {
  luxfit::Luminaire luminaire;
  luminaire.position = {0, 0, 1};
  const double lux = 100 * luxfit::DirectIlluminancePerLumen(luminaire, {0, 0, 0}, {0, 0, 1}).lx_per_lm;
  const luxfit::LuxmeterSummary summary = luxfit::SummarizeLuxmeter({{31.83, lux, 0, 0}});
  std::printf("%.3f lx\n", lux);
  return std::abs(lux - 31.831) < 1e-3 && summary.readings_checked == 1 ? 0 : 1;
}
