#include "inverse/observe/seen_luminaires.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

#include "calib/luminance/median.h"
#include "calib/register/triangulation.h"

namespace luxfit {
namespace {

// Tolerance for a luminaire just below a ceiling: the error of the mesh and of the views' poses.
constexpr double kMeshToleranceM = 0.05;
constexpr double kTagOffM = 0.02;  // error of a tag's survey and of the views' poses

struct BlobOfPhoto {
  const PhotoBlobs* photo = nullptr;
  const BrightBlob* blob = nullptr;
};

// Returns the side of the square that is as large as the blob or, of a longer blob, as long: a square's diagonal is
// sqrt(2) of its side.
double WidthOf(const BrightBlob& blob) {
  double length2 = 0;
  for (const Eigen::Vector2d& a : blob.contour_px)
    for (const Eigen::Vector2d& b : blob.contour_px) length2 = std::max(length2, (a - b).squaredNorm());
  return std::sqrt(std::max(blob.area_px2, length2 / 2));
}

class SeenSearch {
 public:
  SeenSearch(const Room& room, const std::vector<Camera>& cameras, const std::vector<RegisteredView>& views,
             const std::vector<PhotoBlobs>& photos, const SeenLuminairesOptions& options)
      : room_(room), cameras_(cameras), views_(views), photos_(photos), options_(options) {
    box_ = room.scene.Bounds();
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kMeshToleranceM);
    if (!box_.isEmpty()) box_ = {box_.min() - margin, box_.max() + margin};
  }

  std::vector<SeenPlace> Run() const {
    std::set<int> states;
    for (const PhotoBlobs& photo : photos_) states.insert(photo.state);
    std::vector<SeenPlace> places;
    for (const int state : states) {
      for (const SeenPlace& place : OfState(state)) Merge(place, places);
    }
    for (SeenPlace& place : places) place.dark_states = DarkStates(place, states);
    std::stable_sort(places.begin(), places.end(),
                     [](const SeenPlace& a, const SeenPlace& b) { return a.views > b.views; });
    return places;
  }

 private:
  const RegisteredView& View(const PhotoBlobs& photo) const {
    return views_[static_cast<size_t>(photo.view)];
  }
  const Camera& CameraOf(const RegisteredView& view) const {
    return cameras_[static_cast<size_t>(view.camera)];
  }

  std::vector<SeenPlace> OfState(int state) const {
    std::vector<BlobOfPhoto> blobs;
    std::vector<Sight> sights;
    for (const PhotoBlobs& photo : photos_) {
      if (photo.state != state) continue;
      for (const BrightBlob& blob : photo.blobs) {
        const Sight sight = SightOf(photo, blob);
        if (blob.touches_edge || !sight.direction.allFinite()) continue;
        blobs.push_back({&photo, &blob});
        sights.push_back(sight);
      }
    }
    TriangulationOptions options;
    options.min_views = options_.min_views;
    std::vector<SeenPlace> places;
    for (const TriangulatedPoint& point : TriangulateSights(sights, options)) {
      if (!box_.contains(point.position)) continue;
      SeenPlace place = PlaceOf(point, blobs);
      place.states = {state};
      CountPhotos(state, place);
      if (place.photos > place.missing && IsInFreeSight(place, point, blobs) && !IsOnTag(place))
        places.push_back(place);
    }
    return places;
  }

  Sight SightOf(const PhotoBlobs& photo, const BrightBlob& blob) const {
    const RegisteredView& view = View(photo);
    const Camera& camera = CameraOf(view);
    const Eigen::Isometry3d world_from_cam = view.cam_from_world.inverse();
    const double sigma_px = std::hypot(options_.center_sigma_px, options_.width_sigma * WidthOf(blob));
    return {photo.view, world_from_cam.translation(),
            world_from_cam.linear() * Unproject(camera, blob.center_px),
            sigma_px / std::max(1.0, std::min(camera.fx_px, camera.fy_px))};
  }

  SeenPlace PlaceOf(const TriangulatedPoint& point, const std::vector<BlobOfPhoto>& blobs) const {
    SeenPlace place;
    place.position = point.position;
    place.views = static_cast<int>(point.sights.size());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(point.covariance_m2, Eigen::EigenvaluesOnly);
    place.sigma_m = std::sqrt(std::max(0.0, axes.eigenvalues()[2]));
    std::vector<double> areas;
    for (const int i : point.sights) {
      const BlobOfPhoto& seen = blobs[static_cast<size_t>(i)];
      const double area = FacingDownM2(*seen.photo, *seen.blob, point.position);
      if (std::isfinite(area)) areas.push_back(area);
    }
    place.area_m2 = Quantile(std::move(areas), 0.5);
    return place;
  }

  // Returns a blob's area at the place, on a horizontal plane.
  double FacingDownM2(const PhotoBlobs& photo, const BrightBlob& blob, const Eigen::Vector3d& place) const {
    const RegisteredView& view = View(photo);
    const Eigen::Vector3d in_cam = view.cam_from_world * place;
    const auto j = ProjectWithJacobian(CameraOf(view), in_cam).d_pixel_d_point;
    const double px2_per_m2 = std::sqrt((j * j.transpose()).determinant());
    const Eigen::Vector3d up = view.cam_from_world.linear().col(2);
    const double cosine = std::abs(up.dot(in_cam.normalized()));
    constexpr double kEdgeOn = 0.05;
    return cosine > kEdgeOn ? blob.area_px2 / (px2_per_m2 * cosine)
                            : std::numeric_limits<double>::quiet_NaN();
  }

