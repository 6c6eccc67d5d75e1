// Reads and writes mrcal's corners.vnl: where images show a board's corners.
//
//   # filename x y level
//   left01.jpg 244.4 94.1 0        one row per corner, all of a board in order
//   left01.jpg - - -               "-": not found
//
// level: the corner was found in the image shrunk by 2^level, so its weight is 2^-level. An image without any
// corner may be a single row of "-". Other columns are ignored. The header gives the order of the columns.
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
  std::string file;                  // as the table names it
  std::vector<BoardCorner> corners;  // only those found; sigma_px: 0.3 px 2^level
};

// Reads the images in the order of the table. `count`: corners of the board.
std::vector<ImageCorners> ReadCornersFile(const std::string& path, int count);

// Returns the content of the file. A corner's level is that of its sigma over the least sigma, in whole
// steps.
std::string CornersFile(const std::vector<ImageCorners>& images, int count);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_CORNERS_FILE_H_
