#include "inverse/observe/internal/place_sights.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "calib/luminance/median.h"
#include "forward/room/in_room.h"

namespace luxfit {
namespace {

// Tolerance for a luminaire just below a ceiling: the error of the mesh and of the views' poses.
constexpr double kMeshToleranceM = 0.05;
constexpr double kTagOffM = 0.02;  // error of a tag's survey and of the views' poses

// Returns the side of the square that is as large as the blob or, of a longer blob, as long: a square's diagonal is
// sqrt(2) of its side.
double WidthOf(const BrightBlob& blob) {
  double length2 = 0;
  for (const Eigen::Vector2d& a : blob.contour_px)
    for (const Eigen::Vector2d& b : blob.contour_px) length2 = std::max(length2, (a - b).squaredNorm());
  return std::sqrt(std::max(blob.area_px2, length2 / 2));
}

// Returns the second central moments of a polygon over its area: Green's theorem, by triangles with the origin.
Eigen::Matrix2d PolygonMoments(const std::vector<Eigen::Vector2d>& corners) {
  double area = 0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  for (size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double triangle = 0.5 * (a.x() * b.y() - a.y() * b.x());
    const Eigen::Vector2d sum = a + b;
    area += triangle;
    first += triangle / 3 * sum;
    second += triangle / 12 * (a * a.transpose() + b * b.transpose() + sum * sum.transpose());
  }
  const Eigen::Vector2d mean = first / area;
  return second / area - mean * mean.transpose();
}

}  // namespace

PlaceSights::PlaceSights(const Room& room, const std::vector<Camera>& cameras,
                         const std::vector<RegisteredView>& views, const std::vector<PhotoBlobs>& photos,
                         const SeenLuminairesOptions& options)
    : room_(room),
      cameras_(cameras),
      views_(views),
      photos_(photos),
      options_(options),
      box_(room.scene.Bounds()) {
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kMeshToleranceM);
  if (!box_.isEmpty()) box_ = {box_.min() - margin, box_.max() + margin};
}

std::set<int> PlaceSights::States() const {
  std::set<int> states;
  for (const PhotoBlobs& photo : photos_) states.insert(photo.state);
  return states;
}

Sight PlaceSights::SightOf(const PhotoBlobs& photo, const BrightBlob& blob) const {
  return SightThrough(photo, blob.center_px,
                      std::hypot(options_.center_sigma_px, options_.width_sigma * WidthOf(blob)));
}

std::array<Sight, 2> PlaceSights::SightsBeside(const PhotoBlobs& photo, const BrightBlob& blob) const {
  const auto beside = [&](int axis) {
    const double sigma_px =
        std::hypot(options_.center_sigma_px, options_.width_sigma * blob.extent_px.sizes()[axis]);
    return SightThrough(photo, blob.center_px + sigma_px * Eigen::Vector2d::Unit(axis), sigma_px);
  };
  return {beside(0), beside(1)};
}

Sight PlaceSights::SightThrough(const PhotoBlobs& photo, const Eigen::Vector2d& pixel,
                                double sigma_px) const {
  const RegisteredView& view = View(photo);
  const Camera& camera = CameraOf(view);
  const Eigen::Isometry3d world_from_cam = view.cam_from_world.inverse();
  return {photo.view, world_from_cam.translation(), world_from_cam.linear() * Unproject(camera, pixel),
          sigma_px / std::max(1.0, std::min(camera.fx_px, camera.fy_px))};
}

double PlaceSights::FacingDownM2(const PhotoBlobs& photo, const BrightBlob& blob,
                                 const Eigen::Vector3d& place) const {
  const RegisteredView& view = View(photo);
  const Eigen::Vector3d in_cam = view.cam_from_world * place;
  const auto j = ProjectWithJacobian(CameraOf(view), in_cam).d_pixel_d_point;
  const double px2_per_m2 = std::sqrt((j * j.transpose()).determinant());
  const Eigen::Vector3d up = view.cam_from_world.linear().col(2);
  const double cosine = std::abs(up.dot(in_cam.normalized()));
  constexpr double kEdgeOn = 0.05;
  return cosine > kEdgeOn ? blob.area_px2 / (px2_per_m2 * cosine) : std::numeric_limits<double>::quiet_NaN();
}

