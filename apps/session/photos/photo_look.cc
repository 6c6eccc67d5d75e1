#include "apps/session/photos/photo_look.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "calib/luminance/median.h"

namespace luxfit {
namespace {

constexpr int kLightWidthPx = 480, kPatternWidthPx = 80, kEdgesWidthPx = 160;
constexpr float kClipped = 0.98f;  // of the counts at which the file clips: means near it hide clipped pixels

float FromSrgb(float value) {
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

ImagePlane LightOf(const Photo& photo) {
  const float scale = static_cast<float>(photo.full_scale_counts);
  const float clipped = kClipped * static_cast<float>(photo.saturation_counts) / scale;
  const bool is_curved = photo.bits_per_channel == 8;
  return (photo.rgb_counts[1] / scale).unaryExpr([&](float value) {
    if (!(value < clipped)) return std::numeric_limits<float>::quiet_NaN();
    return is_curved ? FromSrgb(value) : value;
  });
}

// Returns the means over squares of the least size that makes the plane at most so wide.
ImagePlane Reduced(const ImagePlane& plane, int width_px) {
  const Eigen::Index step = std::min((plane.cols() + width_px - 1) / width_px, plane.rows());
  if (step <= 1) return plane;
  ImagePlane reduced(plane.rows() / step, plane.cols() / step);
  for (Eigen::Index v = 0; v < reduced.rows(); ++v) {
    for (Eigen::Index u = 0; u < reduced.cols(); ++u)
      reduced(v, u) = plane.block(v * step, u * step, step, step).mean();
  }
  return reduced;
}

// Light of much less than the median is mostly noise: the floor keeps it from making edges. Clipped pixels count as the brightest there are: the edge of a luminaire stays an edge.
ImagePlane LogLight(const ImagePlane& light) {
  std::vector<double> values;
  for (Eigen::Index i = 0; i < light.size(); ++i) {
    if (std::isfinite(light.data()[i])) values.push_back(light.data()[i]);
  }
  if (values.empty()) return ImagePlane::Zero(light.rows(), light.cols());
  const float floor = std::max(1e-6f, 0.05f * static_cast<float>(Median(values)));
  return light.unaryExpr(
      [&](float value) { return std::log(floor + (std::isfinite(value) ? std::max(value, 0.0f) : 1.0f)); });
}

// Limits the curvature, so that a luminaire's outline counts as one edge among others.
Eigen::ArrayXf EdgesOf(const ImagePlane& light) {
  constexpr float kWeakEdge = 0.4f;  // in ln light
  const ImagePlane level = LogLight(light);
  const Eigen::Index rows = level.rows() - 2, columns = level.cols() - 2;
  if (rows < 1 || columns < 1) return Eigen::ArrayXf::Zero(1);
  const ImagePlane curvature = level.block(0, 1, rows, columns) + level.block(2, 1, rows, columns) +
                               level.block(1, 0, rows, columns) + level.block(1, 2, rows, columns) -
                               4 * level.block(1, 1, rows, columns);
  const ImagePlane limited = curvature / (curvature.square() + kWeakEdge * kWeakEdge).sqrt();
  const float length = limited.matrix().norm();
  return Eigen::Map<const Eigen::ArrayXf>(limited.data(), limited.size()) / std::max(length, 1e-6f);
}

std::string PathOf(const std::string& folder, const std::string& file) {
  return (std::filesystem::path(folder) / file).string();
}

PhotoLook LightLook(const std::string& path, const std::string& file, const Photo& photo,
                    const ImagePlane& light) {
  PhotoLook look;
  look.file = file;
  look.exposure = ReadExposureMetadata(path);
  look.capture = ReadCaptureMetadata(path);
  look.width_px = photo.width_px();
  look.height_px = photo.height_px();
  look.bits_per_channel = photo.bits_per_channel;
  look.light = Reduced(light, kLightWidthPx);
  look.pattern = Reduced(look.light, kPatternWidthPx);
  return look;
}

}  // namespace

std::optional<double> PhotoLook::RelativeExposure() const {
  if (!exposure.exposure_s) return std::nullopt;
  const double f_number = exposure.f_number.value_or(1);
  return *exposure.exposure_s * exposure.iso.value_or(100) / 100 / (f_number * f_number);
}

PhotoLook LookAtLight(const std::string& folder, const std::string& file) {
  const std::string path = PathOf(folder, file);
  const Photo photo = ReadPhoto(path);
  return LightLook(path, file, photo, LightOf(photo));
}

PhotoLook LookAtPhoto(const std::string& folder, const std::string& file, const std::string& family) {
  const std::string path = PathOf(folder, file);
  const Photo photo = ReadPhoto(path);
  const ImagePlane light = LightOf(photo);
  PhotoLook look = LightLook(path, file, photo, light);
  DetectTagsOptions detect;
  detect.family = family;
  detect.decimate = std::max(1, photo.width_px() / 1500);
  look.tags = DetectTags(photo.rgb_counts[1], detect);
  look.edges = EdgesOf(Reduced(light, kEdgesWidthPx));
  return look;
}

}  // namespace luxfit
