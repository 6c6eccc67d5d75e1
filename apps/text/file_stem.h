// Makes file names from names that a user gave: letters, digits, - . and _ stay, everything else becomes _.
#ifndef LUXFIT_APPS_TEXT_FILE_STEM_H_
#define LUXFIT_APPS_TEXT_FILE_STEM_H_

#include <string>
#include <vector>

namespace luxfit {

// Returns the last part of a path.
std::string FileName(const std::string& path);

std::string FileStem(const std::string& id);

// Returns one stem for each name. No two are alike, even without regard to case: the later of two gets _2,
// _3, ...
std::vector<std::string> DistinctFileStems(const std::vector<std::string>& ids);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_FILE_STEM_H_
