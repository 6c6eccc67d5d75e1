// Solves the adjustment by OpenCV: cv::calibrateCamera and cv::fisheye::calibrate.
//
// Serves one camera and skips images with fewer than six corners in use. cv::calibrateCamera needs a plane
// (z = 0) or the start that it gets here. All corners weigh alike, boards stay flat, and there is no
// regularisation. Fails (`ok` false) where fewer than two images have six corners, or OpenCV refuses them.
// Source: OpenCV 4.6, calib3d.
#ifndef LUXFIT_CALIB_CALIBRATE_INTERNAL_OPENCV_CALIBRATION_H_
#define LUXFIT_CALIB_CALIBRATE_INTERNAL_OPENCV_CALIBRATION_H_

#include "calib/calibrate/internal/calibration_state.h"

namespace luxfit {

bool OpenCvCanSolve(const CalibrationProblem& problem, const LensKind& kind);

SolvedState SolveByOpenCv(const CalibrationProblem& problem, const CalibrationState& start);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_INTERNAL_OPENCV_CALIBRATION_H_
