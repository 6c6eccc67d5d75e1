// Returns OpenCV's marker dictionaries by name ("DICT_4X4_50").
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_ARUCO_DICTIONARY_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_ARUCO_DICTIONARY_H_

#include <opencv2/aruco.hpp>
#include <string>
#include <vector>

namespace luxfit {

// Returns the dictionary of a number (cv::aruco::DICT_4X4_50). OpenCV returns a pointer before 4.7, a value since.
cv::Ptr<cv::aruco::Dictionary> PredefinedDictionary(int number);

// Throws std::invalid_argument, naming the known dictionaries, for an unknown name.
cv::Ptr<cv::aruco::Dictionary> ArucoDictionary(const std::string& name);

// Returns the largest dictionary of each kind of marker. The smaller ones begin with the same markers.
std::vector<std::string> LargestArucoDictionaries();

// Returns the larger dictionaries of the same kind of marker, smallest first. They begin with the same markers.
std::vector<std::string> LargerArucoDictionaries(const std::string& than);

// Returns the smallest dictionary of the same kind of marker that has the id.
std::string SmallestArucoDictionary(const std::string& of_kind, int id);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_ARUCO_DICTIONARY_H_