Eigen::Matrix2d PlaceSights::MomentsM2(const PhotoBlobs& photo, const BrightBlob& blob,
                                       const Eigen::Vector3d& place) const {
  Eigen::Matrix2d unknown = Eigen::Matrix2d::Constant(std::numeric_limits<double>::quiet_NaN());
  constexpr double kLeastSlope = 0.05;
  constexpr size_t kFewestPoints = 6;
  if (blob.contour_px.size() < kFewestPoints) return unknown;
  std::vector<Eigen::Vector2d> corners;
  corners.reserve(blob.contour_px.size());
  for (const Eigen::Vector2d& pixel : blob.contour_px) {
    const Sight sight = SightThrough(photo, pixel, 1);
    const double t = (place.z() - sight.origin.z()) / sight.direction.z();
    if (!(t > 0) || std::abs(sight.direction.z()) < kLeastSlope * sight.direction.norm()) return unknown;
    corners.emplace_back((sight.origin + t * sight.direction - place).head<2>());
  }
  return PolygonMoments(corners);
}

void PlaceSights::MeasureExtent(SeenPlace& place) const {
  constexpr double kAlong = 0.866;  // cosine of 30 degrees
  struct Shown {
    Eigen::Matrix2d moments;
    Eigen::Vector2d direction;  // from the eye
  };
  std::vector<Shown> shown;
  std::vector<double> xx, xy, yy;
  for (const PhotoBlobs& photo : photos_) {
    if (std::count(place.states.begin(), place.states.end(), photo.state) == 0) continue;
    for (const BrightBlob& blob : photo.blobs) {
      if (blob.touches_edge || !Shows(photo, blob, place)) continue;
      const Eigen::Matrix2d moments = MomentsM2(photo, blob, place.position);
      if (!moments.allFinite()) continue;
      const Eigen::Vector3d eye =
          views_[static_cast<size_t>(photo.view)].cam_from_world.inverse().translation();
      shown.push_back({moments, (place.position - eye).head<2>().normalized()});
      xx.push_back(moments(0, 0)), xy.push_back(moments(0, 1)), yy.push_back(moments(1, 1));
    }
  }
  if (shown.empty()) return;
  Eigen::Matrix2d moments;
  moments << Quantile(std::move(xx), 0.5), 0, 0, Quantile(std::move(yy), 0.5);
  moments(0, 1) = moments(1, 0) = Quantile(std::move(xy), 0.5);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(moments);
  // A body that hangs down from the plane, as a globe does, seems longer along the sight: the shortest length over views counts. A view
  // along an axis tells no length of it.
  Eigen::Array2d least = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity());
  for (const Shown& one : shown) {
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d along = axes.eigenvectors().col(1 - axis);
      if (std::abs(along.dot(one.direction)) < kAlong)
        least[axis] = std::min(least[axis], along.dot(one.moments * along));
    }
  }
  if (!least.isFinite().all() || least[0] < least[1]) return;
  // A side a has the moment a^2 / 12.
  place.size_m = (12 * least.max(0)).sqrt();
  place.heading << axes.eigenvectors().col(1), 0;
}

double PlaceSights::TolerancePx(const Camera& camera, const SeenPlace& place, double distance_m) const {
  return 3 * options_.center_sigma_px + place.sigma_m * camera.fx_px / distance_m;
}

bool PlaceSights::Shows(const PhotoBlobs& photo, const BrightBlob& blob, const SeenPlace& place) const {
  const RegisteredView& view = View(photo);
  const Camera& camera = CameraOf(view);
  const Eigen::Vector3d in_cam = view.cam_from_world * place.position;
  const Eigen::Vector2d pixel = Project(camera, in_cam);
  return pixel.allFinite() &&
         blob.extent_px.exteriorDistance(pixel) <= TolerancePx(camera, place, in_cam.norm());
}

bool PlaceSights::ShowsAny(const PhotoBlobs& photo, const SeenPlace& place) const {
  return std::any_of(photo.blobs.begin(), photo.blobs.end(),
                     [&](const BrightBlob& b) { return Shows(photo, b, place); });
}

bool PlaceSights::Lacks(const PhotoBlobs& photo, const SeenPlace& place) const {
  return !ShowsAny(photo, place) && MayShow(photo, place);
}

