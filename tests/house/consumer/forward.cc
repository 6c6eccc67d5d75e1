// 100 lm Lambertian, 1 m on axis: 100 / pi lx. An .ies file of it says the same.
#include <cmath>
#include <cstdio>

#include "forward/direct/direct_light.h"
#include "forward/luminaire/photometry_file.h"

int main() {
  luxfit::Luminaire luminaire;
  luminaire.position = {0, 0, 1};
  luminaire.flux_lm = 100;
  const double lux = 100 * luxfit::DirectIlluminancePerLumen(luminaire, {0, 0, 0}, {0, 0, 1}).lx_per_lm;
  const std::string ies = luxfit::WritePhotometry(luminaire, {}).ies;
  const luxfit::PhotometryFile file = luxfit::ParsePhotometry(ies, "written.ies");
  std::printf("forward: %.3f lx, %.2f lm\n", lux, file.luminaire_flux_lm);
  return std::abs(lux - 31.831) < 1e-3 && std::abs(file.luminaire_flux_lm - 100) < 0.1 ? 0 : 1;
}
