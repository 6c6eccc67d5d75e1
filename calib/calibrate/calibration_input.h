// Holds the input of a calibration: points at known places, and the pixels where images show them.
//
// The points are a board's corners, or the corners of a surveyed room's tags. Images of one `set` were taken
// at the same moment by cameras that are fixed to each other, so they share one pose of the target.
//
// Target frame: the board's (calib/targets/board.h) or the world's. Metres, pixels; (0, 0) is the centre of
// the top-left pixel.
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
  // bend, and the calibration estimates its bend.
  int columns = 0, rows = 0;
  double spacing_m = 0;
  bool IsGrid() const { return columns > 0; }
};

// Returns the corners of a board as a target; a uniform grid unless the board is an AprilGrid.
CalibrationTarget TargetOf(const Board& board);
// Returns the corners of surveyed tags as a target: corner k of survey[t] is point 4 t + k.
CalibrationTarget TargetOf(const std::vector<SurveyedTag>& survey);

struct CalibrationCamera {
  std::string id;
  int width_px = 0, height_px = 0;
  // Largest display value of all its photos in cells over the image (calib/calibrate/image_circle.h); empty: not known.
  Eigen::MatrixXd brightest = {};
};

struct CalibrationImage {
  std::string name;
  int camera = 0;                    // index into the cameras
  int set = 0;                       // any number; equal for images taken together
  std::vector<BoardCorner> corners;  // `index` into the target's points; sigma_px 0: unknown
};

struct CalibrationInput {
  CalibrationTarget target;
  std::vector<CalibrationCamera> cameras;
  std::vector<CalibrationImage> images;
};

// Checks an input. Throws std::invalid_argument where an index is out of range, a number is not finite, or a
// camera has no size. Throws it also where an image shows one point twice, or a camera has two images in one
// set.
void CheckCalibrationInput(const CalibrationInput& input);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_CALIBRATION_INPUT_H_