bool PlaceSights::MayShow(const PhotoBlobs& photo, const SeenPlace& place) const {
  const RegisteredView& view = View(photo);
  const Camera& camera = CameraOf(view);
  const Eigen::Vector3d in_cam = view.cam_from_world * place.position;
  const Eigen::Vector2d pixel = Project(camera, in_cam);
  if (!pixel.allFinite()) return false;
  const double tolerance_px = TolerancePx(camera, place, in_cam.norm());
  const Eigen::AlignedBox2d inside(
      Eigen::Vector2d::Constant(tolerance_px),
      Eigen::Vector2d(camera.width_px - 1 - tolerance_px, camera.height_px - 1 - tolerance_px));
  return inside.contains(pixel) && IsFreeFrom(photo.view, place);
}

bool PlaceSights::Covers(const PhotoBlobs& photo, const BrightBlob& blob, const SeenPlace& place) const {
  const RegisteredView& view = View(photo);
  const Camera& camera = CameraOf(view);
  const Eigen::Vector3d in_cam = view.cam_from_world * place.position;
  const Eigen::Vector2d pixel = Project(camera, in_cam);
  return pixel.allFinite() && IsWithin(blob, pixel, TolerancePx(camera, place, in_cam.norm()));
}

void PlaceSights::CountPhotos(int state, SeenPlace& place) const {
  for (const PhotoBlobs& photo : photos_) {
    if (photo.state != state) continue;
    if (ShowsAny(photo, place)) {
      ++place.photos;
    } else if (Lacks(photo, place)) {
      ++place.missing;
    }
  }
}

std::vector<int> PlaceSights::DarkStates(const SeenPlace& place) const {
  std::vector<int> dark;
  for (const int state : States()) {
    if (std::count(place.states.begin(), place.states.end(), state) > 0) continue;
    SeenPlace here = place;
    here.photos = here.missing = 0;
    CountPhotos(state, here);
    if (here.missing > here.photos) dark.push_back(state);
  }
  return dark;
}

std::vector<int> PlaceSights::CoveredStates(const SeenPlace& place) const {
  std::vector<int> covered;
  for (const int state : States()) {
    if (std::count(place.states.begin(), place.states.end(), state) > 0) continue;
    int with = 0, without = 0;
    for (const PhotoBlobs& photo : photos_) {
      if (photo.state != state || !MayShow(photo, place)) continue;
      const bool is_covered = std::any_of(photo.blobs.begin(), photo.blobs.end(),
                                          [&](const BrightBlob& blob) { return Covers(photo, blob, place); });
      ++(is_covered ? with : without);
    }
    if (with > without) covered.push_back(state);
  }
  return covered;
}

bool PlaceSights::IsFreeFrom(int view, const SeenPlace& place) const {
  const Eigen::Vector3d eye = views_[static_cast<size_t>(view)].cam_from_world.inverse().translation();
  const double skipped_m = kMeshToleranceM + 2 * place.sigma_m;
  const Eigen::Vector3d to_eye = eye - place.position;
  if (to_eye.norm() <= skipped_m) return true;
  return !room_.rays.Occluded(eye, place.position + skipped_m * to_eye.normalized());
}

Eigen::Vector3d PlaceSights::InFrontOfSurfaces(const SeenPlace& place) const {
  constexpr double kInFrontM = 0.01;
  Eigen::Vector3d position = place.position;
  for (size_t v = 0; v < views_.size(); ++v) {
    if (!IsFreeFrom(static_cast<int>(v), place)) continue;
    const Eigen::Vector3d eye = views_[v].cam_from_world.inverse().translation(), to_place = position - eye;
    const RayHit hit = room_.rays.Trace(eye, to_place.normalized());
    if (hit.facet < 0 || !hit.front || hit.distance > to_place.norm()) continue;
    position = InFrontOf(room_.scene, hit, position, kInFrontM);
  }
  return position;
}

bool PlaceSights::IsOnTag(const SeenPlace& place) const {
  constexpr double kPaperOverTag = 1.5;  // side of the sheet's white square over that of the tag
  return std::any_of(options_.tags.begin(), options_.tags.end(), [&](const SurveyedTag& tag) {
    const Eigen::Vector3d off = place.position - tag.center_in_world;
    const double above = off.dot(tag.normal_in_world), up = off.dot(tag.up_in_world);
    const double across = off.dot(tag.normal_in_world.cross(tag.up_in_world));
    const double half_m = 0.5 * kPaperOverTag * tag.size_m + place.sigma_m;
    return std::abs(above) < 3 * place.sigma_m + kTagOffM &&
           std::max(std::abs(up), std::abs(across)) < half_m;
  });
}

}  // namespace luxfit
