// Finds square tags with black borders in a photo at reduced size, by OpenCV's aruco.
//
// aruco sees tags whose corners touch other black squares, and borders of two bits; libapriltag sees neither.
// Corners are good to a pixel of the reduced photo: a start for their measurement in the full one.
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_TAGS_FIND_TAGS_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_TAGS_FIND_TAGS_H_

#include <Eigen/Core>
#include <array>
#include <opencv2/aruco.hpp>
#include <opencv2/core.hpp>
#include <vector>

#include "calib/photo_files/image.h"

namespace luxfit {

// Holds a photo in 8 bits with its longer side reduced; pixel = scale * (reduced pixel + 0.5) - 0.5.
struct ReducedPhoto {
  cv::Mat grey;
  double scale = 1;

  Eigen::Vector2d ToFull(const Eigen::Vector2d& pixel) const {
    return (scale * (pixel.array() + 0.5) - 0.5).matrix();
  }
};

// Reduces the photo so that its longer side is at most `longest_px`. The photo must not be empty.
ReducedPhoto ReducePhoto(const ImagePlane& grey, int longest_px);

struct FoundTag {
  int id = 0;
  std::array<Eigen::Vector2d, 4>
      corners_px;  // in the full photo; as the dictionary draws the tag, from top-left
};

std::vector<FoundTag> FindTags(const ReducedPhoto& photo, const cv::Ptr<cv::aruco::Dictionary>& dictionary,
                               int border_bits);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_TAGS_FIND_TAGS_H_
