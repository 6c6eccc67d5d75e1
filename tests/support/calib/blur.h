// Lens blur of rendered photos.
#ifndef LUXFIT_TESTS_SUPPORT_CALIB_BLUR_H_
#define LUXFIT_TESTS_SUPPORT_CALIB_BLUR_H_

#include <algorithm>
#include <cmath>

#include "calib/photo_files/image.h"

namespace luxfit::support {

// A Gaussian of that standard deviation.
inline ImagePlane Blurred(const ImagePlane& sharp, double sigma_px) {
  if (!(sigma_px > 0)) return sharp;
  const int reach = static_cast<int>(std::ceil(4 * sigma_px));
  Eigen::ArrayXf kernel(2 * reach + 1);
  for (int i = -reach; i <= reach; ++i)
    kernel[i + reach] = static_cast<float>(std::exp(-0.5 * i * i / (sigma_px * sigma_px)));
  kernel /= kernel.sum();
  ImagePlane rows = ImagePlane::Zero(sharp.rows(), sharp.cols()), out = rows;
  for (int i = -reach; i <= reach; ++i) {
    for (Eigen::Index u = 0; u < sharp.cols(); ++u)
      rows.col(u) += kernel[i + reach] * sharp.col(std::clamp<Eigen::Index>(u + i, 0, sharp.cols() - 1));
  }
  for (int i = -reach; i <= reach; ++i) {
    for (Eigen::Index v = 0; v < sharp.rows(); ++v)
      out.row(v) += kernel[i + reach] * rows.row(std::clamp<Eigen::Index>(v + i, 0, sharp.rows() - 1));
  }
  return out;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_CALIB_BLUR_H_
