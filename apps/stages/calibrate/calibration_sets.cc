#include "apps/stages/calibrate/calibration_sets.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <set>

namespace luxfit {
namespace {

constexpr std::size_t kLeastPairs = 3;  // two may agree by chance
const char kNoNumber[] = "";

// Drops leading zeros, so that 7 and 007 are equal.
std::string NumberIn(const std::string& file) {
  const std::string name = std::filesystem::path(file).stem().string();
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  const auto end = std::find_if(name.rbegin(), name.rend(), is_digit).base();
  const auto begin = std::find_if_not(std::make_reverse_iterator(end), name.rend(), is_digit).base();
  if (begin == end) return kNoNumber;
  const std::string digits(begin, end);
  const std::size_t first = digits.find_first_not_of('0');
  return first == std::string::npos ? "0" : digits.substr(first);
}

ImageSets Alone(const std::vector<std::vector<std::string>>& files) {
  ImageSets out;
  int next = 0;
  for (const std::vector<std::string>& images : files) {
    out.sets.emplace_back();
    for (std::size_t i = 0; i < images.size(); ++i) out.sets.back().push_back(next++);
  }
  return out;
}

ImageSets ByOrder(const std::vector<std::vector<std::string>>& files) {
  ImageSets out;
  for (const std::vector<std::string>& images : files) {
    out.sets.emplace_back();
    for (std::size_t i = 0; i < images.size(); ++i) out.sets.back().push_back(static_cast<int>(i));
  }
  out.is_rig = files.size() > 1;
  return out;
}

}  // namespace

ImageSets PairImages(const std::vector<std::vector<std::string>>& files, const std::string& rule) {
  if (rule == "none" || files.size() < 2) return Alone(files);
  if (rule == "order") return ByOrder(files);
  ImageSets out = Alone(files);
  std::map<std::string, int> set_of_number;
  std::map<std::string, std::size_t> cameras_of_number;
  for (std::size_t c = 0; c < files.size(); ++c) {
    std::set<std::string> own;
    for (std::size_t i = 0; i < files[c].size(); ++i) {
      const std::string number = NumberIn(files[c][i]);
      // A number that a camera has twice, or a missing number, pairs no images.
      if (number == kNoNumber || !own.insert(number).second) continue;
      out.sets[c][i] = set_of_number.emplace(number, out.sets[c][i]).first->second;
      ++cameras_of_number[number];
    }
    if (rule == "auto" && own.size() != files[c].size()) return Alone(files);
  }
  const auto pairs = static_cast<std::size_t>(
      std::count_if(cameras_of_number.begin(), cameras_of_number.end(),
                    [](const std::pair<const std::string, std::size_t>& n) { return n.second > 1; }));
  if (pairs < (rule == "auto" ? kLeastPairs : 1)) return Alone(files);
  out.is_rig = true;
  return out;
}

}  // namespace luxfit
