// The command line that the studies share: study_NAME -o FOLDER [--quick] [--sphere FOLDER].
#ifndef LUXFIT_TESTS_SUPPORT_STUDY_OPTIONS_H_
#define LUXFIT_TESTS_SUPPORT_STUDY_OPTIONS_H_

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>

namespace luxfit::support {

struct StudyOptions {
  std::string folder;     // for tables and pictures; exists
  bool is_quick = false;  // a test that can fail, of a minute or less
  std::string sphere;     // of study_photometric_stereo: real photos
};

// Nothing, and a line on standard error, where no folder is named.
inline std::optional<StudyOptions> ReadStudyOptions(int argc, char** argv) {
  StudyOptions options;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--quick") == 0) options.is_quick = true;
    if (std::strcmp(argv[i], "-o") == 0 && i + 1 < argc) options.folder = argv[++i];
    if (std::strcmp(argv[i], "--sphere") == 0 && i + 1 < argc) options.sphere = argv[++i];
  }
  if (options.folder.empty()) {
    std::fprintf(stderr, "usage: %s -o FOLDER [--quick]\n", argv[0]);
    return {};
  }
  std::filesystem::create_directories(options.folder);
  return options;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_STUDY_OPTIONS_H_
