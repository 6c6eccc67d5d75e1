// Lists the photos of a folder for `luxfit init`, and says what lies there where there are none.
#ifndef LUXFIT_APPS_COMMANDS_INTERNAL_PHOTO_FILES_H_
#define LUXFIT_APPS_COMMANDS_INTERNAL_PHOTO_FILES_H_

#include <string>
#include <vector>

namespace luxfit {

// Returns the photos of a folder and its subfolders, relative to it, in the order of their names. Throws
// std::runtime_error where there are none: it names the other files by kind, with a remedy for each.
std::vector<std::string> PhotoFilesIn(const std::string& folder);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_INTERNAL_PHOTO_FILES_H_
