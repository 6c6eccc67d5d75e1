// Returns how uncertain the pixels of a calibrated camera are: the covariance of a projection.
//
// The method is mrcal's "mean-pcam". A point p that projects to q is fixed to the boards (or the room) of the
// calibration. Noise in the corners moves lens and poses, so each image's board carries p along. The mean of
// these moves is the move of p, and q moves with it:
//   dq = df/dlens dlens + df/dp (w x p + v),   (w, v): mean twist of the images' poses in the camera's frame
//   covariance(q) = D C D^T,   C: covariance of (lens, w, v), from the adjustment's J: s^2 (J^T J)^-1
// s is the noise that the residuals show, one weight for all corners. Directions (an infinite range) move
// with w alone.
//
// J holds libmrcal's weak regularisation. Where no corner was seen, parametric lenses extrapolate and report
// the extrapolation's uncertainty; splined lenses are as uncertain as the regularisation leaves them.
//
// Assumes that the lens model can represent the true lens. The covariance therefore excludes the model's own
// error, which the held-out error (calib/calibrate/calibration.h) measures.
// Source: mrcal 2.2, "Projection uncertainty", section "Propagation through fixed boards"; confirmed by
// refitting noisy data in tests/calib/lens/projection_uncertainty_test.cc.
#ifndef LUXFIT_CALIB_LENS_PROJECTION_UNCERTAINTY_H_
#define LUXFIT_CALIB_LENS_PROJECTION_UNCERTAINTY_H_

#include <Eigen/Core>

#include "calib/lens/camera.h"
#include "calib/lens/lens_family.h"

namespace luxfit {

// Holds the covariance of one camera. Order: free lens parameters (fx fy cx cy and distortion coefficients,
// or the control points of a splined lens); rotation, rad, and translation, m, of the mean twist, camera's
// axes.
struct ProjectionCovariance {
  LensKind kind;
  Eigen::MatrixXd covariance;  // empty: not determined
  double noise_px = 0;         // s, per axis
};

// Returns the covariance of a pixel, 2 x 2, px^2, for points `range_m` from the camera (infinity:
// directions). NaN where the lens has no inverse, or where the covariance is not determined.
Eigen::Matrix2d ProjectionCovarianceAt(const Camera& camera, const ProjectionCovariance& uncertainty,
                                       const Eigen::Vector2d& pixel, double range_m);

// Returns sigma in the worst direction, px: the square root of the larger eigenvalue of that covariance.
double ProjectionSigmaPx(const Camera& camera, const ProjectionCovariance& uncertainty,
                         const Eigen::Vector2d& pixel, double range_m);

// Returns this sigma at the middles of a raster of cells over the image, rows x columns, px.
Eigen::MatrixXd ProjectionSigmaMap(const Camera& camera, const ProjectionCovariance& uncertainty, int columns,
                                   int rows, double range_m);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LENS_PROJECTION_UNCERTAINTY_H_
