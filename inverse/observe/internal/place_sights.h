// Tells what photos show of a place: which show it bright, which should and do not, and where the rays of bright blobs run.
//
// Keeps references to everything it is given. Units: m, rad; world frame.
#ifndef LUXFIT_INVERSE_OBSERVE_INTERNAL_PLACE_SIGHTS_H_
#define LUXFIT_INVERSE_OBSERVE_INTERNAL_PLACE_SIGHTS_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <set>
#include <vector>

#include "calib/register/triangulation.h"
#include "inverse/observe/seen_luminaires.h"

namespace luxfit {

class PlaceSights {
 public:
  PlaceSights(const Room& room, const std::vector<Camera>& cameras, const std::vector<RegisteredView>& views,
              const std::vector<PhotoBlobs>& photos, const SeenLuminairesOptions& options);

  const std::vector<PhotoBlobs>& photos() const { return photos_; }
  std::set<int> States() const;

  // Returns whether it lies in the room's box, up to the error of mesh and poses.
  bool IsInRoom(const Eigen::Vector3d& place) const { return box_.contains(place); }

  // Returns the ray through a blob's centre; its direction is not finite where the lens has none.
  Sight SightOf(const PhotoBlobs& photo, const BrightBlob& blob) const;

  // Returns the rays through the points that are one sigma of a blob's centre beside and below it. A blob is known the
  // better the less it extends in that direction.
  std::array<Sight, 2> SightsBeside(const PhotoBlobs& photo, const BrightBlob& blob) const;

  // Returns a blob's area at the place, on a horizontal plane; NaN where the view sees that edge-on.
  double FacingDownM2(const PhotoBlobs& photo, const BrightBlob& blob, const Eigen::Vector3d& place) const;

  // Returns the second central moments, m2, of a blob on the horizontal plane through the place, by Green's theorem over its contour; NaN
  // where the view sees that edge-on.
  Eigen::Matrix2d MomentsM2(const PhotoBlobs& photo, const BrightBlob& blob,
                            const Eigen::Vector3d& place) const;

  // Sets the extent of a place by all photos of its states that show it whole.
  void MeasureExtent(SeenPlace& place) const;

  // Returns whether the place's image lies in the blob, up to its sigma.
  bool Shows(const PhotoBlobs& photo, const BrightBlob& blob, const SeenPlace& place) const;

  // Returns whether the photo should show the place, in the picture and in free sight, and does not.
  bool Lacks(const PhotoBlobs& photo, const SeenPlace& place) const;

  // Counts the photos of the state that show the place, and those that should and do not.
  void CountPhotos(int state, SeenPlace& place) const;

  // Returns the states other than its own in which most photos that should show it do not.
  std::vector<int> DarkStates(const SeenPlace& place) const;

  // Returns the states other than its own in which most photos that should show it have a blob there: a blob's contour, not
  // the box about it.
  std::vector<int> CoveredStates(const SeenPlace& place) const;

  // Returns whether no surface stands between the place and the view.
  bool IsFreeFrom(int view, const SeenPlace& place) const;

  // Returns where the place lies in front of the surfaces that bound its free sights: triangulation may put what hangs under a ceiling
  // above it.
  Eigen::Vector3d InFrontOfSurfaces(const SeenPlace& place) const;

  // Returns whether the place lies on a tag's paper, within three sigmas.
  bool IsOnTag(const SeenPlace& place) const;

 private:
  Sight SightThrough(const PhotoBlobs& photo, const Eigen::Vector2d& pixel, double sigma_px) const;
  const RegisteredView& View(const PhotoBlobs& photo) const {
    return views_[static_cast<size_t>(photo.view)];
  }
  const Camera& CameraOf(const RegisteredView& view) const {
    return cameras_[static_cast<size_t>(view.camera)];
  }
  // Returns whether the photo has the place's image in its picture, in free sight.
  bool MayShow(const PhotoBlobs& photo, const SeenPlace& place) const;
  // Returns whether the place's image lies in the blob's contour, up to its sigma.
  bool Covers(const PhotoBlobs& photo, const BrightBlob& blob, const SeenPlace& place) const;
  bool ShowsAny(const PhotoBlobs& photo, const SeenPlace& place) const;
  double TolerancePx(const Camera& camera, const SeenPlace& place, double distance_m) const;

  const Room& room_;
  const std::vector<Camera>& cameras_;
  const std::vector<RegisteredView>& views_;
  const std::vector<PhotoBlobs>& photos_;
  const SeenLuminairesOptions& options_;
  Eigen::AlignedBox3d box_;
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_INTERNAL_PLACE_SIGHTS_H_
