#include "apps/stages/calibrate/calibration_sets.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "apps/text/file_stem.h"

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

// Holds a rule by which images of equal key were taken together.
struct KeyRule {
  const char* name;
  std::string (*key_of)(const std::string& file);  // "": the image has no key
};
constexpr KeyRule kNames = {"names", FileName}, kNumbers = {"numbers", NumberIn};

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
  out.is_rig = true;
  out.rule = "order";
  return out;
}

struct KeyedSets {
  ImageSets sets;
  std::size_t pairs = 0;           // keys that several cameras have
  bool tells_images_apart = true;  // every image of a camera has a key of its own
};

KeyedSets ByKey(const std::vector<std::vector<std::string>>& files, const KeyRule& rule) {
  KeyedSets out{Alone(files)};
  std::map<std::string, int> set_of_key;
  std::map<std::string, std::size_t> cameras_of_key;
  for (std::size_t c = 0; c < files.size(); ++c) {
    std::set<std::string> own;
    for (std::size_t i = 0; i < files[c].size(); ++i) {
      const std::string key = rule.key_of(files[c][i]);
      // A key that a camera has twice, or a missing one, pairs no images.
      if (key.empty() || !own.insert(key).second) continue;
      out.sets.sets[c][i] = set_of_key.emplace(key, out.sets.sets[c][i]).first->second;
      ++cameras_of_key[key];
    }
    out.tells_images_apart = out.tells_images_apart && own.size() == files[c].size();
  }
  out.pairs = static_cast<std::size_t>(
      std::count_if(cameras_of_key.begin(), cameras_of_key.end(),
                    [](const std::pair<const std::string, std::size_t>& k) { return k.second > 1; }));
  out.sets.is_rig = true;
  out.sets.rule = rule.name;
  return out;
}

// Returns the sets of a rule that the user gave, which one pair suffices for.
ImageSets ByGivenKey(const std::vector<std::vector<std::string>>& files, const KeyRule& rule) {
  KeyedSets found = ByKey(files, rule);
  return found.pairs > 0 ? std::move(found.sets) : Alone(files);
}

}  // namespace

ImageSets PairImages(const std::vector<std::vector<std::string>>& files, const std::string& rule) {
  if (rule == "none" || files.size() < 2) return Alone(files);
  if (rule == "order") return ByOrder(files);
  if (rule == "names") return ByGivenKey(files, kNames);
  if (rule == "numbers") return ByGivenKey(files, kNumbers);
  for (const KeyRule& key : {kNames, kNumbers}) {
    KeyedSets found = ByKey(files, key);
    if (found.tells_images_apart && found.pairs >= kLeastPairs) return std::move(found.sets);
  }
  return Alone(files);
}

}  // namespace luxfit
