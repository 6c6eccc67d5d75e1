#include "apps/text/suggest.h"

#include <algorithm>
#include <cctype>

namespace luxfit {

std::string Lowercase(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

int EditDistance(const std::string& a_any_case, const std::string& b_any_case) {
  const std::string a = Lowercase(a_any_case), b = Lowercase(b_any_case);
  std::vector<std::vector<int>> distance(a.size() + 1, std::vector<int>(b.size() + 1, 0));
  for (size_t i = 0; i <= a.size(); ++i) distance[i][0] = static_cast<int>(i);
  for (size_t j = 0; j <= b.size(); ++j) distance[0][j] = static_cast<int>(j);
  for (size_t i = 1; i <= a.size(); ++i) {
    for (size_t j = 1; j <= b.size(); ++j) {
      const int replaced = distance[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      distance[i][j] = std::min({distance[i - 1][j] + 1, distance[i][j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        distance[i][j] = std::min(distance[i][j], distance[i - 2][j - 2] + 1);
    }
  }
  return distance[a.size()][b.size()];
}

std::optional<std::string> NearestName(const std::string& name, const std::vector<std::string>& known) {
  std::optional<std::string> nearest;
  int least = 0;
  for (const std::string& candidate : known) {
    const int distance = EditDistance(name, candidate);
    const int near = std::max(1, static_cast<int>(std::max(name.size(), candidate.size())) / 3);
    // Two different one-character names are one replacement apart, yet not alike.
    const bool alike = distance < static_cast<int>(std::max(name.size(), candidate.size())) || distance == 0;
    if (distance > near || !alike || (nearest && distance >= least)) continue;
    nearest = candidate;
    least = distance;
  }
  return nearest;
}

std::string Quoted(const std::string& text) { return "\"" + text + "\""; }

std::string ListNames(const std::vector<std::string>& names, int max_names) {
  const int shown = std::min(static_cast<int>(names.size()), max_names);
  std::string list;
  for (int i = 0; i < shown; ++i) {
    const bool last = i + 1 == static_cast<int>(names.size());
    if (i > 0) list += last ? " or " : ", ";
    list += names[i];
  }
  return shown < static_cast<int>(names.size()) ? list + ", ..." : list;
}

std::string ListQuoted(std::vector<std::string> names) {
  std::transform(names.begin(), names.end(), names.begin(), Quoted);
  return ListNames(names);
}

std::string DidYouMean(const std::string& name, const std::vector<std::string>& known) {
  const std::optional<std::string> nearest = NearestName(name, known);
  return nearest ? "; did you mean " + Quoted(*nearest) + "?" : "";
}

std::string ExpectedOneOf(const std::vector<std::string>& known, const std::string& name) {
  return "expected " + ListNames(known) + ", got " + Quoted(name) + DidYouMean(name, known);
}

}  // namespace luxfit
