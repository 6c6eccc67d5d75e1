// How far a calibrated camera's pixels may be off: the covariance of a projection.
//
// mrcal's "mean-pcam": a point p that projects to q is fixed to the boards (or the room) of the calibration.
// Where noise in the corners moves lens and poses, each image's board carries p along; the mean of these is
// where p went, and q moves with it:
//   dq = df/dlens dlens + df/dp (w x p + v),   (w, v): mean twist of the images' poses in the camera's frame
//   covariance(q) = D C D^T,   C: covariance of (lens, w, v), from the adjustment's J: s^2 (J^T J)^-1
// s is the noise that the residuals show, one weight for all corners. Directions (a range that is infinite)
// move with w alone. J holds libmrcal's weak regularisation: where no corner was, parametric lenses
// extrapolate and say so, splined lenses are as uncertain as that prior leaves them.
//
// Assumes that the lens model can be the true lens, so it knows nothing of a model's own error: that is what
// the held-out error (calib/calibrate/calibration.h) is for.
// Source: mrcal 2.2, "Projection uncertainty", section "Propagation through fixed boards"; confirmed by
// refitting noisy data in tests/calib/lens/projection_uncertainty_test.cc.
#ifndef LUXFIT_CALIB_LENS_PROJECTION_UNCERTAINTY_H_
#define LUXFIT_CALIB_LENS_PROJECTION_UNCERTAINTY_H_

#include <Eigen/Core>

#include "calib/lens/camera.h"
#include "calib/lens/lens_kind.h"

namespace luxfit {

// Of one camera. Order: free lens parameters (fx fy cx cy and distortion coefficients; control points of a
// splined lens), then the rotation in rad and the translation in m of the mean twist, camera's axes.
struct ProjectionCovariance {
  LensKind kind;
  Eigen::MatrixXd covariance;  // empty: not determined
  double noise_px = 0;         // s, per axis
};

// 2 x 2, px^2, at a pixel, for points `range_m` from the camera (infinity: directions). NaN where the lens
// has no inverse, or nothing is known.
Eigen::Matrix2d ProjectionCovarianceAt(const Camera& camera, const ProjectionCovariance& uncertainty,
                                       const Eigen::Vector2d& pixel, double range_m);

// Square root of the larger eigenvalue of the above: sigma in the worst direction, px.
double ProjectionSigmaPx(const Camera& camera, const ProjectionCovariance& uncertainty,
                         const Eigen::Vector2d& pixel, double range_m);

// That at the middles of a raster of cells over the image, rows x columns, px.
Eigen::MatrixXd ProjectionSigmaMap(const Camera& camera, const ProjectionCovariance& uncertainty, int columns,
                                   int rows, double range_m);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LENS_PROJECTION_UNCERTAINTY_H_
