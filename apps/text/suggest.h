// Formats names for messages: quotes them, lists them, and finds the known name nearest to a misspelt one.
//
// The distance counts inserted, deleted, replaced and swapped neighbouring characters, without regard to
// case. A name is near where its distance is at most a third of the longer length (at least 1). "expozure"
// therefore suggests "exposure", and "x" suggests nothing.
//
// Source: Damerau (1964), "A technique for computer detection and correction of spelling errors" (optimal
// string alignment form).
#ifndef LUXFIT_APPS_TEXT_SUGGEST_H_
#define LUXFIT_APPS_TEXT_SUGGEST_H_

#include <optional>
#include <string>
#include <vector>

namespace luxfit {

// Lowers the case of the ASCII letters.
std::string Lowercase(std::string text);

int EditDistance(const std::string& a, const std::string& b);

// Returns the nearest of `known`, the first among equals; nothing where none is near.
std::optional<std::string> NearestName(const std::string& name, const std::vector<std::string>& known);

// "\"text\""
std::string Quoted(const std::string& text);

// "a, b or c"; at most `max_names` of them, then "...".
std::string ListNames(const std::vector<std::string>& names, int max_names = 20);

// "\"a\", \"b\" or \"c\""
std::string ListQuoted(std::vector<std::string> names);

// "; did you mean \"x\"?", or "" where nothing is near.
std::string DidYouMean(const std::string& name, const std::vector<std::string>& known);

// "expected a, b or c, got \"name\"; did you mean \"b\"?"
std::string ExpectedOneOf(const std::vector<std::string>& known, const std::string& name);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_SUGGEST_H_
