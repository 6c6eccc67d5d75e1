// Tells a file's format by the ending of its name.
#ifndef LUXFIT_CALIB_PHOTO_FILES_INTERNAL_FILE_ENDING_H_
#define LUXFIT_CALIB_PHOTO_FILES_INTERNAL_FILE_ENDING_H_

#include <string>

namespace luxfit {

// Returns the ending in lower case, with its dot (".jpg"); empty: none.
std::string FileEnding(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_PHOTO_FILES_INTERNAL_FILE_ENDING_H_
