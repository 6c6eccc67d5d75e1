// mrcal's corners.vnl: where images show a board's corners.
//
//   # filename x y level
//   left01.jpg 244.4 94.1 0        one row per corner, all of a board in order; level: the corner was found
//   in left01.jpg - - -               the image shrunk by 2^level, so its weight is 2^-level; "-": not found
//
// An image without any corner may stand as a single row of "-". Other columns are ignored, their order is the
// header's.
//
// Throws std::runtime_error("FILE:LINE: expected ..., got ...").
// Source: mrcal 2.2, "Calibration object corner finding"; vnlog.
#ifndef LUXFIT_CALIB_TARGETS_CORNERS_FILE_H_
#define LUXFIT_CALIB_TARGETS_CORNERS_FILE_H_

#include <string>
#include <vector>

#include "calib/targets/board.h"

namespace luxfit {

struct ImageCorners {
  std::string file;                  // as the table has it
  std::vector<BoardCorner> corners;  // sigma_px: 0.3 px 2^level; those found only
};

// `count`: corners of the board; images in the order of the table.
std::vector<ImageCorners> ReadCornersFile(const std::string& path, int count);

// A corner's level is that of its sigma against the table's least, in whole steps.
std::string CornersFile(const std::vector<ImageCorners>& images, int count);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_CORNERS_FILE_H_
