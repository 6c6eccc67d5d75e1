#include "calib/luminance/vignetting.h"

#include <cmath>

namespace luxfit {

double Vignetting::Radius2At(const Eigen::Vector2d& pixel) const {
  return (pixel - center_px).squaredNorm() / (radius_px * radius_px);
}

double Vignetting::At(const Eigen::Vector2d& pixel) const {
  const double r2 = Radius2At(pixel);
  double exponent = 0;
  for (Eigen::Index i = coefficients.size(); i-- > 0;) exponent = (exponent + coefficients[i]) * r2;
  return std::exp(exponent);
}

Vignetting NoVignetting(int width_px, int height_px) {
  Vignetting none;
  none.center_px = {(width_px - 1) / 2.0, (height_px - 1) / 2.0};
  none.radius_px = std::hypot(width_px, height_px) / 2;
  return none;
}

ImagePlane VignettingImage(const Vignetting& vignetting, int width_px, int height_px) {
  ImagePlane image(height_px, width_px);
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) image(v, u) = static_cast<float>(vignetting.At({u, v}));
  }
  return image;
}

}  // namespace luxfit
