// Lists the photos of a folder, and says what lies there where there are none.
#ifndef LUXFIT_APPS_COMMANDS_INTERNAL_PHOTO_FILES_H_
#define LUXFIT_APPS_COMMANDS_INTERNAL_PHOTO_FILES_H_

#include <string>
#include <vector>

namespace luxfit {

// Tells by the ending of its name whether a file is a photo.
bool IsPhotoName(const std::string& path);

// Returns the photos of a folder and its subfolders, relative to it, in the order of their names. Throws
// std::runtime_error where there are none: it names `flag`, by which the folder was given, and the other files by kind, with
// a remedy for each.
std::vector<std::string> PhotoFilesIn(const std::string& folder, const std::string& flag);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_INTERNAL_PHOTO_FILES_H_
