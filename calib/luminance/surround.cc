#include "calib/luminance/surround.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace luxfit {
namespace {

constexpr double kLeast = 1e-3;
constexpr int kCells = 200;  // along the diagonal

// Averages over cells of so many pixels along each side; those at the right and lower edge may hold fewer.
ImagePlane CellMeans(const ImagePlane& plane, Eigen::Index pixels) {
  ImagePlane means((plane.rows() + pixels - 1) / pixels, (plane.cols() + pixels - 1) / pixels);
  for (Eigen::Index v = 0; v < means.rows(); ++v) {
    for (Eigen::Index u = 0; u < means.cols(); ++u)
      means(v, u) = plane
                        .block(v * pixels, u * pixels, std::min(pixels, plane.rows() - v * pixels),
                               std::min(pixels, plane.cols() - u * pixels))
                        .mean();
  }
  return means;
}

}  // namespace

Surround::Surround(const LuminanceImage& image) {
  const ImagePlane luminance = image.relative_luminance.isFinite().select(image.relative_luminance, 0.0f);
  if (luminance.size() == 0) throw std::invalid_argument("Surround: expected an image with pixels");
  const double diagonal = std::hypot(luminance.rows(), luminance.cols());
  pixels_ = std::max<Eigen::Index>(1, std::lround(diagonal / kCells));
  const ImagePlane means = CellMeans(luminance, pixels_);
  const float least = std::max(static_cast<float>(kLeast) * means.mean(), 1e-30f);
  for (size_t j = 0; j < cells_.size(); ++j) {
    cells_[j] = means.max(least).log();
    cv::Mat cells(static_cast<int>(means.rows()), static_cast<int>(means.cols()), CV_32F, cells_[j].data());
    const double sigma_cells = kSurroundSigmas[j] * diagonal / static_cast<double>(pixels_);
    cv::GaussianBlur(cells, cells, cv::Size(), sigma_cells, sigma_cells, cv::BORDER_REPLICATE);
  }
}

}  // namespace luxfit
