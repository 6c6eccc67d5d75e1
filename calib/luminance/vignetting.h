// Light that a lens loses towards the corners.
//
//   ln V(r) = k_1 r^2 + k_2 r^4 + ...,   r = |pixel - centre| / radius        V = 1 at the centre
//
// The even polynomial is that of the logarithm: V stays positive, and its coefficients enter linearly beside
// the logarithms of surfaces' luminance and photos' gains.
//
// Source: Goldman, "Vignette and exposure calibration and compensation" (2010), eq. 1 (there of V itself).
#ifndef LUXFIT_CALIB_LUMINANCE_VIGNETTING_H_
#define LUXFIT_CALIB_LUMINANCE_VIGNETTING_H_

#include <Eigen/Core>

#include "calib/luminance/image.h"

namespace luxfit {

struct Vignetting {
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();
  double radius_px = 1;          // where r = 1: half the image's diagonal
  Eigen::VectorXd coefficients;  // k_1, k_2, ...; none: V = 1

  double At(const Eigen::Vector2d& pixel) const;
};

// No vignetting, with centre and radius of an image of that size.
Vignetting NoVignetting(int width_px, int height_px);

// V at every pixel, height x width.
ImagePlane VignettingImage(const Vignetting& vignetting, int width_px, int height_px);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_VIGNETTING_H_
