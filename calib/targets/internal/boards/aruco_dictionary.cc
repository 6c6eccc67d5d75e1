#include "calib/targets/internal/boards/aruco_dictionary.h"

#include <array>
#include <stdexcept>
#include <utility>

namespace luxfit {
namespace {

constexpr std::array<std::pair<const char*, cv::aruco::PREDEFINED_DICTIONARY_NAME>, 17> kDictionaries = {{
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

}  // namespace

cv::Ptr<cv::aruco::Dictionary> ArucoDictionary(const std::string& name) {
  std::string known;
  for (const auto& [its_name, dictionary] : kDictionaries) {
    if (name == its_name) return cv::aruco::getPredefinedDictionary(dictionary);
    known += (known.empty() ? "" : ", ") + std::string(its_name);
  }
  throw std::invalid_argument("dictionary: expected one of " + known + ", got \"" + name + "\"");
}

}  // namespace luxfit
