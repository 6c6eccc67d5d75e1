// The adjustment by OpenCV: cv::calibrateCamera and cv::fisheye::calibrate.
//
// For one camera; every image needs at least six corners in use. cv::calibrateCamera wants a plane (z = 0) or
// the start that it is given here. Corners weigh alike, boards stay flat, nothing is held near anything.
// Source: OpenCV 4.6, calib3d.
#ifndef LUXFIT_CALIB_CALIBRATE_INTERNAL_OPENCV_CALIBRATION_H_
#define LUXFIT_CALIB_CALIBRATE_INTERNAL_OPENCV_CALIBRATION_H_

#include "calib/calibrate/internal/calibration_state.h"

namespace luxfit {

bool OpenCvCanSolve(const CalibrationProblem& problem, const LensKind& kind);

SolvedState SolveByOpenCv(const CalibrationProblem& problem, const CalibrationState& start);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_INTERNAL_OPENCV_CALIBRATION_H_
