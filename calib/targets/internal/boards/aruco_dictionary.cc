#include "calib/targets/internal/boards/aruco_dictionary.h"

#include <array>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace luxfit {
namespace {

constexpr std::array<std::pair<const char*, int>, 17> kDictionaries = {{
    {"DICT_4X4_50", cv::aruco::DICT_4X4_50},
    {"DICT_4X4_100", cv::aruco::DICT_4X4_100},
    {"DICT_4X4_250", cv::aruco::DICT_4X4_250},
    {"DICT_4X4_1000", cv::aruco::DICT_4X4_1000},
    {"DICT_5X5_50", cv::aruco::DICT_5X5_50},
    {"DICT_5X5_100", cv::aruco::DICT_5X5_100},
    {"DICT_5X5_250", cv::aruco::DICT_5X5_250},
    {"DICT_5X5_1000", cv::aruco::DICT_5X5_1000},
    {"DICT_6X6_50", cv::aruco::DICT_6X6_50},
    {"DICT_6X6_100", cv::aruco::DICT_6X6_100},
    {"DICT_6X6_250", cv::aruco::DICT_6X6_250},
    {"DICT_6X6_1000", cv::aruco::DICT_6X6_1000},
    {"DICT_7X7_50", cv::aruco::DICT_7X7_50},
    {"DICT_7X7_100", cv::aruco::DICT_7X7_100},
    {"DICT_7X7_250", cv::aruco::DICT_7X7_250},
    {"DICT_7X7_1000", cv::aruco::DICT_7X7_1000},
    {"DICT_ARUCO_ORIGINAL", cv::aruco::DICT_ARUCO_ORIGINAL},
}};

template <typename Dictionary>
cv::Ptr<cv::aruco::Dictionary> PointerTo(const Dictionary& dictionary) {
  if constexpr (std::is_same_v<Dictionary, cv::aruco::Dictionary>)
    return cv::makePtr<cv::aruco::Dictionary>(dictionary);
  else
    return dictionary;
}

// "DICT_4X4" of "DICT_4X4_50".
std::string KindOf(const std::string& name) { return name.substr(0, name.find_last_of('_')); }

}  // namespace

cv::Ptr<cv::aruco::Dictionary> PredefinedDictionary(int number) {
  return PointerTo(cv::aruco::getPredefinedDictionary(number));
}

cv::Ptr<cv::aruco::Dictionary> ArucoDictionary(const std::string& name) {
  std::string known;
  for (const auto& [its_name, dictionary] : kDictionaries) {
    if (name == its_name) return PredefinedDictionary(dictionary);
    known += (known.empty() ? "" : ", ") + std::string(its_name);
  }
  throw std::invalid_argument("dictionary: expected one of " + known + ", got \"" + name + "\"");
}

std::vector<std::string> LargestArucoDictionaries() {
  std::vector<std::string> largest;
  for (const auto& [name, dictionary] : kDictionaries) {
    if (!largest.empty() && KindOf(largest.back()) == KindOf(name)) largest.pop_back();
    largest.emplace_back(name);
  }
  return largest;
}

std::vector<std::string> LargerArucoDictionaries(const std::string& than) {
  const int markers = ArucoDictionary(than)->bytesList.rows;
  std::vector<std::string> larger;
  for (const auto& [name, dictionary] : kDictionaries) {
    if (KindOf(name) == KindOf(than) && ArucoDictionary(name)->bytesList.rows > markers)
      larger.emplace_back(name);
  }
  return larger;
}

std::string SmallestArucoDictionary(const std::string& of_kind, int id) {
  for (const auto& [name, dictionary] : kDictionaries) {
    if (KindOf(name) == KindOf(of_kind) && ArucoDictionary(name)->bytesList.rows > id) return name;
  }
  return of_kind;
}

}  // namespace luxfit
