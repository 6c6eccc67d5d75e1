#include "calib/lens/picture_view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/luminance/internal/plane_sample.h"

namespace luxfit {
namespace {

constexpr double kRightAngle = 1.5707963267948966;
constexpr double kWidestPinholeRad = kRightAngle * 2 / 3;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

double AngleFromAxis(const Eigen::Vector3d& direction) {
  return std::atan2(direction.head<2>().norm(), direction.z());
}

Eigen::Vector2d OnPlane(PictureProjection projection, const Eigen::Vector3d& direction) {
  if (projection == PictureProjection::kPerspective) return direction.head<2>() / direction.z();
  const double across = direction.head<2>().norm();
  return across > 0 ? Eigen::Vector2d(AngleFromAxis(direction) / across * direction.head<2>())
                    : Eigen::Vector2d::Zero();
}

bool FitsPinhole(const Camera& camera) {
  for (const double u : {0.0, camera.width_px - 1.0}) {
    for (const double v : {0.0, camera.height_px - 1.0}) {
      // The comparison is negated so that a corner without an image counts as wide.
      if (!(AngleFromAxis(Unproject(camera, {u, v})) <= kWidestPinholeRad)) return false;
    }
  }
  return true;
}

// Returns how far from the axis both borders of the photo lie at least: axis 0, its left and right; axis 1, its
// top and bottom.
double HalfExtent(const Camera& camera, PictureProjection projection, int axis) {
  const int across = axis == 0 ? camera.width_px : camera.height_px;
  const int along = axis == 0 ? camera.height_px : camera.width_px;
  double extent = projection == PictureProjection::kPerspective ? std::tan(kWidestPinholeRad) : kRightAngle;
  for (int i = 0; i < along; ++i) {
    for (const bool is_far : {false, true}) {
      Eigen::Vector2d pixel;
      pixel[axis] = is_far ? across - 1 : 0;
      pixel[1 - axis] = i;
      const double at = OnPlane(projection, Unproject(camera, pixel))[axis];
      if (std::isfinite(at)) extent = std::min(extent, is_far ? at : -at);
    }
  }
  return std::max(0.0, extent);
}

// Tells whether the lens images the direction at that place and no other one: beyond the field of view that it
// was calibrated for, a polynomial folds directions back into the photo.
bool IsImageOf(const Camera& camera, const Eigen::Vector2d& place, const Eigen::Vector3d& direction) {
  constexpr double kSameDirection = 1e-4;
  return (Unproject(camera, place) - direction).norm() < kSameDirection;
}

Eigen::Vector2d PlaceOf(const Camera& camera, const Eigen::Vector3d& direction) {
  if (!direction.allFinite()) return {kNan, kNan};
  const Eigen::Vector2d place = Project(camera, direction);
  const Eigen::Vector2d last(camera.width_px - 1, camera.height_px - 1);
  Eigen::Vector2d held = place.cwiseMax(0).cwiseMin(last);
  constexpr double kRoundingPx = 1e-3;
  if (!((place - held).norm() < kRoundingPx) || !IsImageOf(camera, place, direction)) return {kNan, kNan};
  return held;
}

}  // namespace

PictureView PictureViewOf(const Camera& camera) {
  PictureView view;
  view.projection = FitsPinhole(camera) ? PictureProjection::kPerspective : PictureProjection::kAngular;
  view.focal_px = camera.fx_px;
  const auto pixels = [&](int axis) {
    constexpr double kRoundingPx = 1e-6;
    return static_cast<int>(2 * view.focal_px * HalfExtent(camera, view.projection, axis) + kRoundingPx) + 1;
  };
  view.width_px = pixels(0);
  view.height_px = pixels(1);
  return view;
}

double AngleAcross(const PictureView& view, int size_px) {
  return view.projection == PictureProjection::kPerspective ? 2 * std::atan(size_px / (2 * view.focal_px))
                                                            : size_px / view.focal_px;
}

Eigen::Vector3d DirectionOf(const PictureView& view, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d centre((view.width_px - 1) / 2.0, (view.height_px - 1) / 2.0);
  const Eigen::Vector2d at = (pixel - centre) / view.focal_px;
  if (view.projection == PictureProjection::kPerspective)
    return Eigen::Vector3d(at.x(), at.y(), 1).normalized();
  const double theta = at.norm();
  if (theta > kRightAngle) return Eigen::Vector3d::Constant(kNan);
  const Eigen::Vector2d across = theta > 0 ? Eigen::Vector2d(std::sin(theta) / theta * at) : at;
  return {across.x(), across.y(), std::cos(theta)};
}

PhotoPlaces PlacesInPhoto(const PictureView& view, const Camera& camera) {
  PhotoPlaces places(2, static_cast<Eigen::Index>(view.width_px) * view.height_px);
  tbb::parallel_for(0, view.height_px, [&](int v) {
    for (int u = 0; u < view.width_px; ++u)
      places.col(static_cast<Eigen::Index>(v) * view.width_px + u) =
          PlaceOf(camera, DirectionOf(view, Eigen::Vector2d(u, v))).cast<float>();
  });
  return places;
}

ImagePlane Resampled(const ImagePlane& photo, const PhotoPlaces& places, const PictureView& view) {
  ImagePlane picture(view.height_px, view.width_px);
  for (Eigen::Index i = 0; i < picture.size(); ++i)
    picture.data()[i] = static_cast<float>(SampleBilinear(photo, places.col(i).cast<double>()));
  return picture;
}

}  // namespace luxfit
