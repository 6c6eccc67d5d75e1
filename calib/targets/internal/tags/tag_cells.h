// Lists the cells of a tag, and tells whether a photo shows them.
//
// Places are in tag sizes from the top-left corner of the black square: (0, 0) to (1, 1) is the square.
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_TAGS_TAG_CELLS_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_TAGS_TAG_CELLS_H_

#include <apriltag/apriltag.h>

#include <Eigen/Core>
#include <opencv2/aruco.hpp>
#include <vector>

#include "calib/photo_files/image.h"

namespace luxfit {

struct TagCell {
  Eigen::Vector2d middle;
  bool is_white = false;
  bool is_bit = false;  // part of the code; else of the black border
};

struct TagCells {
  std::vector<TagCell> cells;
  double border = 0;  // width of the black border, in tag sizes
};

// Return the cells of a tag of either family. Throws std::invalid_argument as DrawTag does. Kalibr prints
// tag36h11 with border_bits = 2.
TagCells CellsOf(const apriltag_family_t& family, int id, int border_bits);
TagCells CellsOf(const cv::aruco::Dictionary& dictionary, int id);

// Returns whether the cells, mapped to the photo, are there. The grey values must correlate with the code,
// and the border must be darker than half way from black to white. Cells outside the photo do not count, but
// half of them must be inside. A code that differs in 11 of 36 bits correlates with 0.4, noise with 0 +-
// 0.17.
bool ShowsTag(const ImagePlane& grey, const Eigen::Matrix3d& pixel_from_tag, const TagCells& cells);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_TAGS_TAG_CELLS_H_
