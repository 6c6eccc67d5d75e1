// Writes an image file whole or not at all, in the format of the path's ending.
//
// Throws std::runtime_error, naming the path, where it cannot be written.
#ifndef LUXFIT_CALIB_PHOTO_FILES_INTERNAL_WRITE_IMAGE_H_
#define LUXFIT_CALIB_PHOTO_FILES_INTERNAL_WRITE_IMAGE_H_

#include <opencv2/core.hpp>
#include <string>

namespace luxfit {

void WriteImageFile(const std::string& path, const cv::Mat& image);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_PHOTO_FILES_INTERNAL_WRITE_IMAGE_H_
