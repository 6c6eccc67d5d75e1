#include "calib/targets/internal/tags/find_tags.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "calib/photo_files/internal/display_image.h"

namespace luxfit {
namespace {

constexpr double kDisplayGamma = 2.2;
constexpr int kLeastSide_px = 16;  // a photo smaller than that shows no tag
// Least ratio of a tag's perimeter to the longer side of the reduced photo: 8 px a side at 1600 px. A cell of
// a smaller tag is a pixel.
constexpr double kLeastPerimeter = 0.02;

ImagePlane Reduced(const ImagePlane& grey, double scale) {
  const cv::Mat full(static_cast<int>(grey.rows()), static_cast<int>(grey.cols()), CV_32F,
                     const_cast<float*>(grey.data()));  // read only: cv::Mat has no const data
  ImagePlane small(static_cast<Eigen::Index>(std::lround(static_cast<double>(grey.rows()) / scale)),
                   static_cast<Eigen::Index>(std::lround(static_cast<double>(grey.cols()) / scale)));
  if (small.size() == 0) return small;
  cv::Mat small_mat(static_cast<int>(small.rows()), static_cast<int>(small.cols()), CV_32F, small.data());
  cv::resize(full, small_mat, small_mat.size(), 0, 0, cv::INTER_AREA);
  return small;
}

}  // namespace

ReducedPhoto ReducePhoto(const ImagePlane& grey, int longest_px) {
  ReducedPhoto photo;
  photo.scale = std::max(
      1.0, static_cast<double>(std::max(grey.rows(), grey.cols())) / static_cast<double>(longest_px));
  const ImagePlane small = photo.scale > 1 ? Reduced(grey, photo.scale) : grey;
  std::vector<uint8_t> display = DisplayImage(small, kDisplayGamma);
  photo.grey =
      cv::Mat(static_cast<int>(small.rows()), static_cast<int>(small.cols()), CV_8U, display.data()).clone();
  return photo;
}

std::vector<FoundTag> FindTags(const ReducedPhoto& photo, const cv::Ptr<cv::aruco::Dictionary>& dictionary,
                               int border_bits) {
  std::vector<FoundTag> tags;
  if (std::min(photo.grey.rows, photo.grey.cols) < kLeastSide_px) return tags;
  const auto parameters = cv::makePtr<cv::aruco::DetectorParameters>();
  parameters->markerBorderBits = border_bits;
  parameters->minMarkerPerimeterRate = kLeastPerimeter;
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
  cv::aruco::detectMarkers(photo.grey, dictionary, corners, ids, parameters);
  tags.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    FoundTag tag;
    tag.id = ids[i];
    for (std::size_t k = 0; k < 4; ++k)
      tag.corners_px[k] = photo.ToFull(Eigen::Vector2d(corners[i][k].x, corners[i][k].y));
    tags.push_back(tag);
  }
  return tags;
}

}  // namespace luxfit
