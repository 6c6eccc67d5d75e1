// libFuzzer on the IES reader: any bytes are read or refused, and what was read is written and read back
// equal.
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "forward/luminaire/internal/ies_file.h"
#include "tests/fuzz/use_photometry.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace luxfit;
  try {
    const IesFile file = ParseIes(std::string(reinterpret_cast<const char*>(data), size), "fuzz.ies");
    const IesFile again = ParseIes(IesText(file), "again.ies");
    if (again.candela != file.candela || again.vertical_deg != file.vertical_deg ||
        again.horizontal_deg != file.horizontal_deg || again.multiplier != file.multiplier ||
        again.keywords.size() != file.keywords.size() || IesText(again) != IesText(file))
      std::abort();
    UsePhotometry(PhotometryOf(file));
  } catch (const std::runtime_error&) {
    return 0;  // refused with a message; anything else is a defect
  }
  return 0;
}
