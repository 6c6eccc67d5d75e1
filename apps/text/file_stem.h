// File names from the names that a user gave: letters, digits, - . and _ stay, all else becomes _.
#ifndef LUXFIT_APPS_TEXT_FILE_STEM_H_
#define LUXFIT_APPS_TEXT_FILE_STEM_H_

#include <string>
#include <vector>

namespace luxfit {

// A path's last part.
std::string FileName(const std::string& path);

std::string FileStem(const std::string& id);

// One for each, no two alike even where case does not count: the later of two gets _2, _3, ...
std::vector<std::string> DistinctFileStems(const std::vector<std::string>& ids);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_FILE_STEM_H_
