#include "calib/luminance/bright_blobs.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "calib/luminance/internal/blob_contour.h"
#include "calib/luminance/median.h"

namespace luxfit {
namespace {

// Returns the luminance above which a valid pixel is bright; 0 where no pixel is valid.
float BrightLimit(const LuminanceImage& image, double times_surfaces) {
  // Every fourth pixel: a quantile needs no more.
  constexpr Eigen::Index kStep = 4;
  std::vector<float> values;
  values.reserve(static_cast<size_t>(image.valid.size() / kStep) + 1);
  for (Eigen::Index i = 0; i < image.valid.size(); i += kStep) {
    if (image.valid.data()[i]) values.push_back(image.relative_luminance.data()[i]);
  }
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 19 / 20);
  std::nth_element(values.begin(), at, values.end());
  return static_cast<float>(times_surfaces) * *at;
}

// Marks saturated pixels that show at least half of the most. NaN and infinity count as more than anything.
PixelMask FullySaturated(const LuminanceImage& image) {
  const auto counts = image.saturated && image.relative_luminance.isFinite();
  const float most = std::max(0.0f, counts.select(image.relative_luminance, 0.0f).maxCoeff());
  return image.saturated && !(image.relative_luminance < 0.5f * most);
}

cv::Mat ToMat(const PixelMask& mask) {
  cv::Mat mat(static_cast<int>(mask.rows()), static_cast<int>(mask.cols()), CV_8U);
  for (Eigen::Index v = 0; v < mask.rows(); ++v) {
    for (Eigen::Index u = 0; u < mask.cols(); ++u)
      mat.at<uint8_t>(static_cast<int>(v), static_cast<int>(u)) = mask(v, u) ? 255 : 0;
  }
  return mat;
}

cv::Rect BoxOf(const cv::Mat& stats, int label) {
  return {stats.at<int>(label, cv::CC_STAT_LEFT), stats.at<int>(label, cv::CC_STAT_TOP),
          stats.at<int>(label, cv::CC_STAT_WIDTH), stats.at<int>(label, cv::CC_STAT_HEIGHT)};
}

// Holds sums over a blob's pixels.
struct Moments {
  double count = 0, saturated = 0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();

  void Add(const Eigen::Vector2d& p, bool is_saturated) {
    count += 1;
    saturated += is_saturated ? 1 : 0;
    sum += p;
  }
};

// Returns the median luminance of the blob's pixels.
float TypicalLuminance(const LuminanceImage& image, const cv::Mat& labels, const cv::Rect& box, int label) {
  std::vector<double> values;
  for (int v = box.y; v < box.y + box.height; ++v) {
    for (int u = box.x; u < box.x + box.width; ++u) {
      if (labels.at<int>(v, u) == label && std::isfinite(image.relative_luminance(v, u)))
        values.push_back(image.relative_luminance(v, u));
    }
  }
  return values.empty() ? 0 : static_cast<float>(Median(std::move(values)));
}

}  // namespace

std::vector<BrightBlob> FindBrightBlobs(const LuminanceImage& image, const BrightBlobOptions& options) {
  const Eigen::Index height = image.relative_luminance.rows(), width = image.relative_luminance.cols();
  if (image.saturated.rows() != height || image.saturated.cols() != width || image.valid.rows() != height ||
      image.valid.cols() != width)
    throw std::invalid_argument("FindBrightBlobs: expected planes of one size");
  if (height == 0 || width == 0) return {};
  const PixelMask saturated = FullySaturated(image);
  const float limit = BrightLimit(image, options.times_surfaces);
  const PixelMask bright =
      saturated || (image.valid && image.relative_luminance > (limit > 0 ? limit : INFINITY));
  cv::Mat labels, stats, centroids;
  const int count = cv::connectedComponentsWithStats(ToMat(bright), labels, stats, centroids, 8, CV_32S);
  std::vector<Moments> moments(static_cast<size_t>(count));
  for (int v = 0; v < labels.rows; ++v) {
    for (int u = 0; u < labels.cols; ++u) {
      const int label = labels.at<int>(v, u);
      if (label > 0) moments[static_cast<size_t>(label)].Add({u, v}, saturated(v, u));
    }
  }
  std::vector<std::pair<BrightBlob, int>> found;  // with their labels
  for (int label = 1; label < count; ++label) {
    const Moments& m = moments[static_cast<size_t>(label)];
    if (m.count < options.min_area_px2) continue;
    BrightBlob blob;
    blob.center_px = m.sum / m.count;
    const cv::Rect box = BoxOf(stats, label);
    blob.extent_px = {Eigen::Vector2d(box.x - 0.5, box.y - 0.5),
                      Eigen::Vector2d(box.br().x - 0.5, box.br().y - 0.5)};
    blob.touches_edge = box.x == 0 || box.y == 0 || box.br().x == labels.cols || box.br().y == labels.rows;
    blob.area_px2 = m.count;
    blob.saturated_share = m.saturated / m.count;
    found.emplace_back(blob, label);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first.area_px2 > b.first.area_px2; });
  if (found.size() > static_cast<size_t>(options.max_blobs))
    found.resize(static_cast<size_t>(options.max_blobs));
  std::vector<BrightBlob> blobs;
  blobs.reserve(found.size());
  for (auto& [blob, label] : found) {
    const cv::Rect box = BoxOf(stats, label);
    const float level = 0.5f * TypicalLuminance(image, labels, box, label);
    blob.contour_px =
        TraceBlobContour(image.relative_luminance, labels, box, label, level, options.contour_points);
    blobs.push_back(std::move(blob));
  }
  return blobs;
}

bool IsWithin(const BrightBlob& blob, const Eigen::Vector2d& pixel, double tolerance_px) {
  constexpr size_t kFewestCorners = 3;
  if (blob.contour_px.size() < kFewestCorners) return false;
  const auto in_cv = [](const Eigen::Vector2d& p) {
    return cv::Point2f(static_cast<float>(p.x()), static_cast<float>(p.y()));
  };
  std::vector<cv::Point2f> contour;
  contour.reserve(blob.contour_px.size());
  for (const Eigen::Vector2d& p : blob.contour_px) contour.push_back(in_cv(p));
  return cv::pointPolygonTest(contour, in_cv(pixel), true) >= -tolerance_px;
}

}  // namespace luxfit
