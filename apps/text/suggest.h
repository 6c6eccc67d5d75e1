// Names for messages: quoting, listing, and the known name nearest to a misspelt one.
//
// Distance is the number of inserted, deleted, replaced or swapped neighbouring characters, upper and lower
// case alike. A name is near when it is at most a third of the longer length away (at least 1), so that
// "expozure" suggests "exposure" and "x" suggests nothing.
//
// Source: Damerau (1964), "A technique for computer detection and correction of spelling errors" (optimal
// string alignment form).
#ifndef LUXFIT_APPS_TEXT_SUGGEST_H_
#define LUXFIT_APPS_TEXT_SUGGEST_H_

#include <optional>
#include <string>
#include <vector>

namespace luxfit {

int EditDistance(const std::string& a, const std::string& b);

// The nearest of `known`; the first of equals; nothing where none is near.
std::optional<std::string> NearestName(const std::string& name, const std::vector<std::string>& known);

// "\"text\""
std::string Quoted(const std::string& text);

// "a, b or c"; at most `max_names` of them, then "...".
std::string ListNames(const std::vector<std::string>& names, int max_names = 20);

// "; did you mean \"x\"?", or "" where nothing is near.
std::string DidYouMean(const std::string& name, const std::vector<std::string>& known);

// "expected a, b or c, got \"name\"; did you mean \"b\"?"
std::string ExpectedOneOf(const std::vector<std::string>& known, const std::string& name);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_SUGGEST_H_
