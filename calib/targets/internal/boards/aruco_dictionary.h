// Returns OpenCV's marker dictionaries by name ("DICT_4X4_50").
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_ARUCO_DICTIONARY_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_ARUCO_DICTIONARY_H_

#include <opencv2/aruco/dictionary.hpp>
#include <string>

namespace luxfit {

// Throws std::invalid_argument, naming the known dictionaries, for an unknown name.
cv::Ptr<cv::aruco::Dictionary> ArucoDictionary(const std::string& name);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_ARUCO_DICTIONARY_H_
