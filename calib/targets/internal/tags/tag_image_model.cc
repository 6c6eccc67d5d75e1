#include "calib/targets/internal/tags/tag_image_model.h"

#include <algorithm>
#include <cmath>

namespace luxfit {

TagImageModel::TagImageModel(const TagPicture& picture) : size_(picture.total_cells() + 2 * kMargin) {
  integral_ = Eigen::ArrayXXd::Zero(size_ + 1, size_ + 1);
  const int last = picture.total_cells() - 1;
  for (int row = 0; row < size_; ++row) {
    for (int col = 0; col < size_; ++col) {
      const double cell =
          picture.cells(std::clamp(row - kMargin, 0, last), std::clamp(col - kMargin, 0, last));
      integral_(row + 1, col + 1) =
          cell + integral_(row, col + 1) + integral_(row + 1, col) - integral_(row, col);
    }
  }
}

TagImageModel::Integral TagImageModel::IntegralTo(double s, double t) const {
  const double x = std::clamp(s + kMargin, 0.0, static_cast<double>(size_));
  const double y = std::clamp(t + kMargin, 0.0, static_cast<double>(size_));
  const int col = std::min(static_cast<int>(x), size_ - 1);
  const int row = std::min(static_cast<int>(y), size_ - 1);
  const double fx = x - col, fy = y - row;
  const double f00 = integral_(row, col), f01 = integral_(row, col + 1);
  const double f10 = integral_(row + 1, col), f11 = integral_(row + 1, col + 1);
  Integral out;
  const double top = f00 + fx * (f01 - f00), bottom = f10 + fx * (f11 - f10);
  out.value = top + fy * (bottom - top);
  out.d_s = (1 - fy) * (f01 - f00) + fy * (f11 - f10);
  out.d_t = bottom - top;
  return out;
}

TagImageModel::Sample TagImageModel::Mean(double s, double t, double width_s, double width_t) const {
  const double s0 = s - width_s / 2, s1 = s + width_s / 2;
  const double t0 = t - width_t / 2, t1 = t + width_t / 2;
  const Integral f00 = IntegralTo(s0, t0), f10 = IntegralTo(s1, t0);
  const Integral f01 = IntegralTo(s0, t1), f11 = IntegralTo(s1, t1);
  const double area = width_s * width_t;
  // Integrals of the picture along the four sides of the box.
  const double right = f11.d_s - f10.d_s, left = f01.d_s - f00.d_s;
  const double bottom = f11.d_t - f01.d_t, top = f10.d_t - f00.d_t;
  Sample out;
  out.mean = (f11.value - f10.value - f01.value + f00.value) / area;
  out.d_s = (right - left) / area;
  out.d_t = (bottom - top) / area;
  out.d_width_s = (right + left) / 2 / area - out.mean / width_s;
  out.d_width_t = (bottom + top) / 2 / area - out.mean / width_t;
  return out;
}

}  // namespace luxfit
