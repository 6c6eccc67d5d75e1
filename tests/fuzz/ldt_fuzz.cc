// libFuzzer on the EULUMDAT reader: any bytes are read or refused, and what was read is written and read back
// equal.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "forward/ldt_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace luxfit;
  try {
    const LdtFile file = ParseLdt(std::string(reinterpret_cast<const char*>(data), size), "fuzz.ldt");
    const LdtFile again = ParseLdt(LdtText(file), "again.ldt");
    if (again.cd_per_klm != file.cd_per_klm || again.gamma_deg != file.gamma_deg ||
        again.c_deg != file.c_deg || again.company != file.company ||
        again.lamps.size() != file.lamps.size() || LdtText(again) != LdtText(file))
      std::abort();
    const PhotometryFile photometry = PhotometryOf(file);
    if (!std::isfinite(photometry.luminaire_flux_lm)) std::abort();
    for (const double cd_per_lm : photometry.table.cd_per_lm) {
      if (!std::isfinite(cd_per_lm)) std::abort();
    }
    for (const Eigen::Vector3d& d :
         {Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(0.6, 0, 0.8), Eigen::Vector3d(0, -1, 0)}) {
      const TableIntensity towards = IntensityTowards(photometry.table, d);
      if (!std::isfinite(towards.cd_per_lm) || !towards.d_direction.allFinite()) std::abort();
    }
  } catch (const std::runtime_error&) {
    return 0;  // refused with a message; anything else is a defect
  }
  return 0;
}
