// What every table that a reader of photometric files returns must hold: finite intensities in every
// direction.
#ifndef LUXFIT_TESTS_FUZZ_USE_PHOTOMETRY_H_
#define LUXFIT_TESTS_FUZZ_USE_PHOTOMETRY_H_

#include <Eigen/Core>
#include <cmath>
#include <cstdlib>

#include "forward/luminaire/photometry.h"
#include "forward/luminaire/photometry_file.h"

namespace luxfit {

inline void UsePhotometry(const PhotometryFile& photometry) {
  if (!std::isfinite(photometry.luminaire_flux_lm)) std::abort();
  for (const double cd_per_lm : photometry.table.cd_per_lm) {
    if (!std::isfinite(cd_per_lm)) std::abort();
  }
  for (const Eigen::Vector3d& d :
       {Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(0.6, 0, 0.8), Eigen::Vector3d(0, -1, 0)}) {
    const TableIntensity towards = IntensityTowards(photometry.table, d);
    if (!std::isfinite(towards.cd_per_lm) || !towards.d_direction.allFinite()) std::abort();
  }
}

}  // namespace luxfit

#endif  // LUXFIT_TESTS_FUZZ_USE_PHOTOMETRY_H_
