#include "inverse/observe/seen_luminaires.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "calib/luminance/median.h"
#include "calib/register/triangulation.h"
#include "inverse/observe/internal/place_sights.h"
#include "inverse/observe/internal/places_at_height.h"

namespace luxfit {
namespace {

struct BlobOfPhoto {
  const PhotoBlobs* photo = nullptr;
  const BrightBlob* blob = nullptr;
};

class SeenSearch {
 public:
  SeenSearch(const PlaceSights& sights, int min_views) : sights_(sights), min_views_(min_views) {}

  std::vector<SeenPlace> Run() const {
    std::vector<SeenPlace> places;
    for (const int state : sights_.States()) {
      for (const SeenPlace& place : OfState(state)) Merge(place, places);
    }
    AddPlacesAtCommonHeights(sights_, places);
    for (SeenPlace& place : places) {
      place.dark_states = sights_.DarkStates(place);
      place.covered_states = sights_.CoveredStates(place);
      sights_.MeasureExtent(place);
      place.position = sights_.InFrontOfSurfaces(place);
    }
    std::stable_sort(places.begin(), places.end(),
                     [](const SeenPlace& a, const SeenPlace& b) { return a.views > b.views; });
    return places;
  }

 private:
  std::vector<SeenPlace> OfState(int state) const {
    std::vector<BlobOfPhoto> blobs;
    std::vector<Sight> sights;
    for (const PhotoBlobs& photo : sights_.photos()) {
      if (photo.state != state) continue;
      for (const BrightBlob& blob : photo.blobs) {
        const Sight sight = sights_.SightOf(photo, blob);
        if (blob.touches_edge || !sight.direction.allFinite()) continue;
        blobs.push_back({&photo, &blob});
        sights.push_back(sight);
      }
    }
    TriangulationOptions options;
    options.min_views = min_views_;
    std::vector<SeenPlace> places;
    for (const TriangulatedPoint& point : TriangulateSights(sights, options)) {
      if (!sights_.IsInRoom(point.position)) continue;
      SeenPlace place = PlaceOf(point, blobs);
      place.states = {state};
      sights_.CountPhotos(state, place);
      if (place.photos > place.missing && IsInFreeSight(place, point, blobs) && !sights_.IsOnTag(place))
        places.push_back(place);
    }
    return places;
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
      const double area = sights_.FacingDownM2(*seen.photo, *seen.blob, point.position);
      if (std::isfinite(area)) areas.push_back(area);
    }
    place.area_m2 = Quantile(std::move(areas), 0.5);
    return place;
  }

  // Returns whether no surface stands between the place and half of the views that saw it, or more.
  bool IsInFreeSight(const SeenPlace& place, const TriangulatedPoint& point,
                     const std::vector<BlobOfPhoto>& blobs) const {
    const auto free = std::count_if(point.sights.begin(), point.sights.end(), [&](int i) {
      return sights_.IsFreeFrom(blobs[static_cast<size_t>(i)].photo->view, place);
    });
    return 2 * free >= static_cast<std::ptrdiff_t>(point.sights.size());
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

  const PlaceSights& sights_;
  int min_views_;
};

}  // namespace

bool MayBePlaceOf(const SeenPlace& place, const std::vector<Eigen::VectorXd>& dimming, int luminaire) {
  if (place.states.empty()) return false;
  const auto factor = [&](int state) { return dimming[static_cast<size_t>(state)][luminaire]; };
  double lowest = std::numeric_limits<double>::infinity();  // at which it is bright
  for (const int state : place.states) lowest = std::min(lowest, factor(state));
  const bool is_another = std::any_of(place.covered_states.begin(), place.covered_states.end(),
                                      [&](int state) { return factor(state) == 0; });
  return lowest > 0 && !is_another &&
         std::none_of(place.dark_states.begin(), place.dark_states.end(),
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
  const PlaceSights sights(room, cameras, views, photos, options);
  return SeenSearch(sights, options.min_views).Run();
}

}  // namespace luxfit
