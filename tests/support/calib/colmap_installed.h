// Whether the COLMAP program is there: tests that need it are skipped where it is not.
#ifndef LUXFIT_TESTS_SUPPORT_CALIB_COLMAP_INSTALLED_H_
#define LUXFIT_TESTS_SUPPORT_CALIB_COLMAP_INSTALLED_H_

#include <cstdlib>

namespace luxfit::support {

inline bool IsColmapInstalled() { return std::system("command -v colmap > /dev/null 2>&1") == 0; }

}  // namespace luxfit::support

#define LUXFIT_SKIP_WITHOUT_COLMAP()         \
  if (!luxfit::support::IsColmapInstalled()) \
  GTEST_SKIP() << "colmap is not installed (apt-get install colmap)"

#endif  // LUXFIT_TESTS_SUPPORT_CALIB_COLMAP_INSTALLED_H_
