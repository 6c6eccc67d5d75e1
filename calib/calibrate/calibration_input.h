// What a calibration is made from: points whose places are known, and where images show them.
//
// The points are a board's corners, or the tags' of a surveyed room; images of one `set` were taken at the
// same moment by cameras that are fixed to each other, so they share one pose of the target.
//
// Target frame: the board's (calib/targets/board.h) or the world's. Metres, pixels, (0, 0) the centre of the top-left
// pixel.
#ifndef LUXFIT_CALIB_CALIBRATE_CALIBRATION_INPUT_H_
#define LUXFIT_CALIB_CALIBRATE_CALIBRATION_INPUT_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/targets/board.h"
#include "calib/targets/tags.h"

namespace luxfit {

struct CalibrationTarget {
  std::vector<Eigen::Vector3d> points;  // in the target's frame
  // > 0: the points are a uniform grid in the plane z = 0, row by row, `spacing_m` apart. Such a board may
  // be bent, and what it is bent by is estimated with the rest.
  int columns = 0, rows = 0;
  double spacing_m = 0;
  bool IsGrid() const { return columns > 0; }
};

CalibrationTarget TargetOf(const Board& board);
// Corner k of survey[t] is point 4 t + k.
CalibrationTarget TargetOf(const std::vector<SurveyedTag>& survey);

struct CalibrationCamera {
  std::string id;
  int width_px = 0, height_px = 0;
};

struct CalibrationImage {
  std::string name;
  int camera = 0;                    // index into the cameras
  int set = 0;                       // any number; equal in images taken together
  std::vector<BoardCorner> corners;  // `index` into the target's points; sigma_px 0: not known
};

struct CalibrationInput {
  CalibrationTarget target;
  std::vector<CalibrationCamera> cameras;
  std::vector<CalibrationImage> images;
};

// Throws std::invalid_argument where indices are out of range, a number is not finite, a camera has no size,
// an image shows one point twice or a camera has two images of one set.
void CheckCalibrationInput(const CalibrationInput& input);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_CALIBRATION_INPUT_H_
