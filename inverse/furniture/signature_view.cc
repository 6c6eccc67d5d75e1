#include "inverse/furniture/signature_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace luxfit {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

// Returns the means over squares of 2 r + 1 pixels about each; NaN where one of them is not valid, and at the border.
ImagePlane SquareMeans(const LuminanceImage& photo, Eigen::Index r) {
  const ImagePlane known = photo.valid.select(
      photo.relative_luminance, ImagePlane::Constant(photo.valid.rows(), photo.valid.cols(), kUnknown));
  const Eigen::Index rows = known.rows(), columns = known.cols();
  ImagePlane means = ImagePlane::Constant(rows, columns, kUnknown);
  if (rows <= 2 * r || columns <= 2 * r) return means;
  ImagePlane along = ImagePlane::Zero(rows, columns - 2 * r);
  for (Eigen::Index d = 0; d <= 2 * r; ++d) along += known.middleCols(d, along.cols());
  ImagePlane sum = ImagePlane::Zero(rows - 2 * r, along.cols());
  for (Eigen::Index d = 0; d <= 2 * r; ++d) sum += along.middleRows(d, sum.rows());
  means.block(r, r, sum.rows(), sum.cols()) = sum / static_cast<float>((2 * r + 1) * (2 * r + 1));
  return means;
}

// Returns the value between four pixels; NaN where one of them is unknown or lies outside.
float Between(const ImagePlane& plane, const Eigen::Vector2d& p) {
  const auto u = static_cast<Eigen::Index>(std::floor(p.x())),
             v = static_cast<Eigen::Index>(std::floor(p.y()));
  if (!(u >= 0 && v >= 0 && u + 1 < plane.cols() && v + 1 < plane.rows())) return kUnknown;
  const auto a = static_cast<float>(p.x() - static_cast<double>(u)),
             b = static_cast<float>(p.y() - static_cast<double>(v));
  return (1 - b) * ((1 - a) * plane(v, u) + a * plane(v, u + 1)) +
         b * ((1 - a) * plane(v + 1, u) + a * plane(v + 1, u + 1));
}

// Writes one state of the view. `pixels`: where each of its pixels lies in the photo.
void FillState(const LuminanceImage& photo, int r, const std::vector<Eigen::Vector2d>& pixels, size_t state,
               SignatureView& view) {
  const ImagePlane means = SquareMeans(photo, r);
  const auto count = static_cast<float>((2 * r + 1) * (2 * r + 1));
  size_t at = state;
  for (const Eigen::Vector2d& p : pixels) {
    const float mean = p.allFinite() ? Between(means, p) : kUnknown;
    if (mean > 0) {
      view.log_luminance[at] = std::log(mean);
      if (photo.variance.size() > 0)
        view.variance[at] =
            photo.variance(static_cast<Eigen::Index>(p.y()), static_cast<Eigen::Index>(p.x())) /
            (count * mean * mean);
    }
    at += static_cast<size_t>(view.states);
  }
}

}  // namespace

SignatureView MakeSignatureView(const Camera& camera, const Eigen::Isometry3d& cam_from_world,
                                const std::vector<const LuminanceImage*>& photos) {
  const double shrink = std::max(1.0, static_cast<double>(camera.width_px) / kSignatureWidthPx);
  const int r = std::max(1, static_cast<int>(std::lround(0.5 * shrink)));
  SignatureView view;
  view.cam_from_world = cam_from_world;
  view.states = static_cast<int>(photos.size());
  view.width_px = static_cast<int>(std::floor(camera.width_px / shrink));
  view.height_px = static_cast<int>(std::floor(camera.height_px / shrink));
  view.pixel_from_ray << camera.fx_px / shrink, 0, (camera.cx_px + 0.5) / shrink - 0.5, 0,
      camera.fy_px / shrink, (camera.cy_px + 0.5) / shrink - 0.5, 0, 0, 1;
  const auto count = static_cast<size_t>(view.width_px) * static_cast<size_t>(view.height_px) * photos.size();
  view.log_luminance.assign(count, kUnknown);
  view.variance.assign(count, 0);
  const Eigen::Matrix3d ray_from_pixel = view.pixel_from_ray.inverse();
  std::vector<Eigen::Vector2d> pixels;
  for (int v = 0; v < view.height_px; ++v)
    for (int u = 0; u < view.width_px; ++u)
      pixels.push_back(Project(camera, ray_from_pixel * Eigen::Vector3d(u, v, 1)));
  for (size_t s = 0; s < photos.size(); ++s)
    if (photos[s]) FillState(*photos[s], r, pixels, s, view);
  return view;
}

Eigen::Vector2d PixelOf(const SignatureView& view, const Eigen::Vector3d& p_in_world) {
  const Eigen::Vector3d q = view.pixel_from_ray * (view.cam_from_world * p_in_world);
  Eigen::Vector2d p = q.head<2>() / q.z();
  if (q.z() > 0.05 && p.x() >= 1 && p.y() >= 1 && p.x() < view.width_px - 2 && p.y() < view.height_px - 2)
    return p;
  return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace luxfit
