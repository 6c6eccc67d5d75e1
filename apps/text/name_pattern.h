// Matches names against patterns in which * stands for any text, the empty one included.
#ifndef LUXFIT_APPS_TEXT_NAME_PATTERN_H_
#define LUXFIT_APPS_TEXT_NAME_PATTERN_H_

#include <string>

namespace luxfit {

// Tells whether the whole text matches the pattern.
bool MatchesPattern(const std::string& text, const std::string& pattern);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_NAME_PATTERN_H_
