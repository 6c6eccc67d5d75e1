// libFuzzer on the EULUMDAT reader: any bytes are read or refused, and what was read is written and read back
// equal.
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "forward/luminaire/internal/ldt_file.h"
#include "tests/fuzz/use_photometry.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace luxfit;
  try {
    const LdtFile file = ParseLdt(std::string(reinterpret_cast<const char*>(data), size), "fuzz.ldt");
    const LdtFile again = ParseLdt(LdtText(file), "again.ldt");
    if (again.cd_per_klm != file.cd_per_klm || again.gamma_deg != file.gamma_deg ||
        again.c_deg != file.c_deg || again.company != file.company ||
        again.lamps.size() != file.lamps.size() || LdtText(again) != LdtText(file))
      std::abort();
    UsePhotometry(PhotometryOf(file));
  } catch (const std::runtime_error&) {
    return 0;  // refused with a message; anything else is a defect
  }
  return 0;
}