  // Counts the photos of the state that show the place, and those that should and do not.
  void CountPhotos(int state, SeenPlace& place) const {
    for (const PhotoBlobs& photo : photos_) {
      if (photo.state != state) continue;
      const RegisteredView& view = View(photo);
      const Camera& camera = CameraOf(view);
      const Eigen::Vector3d in_cam = view.cam_from_world * place.position;
      const Eigen::Vector2d pixel = Project(camera, in_cam);
      if (!pixel.allFinite()) continue;
      const double tolerance_px = 3 * options_.center_sigma_px + place.sigma_m * camera.fx_px / in_cam.norm();
      if (std::any_of(photo.blobs.begin(), photo.blobs.end(), [&](const BrightBlob& b) {
            return b.extent_px.exteriorDistance(pixel) <= tolerance_px;
          })) {
        ++place.photos;
        continue;
      }
      const Eigen::AlignedBox2d inside(
          Eigen::Vector2d::Constant(tolerance_px),
          Eigen::Vector2d(camera.width_px - 1 - tolerance_px, camera.height_px - 1 - tolerance_px));
      if (inside.contains(pixel) && Sees(view, place)) ++place.missing;
    }
  }

  std::vector<int> DarkStates(const SeenPlace& place, const std::set<int>& states) const {
    std::vector<int> dark;
    for (const int state : states) {
      if (std::count(place.states.begin(), place.states.end(), state) > 0) continue;
      SeenPlace here = place;
      here.photos = here.missing = 0;
      CountPhotos(state, here);
      if (here.missing > here.photos) dark.push_back(state);
    }
    return dark;
  }

  // Returns whether no surface stands between the place and half of the views that saw it, or more.
  bool IsInFreeSight(const SeenPlace& place, const TriangulatedPoint& point,
                     const std::vector<BlobOfPhoto>& blobs) const {
    const auto free = std::count_if(point.sights.begin(), point.sights.end(), [&](int i) {
      return Sees(View(*blobs[static_cast<size_t>(i)].photo), place);
    });
    return 2 * free >= static_cast<std::ptrdiff_t>(point.sights.size());
  }

  // Returns whether the place lies on a tag's paper, within three sigmas.
  bool IsOnTag(const SeenPlace& place) const {
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

  bool Sees(const RegisteredView& view, const SeenPlace& place) const {
    const Eigen::Vector3d eye = view.cam_from_world.inverse().translation();
    const double skipped_m = kMeshToleranceM + 2 * place.sigma_m;
    const Eigen::Vector3d to_eye = eye - place.position;
    if (to_eye.norm() <= skipped_m) return true;
    return !room_.rays.Occluded(eye, place.position + skipped_m * to_eye.normalized());
  }

  // Merges the same place of another state. The one that more views saw stands for both.
  static void Merge(const SeenPlace& place, std::vector<SeenPlace>& places) {
    const auto same = std::find_if(places.begin(), places.end(), [&](const SeenPlace& p) {
      return (p.position - place.position).norm() < 3 * std::hypot(p.sigma_m, place.sigma_m);
    });
    if (same == places.end()) {
      places.push_back(place);
      return;
    }
    const SeenPlace other = *same;
    // Two places of one state stay apart.
    if (other.states.back() == place.states.back()) {
      places.push_back(place);
      return;
    }
    const bool is_better =
        place.views > other.views || (place.views == other.views && place.sigma_m < other.sigma_m);
    if (is_better) *same = place;
    same->states = other.states;
    same->states.insert(same->states.end(), place.states.begin(), place.states.end());
    same->photos = other.photos + place.photos;
    same->missing = other.missing + place.missing;
  }

  const Room& room_;
  const std::vector<Camera>& cameras_;
  const std::vector<RegisteredView>& views_;
  const std::vector<PhotoBlobs>& photos_;
  const SeenLuminairesOptions& options_;
  Eigen::AlignedBox3d box_;
};

}  // namespace

bool MayBePlaceOf(const SeenPlace& place, const std::vector<Eigen::VectorXd>& dimming, int luminaire) {
  if (place.states.empty()) return false;
  const auto factor = [&](int state) { return dimming[static_cast<size_t>(state)][luminaire]; };
  double lowest = std::numeric_limits<double>::infinity();  // at which it is bright
  for (const int state : place.states) lowest = std::min(lowest, factor(state));
  return lowest > 0 && std::none_of(place.dark_states.begin(), place.dark_states.end(),
                                    [&](int state) { return factor(state) >= lowest; });
}

std::vector<SeenPlace> FindSeenLuminaires(const Room& room, const std::vector<Camera>& cameras,
                                          const std::vector<RegisteredView>& views,
                                          const std::vector<PhotoBlobs>& photos,
                                          const SeenLuminairesOptions& options) {
  for (const PhotoBlobs& photo : photos) {
    if (photo.view < 0 || static_cast<size_t>(photo.view) >= views.size())
      throw std::invalid_argument("FindSeenLuminaires: view: expected one of the registered ones");
  }
  return SeenSearch(room, cameras, views, photos, options).Run();
}

}  // namespace luxfit
