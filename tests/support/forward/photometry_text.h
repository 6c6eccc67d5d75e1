// Small photometric files as text, and the message of what refuses one.
#ifndef LUXFIT_TESTS_SUPPORT_FORWARD_PHOTOMETRY_TEXT_H_
#define LUXFIT_TESTS_SUPPORT_FORWARD_PHOTOMETRY_TEXT_H_

#include <stdexcept>
#include <string>

#include "forward/luminaire/photometry_file.h"

namespace luxfit::support {

// Relative photometry of two lamps of 1000 lm; planes C0, C45, C90 of a quadrant.
constexpr char kIes[] = R"(IESNA:LM-63-2002
[TEST] 1234
[MANUFAC] M
[MORE] and more
TILT=NONE
2 1000 1.5 3 3 1 2 0.2 0.6 0
0.9 1.7 36
0 45 90
0 45 90
300 200 100
300 220 120
300 240 140
)";

// Isym 4 with planes C0, C45, C90; one lamp of 2000 lm.
constexpr char kLdt[] =
    "Maker\n2\n4\n8\n45\n3\n45\nR1\nName\nN1\nfile.ldt\n2020\n1200\n200\n50\n1100\n180\n0\n0\n0\n0\n"
    "100\n80\n1.5\n0\n1\n2\nlamp\n2000\n4000K\n80\n36\n"
    "1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n"
    "0\n45\n90\n135\n180\n225\n270\n315\n0\n45\n90\n"
    "300\n200\n100\n300\n220\n120\n300\n240\n140\n";

inline std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  // A test that breaks nothing must not pass.
  if (at == std::string::npos) throw std::runtime_error("Replaced: the text does not hold: " + from);
  return text.replace(at, from.size(), to);
}

inline std::string PhotometryError(const std::string& text, const std::string& name) {
  try {
    ParsePhotometry(text, name);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_FORWARD_PHOTOMETRY_TEXT_H_
