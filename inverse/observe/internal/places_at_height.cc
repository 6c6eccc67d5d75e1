#include "inverse/observe/internal/places_at_height.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "calib/luminance/median.h"

namespace luxfit {
namespace {

constexpr int kFewestPlaces = 3;        // of one height, by chance no more
constexpr double kLikeArea = 1.5;       // ratio of areas of one kind
constexpr double kLargestSigmaM = 0.5;  // a ray that grazes the height tells no place

struct CommonHeight {
  double z_m = 0, sigma_m = 0;
  double area_m2 = 0;
};

bool IsLikeArea(double a, double b) { return a < kLikeArea * b && b < kLikeArea * a; }

double HeightApartSigmas(const SeenPlace& a, const SeenPlace& b) {
  return std::abs(a.position.z() - b.position.z()) / std::hypot(a.sigma_m, b.sigma_m);
}

std::vector<SeenPlace> OfOneKind(const SeenPlace& like, const std::vector<SeenPlace>& sure) {
  std::vector<SeenPlace> kind;
  for (const SeenPlace& place : sure)
    if (HeightApartSigmas(like, place) < 3 && IsLikeArea(like.area_m2, place.area_m2)) kind.push_back(place);
  return kind;
}

CommonHeight HeightOf(const std::vector<SeenPlace>& kind) {
  double weights = 0, sum = 0;
  std::vector<double> areas;
  for (const SeenPlace& place : kind) {
    const double weight = 1 / (place.sigma_m * place.sigma_m);
    weights += weight;
    sum += weight * place.position.z();
    areas.push_back(place.area_m2);
  }
  return {sum / weights, 1 / std::sqrt(weights), Quantile(std::move(areas), 0.5)};
}

// Returns the heights that the most places share, one after another.
std::vector<CommonHeight> CommonHeights(const std::vector<SeenPlace>& places) {
  std::vector<SeenPlace> sure;
  std::copy_if(places.begin(), places.end(), std::back_inserter(sure), IsSure);
  std::vector<CommonHeight> heights;
  while (true) {
    std::vector<SeenPlace> largest;
    for (const SeenPlace& place : sure) {
      std::vector<SeenPlace> kind = OfOneKind(place, sure);
      if (kind.size() > largest.size()) largest = std::move(kind);
    }
    if (static_cast<int>(largest.size()) < kFewestPlaces) return heights;
    heights.push_back(HeightOf(largest));
    sure.erase(std::remove_if(sure.begin(), sure.end(),
                              [&](const SeenPlace& place) {
                                return std::any_of(largest.begin(), largest.end(), [&](const SeenPlace& of) {
                                  return of.position == place.position;
                                });
                              }),
               sure.end());
  }
}

// Where a blob's ray meets the height.
struct Crossing {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double sigma_m = 0;
  double area_m2 = 0;
  const PhotoBlobs* photo = nullptr;
};

// In sigmas of both.
double Apart(const Eigen::Vector3d& a, double sigma_a_m, const Eigen::Vector3d& b, double sigma_b_m) {
  return (a - b).norm() / std::hypot(sigma_a_m, sigma_b_m);
}

double Apart(const Crossing& a, const Crossing& b) {
  return Apart(a.position, a.sigma_m, b.position, b.sigma_m);
}

// Two blobs of one photo are two places, and so are two of one view in different places of the picture.
bool AreOne(const Crossing& a, const Crossing& b) {
  constexpr double kSameBlobSigmas = 0.5;
  if (a.photo == b.photo) return false;
  return Apart(a, b) < (a.photo->view == b.photo->view ? kSameBlobSigmas : 3);
}

// Returns the nearest of the clusters whose crossings are all one place with this one, if any.
std::vector<Crossing>* NearestOf(std::vector<std::vector<Crossing>>& clusters, const Crossing& crossing) {
  std::vector<Crossing>* nearest = nullptr;
  for (std::vector<Crossing>& cluster : clusters) {
    const bool is_one = std::all_of(cluster.begin(), cluster.end(),
                                    [&](const Crossing& other) { return AreOne(other, crossing); });
    if (is_one &&
        (nearest == nullptr || Apart(cluster.front(), crossing) < Apart(nearest->front(), crossing)))
      nearest = &cluster;
  }
  return nearest;
}

class PlacesAtHeight {
 public:
  PlacesAtHeight(const PlaceSights& sights, const CommonHeight& height, const std::vector<SeenPlace>& known)
      : sights_(sights), height_(height), known_(known) {}

  std::vector<SeenPlace> Run() const {
    std::vector<Crossing> crossings = Crossings();
    std::sort(crossings.begin(), crossings.end(),
              [](const Crossing& a, const Crossing& b) { return a.sigma_m < b.sigma_m; });
    std::vector<std::vector<Crossing>> clusters;
    for (const Crossing& crossing : crossings) {
      if (std::vector<Crossing>* const own = NearestOf(clusters, crossing)) {
        own->push_back(crossing);
      } else {
        clusters.push_back({crossing});
      }
    }
    std::vector<SeenPlace> places;
    for (const std::vector<Crossing>& cluster : clusters) {
      const SeenPlace place = PlaceOf(cluster);
      if (!place.states.empty() && place.photos > place.missing && !sights_.IsOnTag(place))
        places.push_back(place);
    }
    return places;
  }

 private:
  std::vector<Crossing> Crossings() const {
    std::vector<Crossing> crossings;
    for (const PhotoBlobs& photo : sights_.photos()) {
      if (IsDistrusted(photo.view)) continue;
      for (const BrightBlob& blob : photo.blobs) {
        if (blob.touches_edge || BelongsToSurePlace(photo, blob)) continue;
        Crossing crossing = CrossingOf(photo, blob);
        crossing.area_m2 = sights_.FacingDownM2(photo, blob, crossing.position);
        crossing.photo = &photo;
        if (crossing.sigma_m < kLargestSigmaM && sights_.IsInRoom(crossing.position) &&
            IsLikeArea(crossing.area_m2, height_.area_m2))
          crossings.push_back(crossing);
      }
    }
    return crossings;
  }

  // Its sigma is not finite where the ray does not meet the height.
  Crossing CrossingOf(const PhotoBlobs& photo, const BrightBlob& blob) const {
    const Sight sight = sights_.SightOf(photo, blob);
    const auto [beside, below] = sights_.SightsBeside(photo, blob);
    Crossing crossing;
    crossing.position = AtHeight(sight);
    crossing.sigma_m = Eigen::Vector3d((AtHeight(beside) - crossing.position).norm(),
                                       (AtHeight(below) - crossing.position).norm(),
                                       height_.sigma_m / std::abs(sight.direction.z()))
                           .norm();
    return crossing;
  }

  Eigen::Vector3d AtHeight(const Sight& sight) const {
    const double t = (height_.z_m - sight.origin.z()) / sight.direction.z();
    return t > 0 ? Eigen::Vector3d(sight.origin + t * sight.direction)
                 : Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  }

  // The pose of such a view is worse than it says, or something stands before it: its rays would place others wrongly.
  bool IsDistrusted(int view) const {
    return std::any_of(sights_.photos().begin(), sights_.photos().end(), [&](const PhotoBlobs& photo) {
      return photo.view == view && std::any_of(known_.begin(), known_.end(), [&](const SeenPlace& place) {
               return IsSure(place) &&
                      std::count(place.states.begin(), place.states.end(), photo.state) > 0 &&
                      sights_.Lacks(photo, place);
             });
    });
  }

  bool BelongsToSurePlace(const PhotoBlobs& photo, const BrightBlob& blob) const {
    return std::any_of(known_.begin(), known_.end(), [&](const SeenPlace& place) {
      return IsSure(place) && sights_.Shows(photo, blob, place);
    });
  }

  // Photos of one view share the error of its pose and of the blob's centre: each view counts once.
  SeenPlace PlaceOf(const std::vector<Crossing>& cluster) const {
    std::map<int, Crossing> of_view;
    for (const Crossing& crossing : cluster) of_view.emplace(crossing.photo->view, crossing);
    SeenPlace place;
    double weights = 0;
    std::vector<double> areas;
    for (const auto& [view, crossing] : of_view) {
      const double weight = 1 / (crossing.sigma_m * crossing.sigma_m);
      weights += weight;
      place.position += weight * crossing.position;
      areas.push_back(crossing.area_m2);
    }
    place.position /= weights;
    place.sigma_m = 1 / std::sqrt(weights);
    place.area_m2 = Quantile(std::move(areas), 0.5);
    place.views = static_cast<int>(of_view.size());
    place.is_at_common_height = true;
    const auto free = std::count_if(of_view.begin(), of_view.end(),
                                    [&](const auto& of) { return sights_.IsFreeFrom(of.first, place); });
    if (2 * free >= place.views) CollectStates(cluster, place);
    return place;
  }

  // Photos of other states may show another luminaire nearby, within the place's sigma.
  void CollectStates(const std::vector<Crossing>& cluster, SeenPlace& place) const {
    std::set<int> states;
    for (const Crossing& crossing : cluster) states.insert(crossing.photo->state);
    for (const int state : states) {
      SeenPlace here = place;
      here.photos = here.missing = 0;
      sights_.CountPhotos(state, here);
      if (here.photos <= here.missing) continue;
      place.states.push_back(state);
      place.photos += here.photos;
      place.missing += here.missing;
    }
  }

  const PlaceSights& sights_;
  const CommonHeight& height_;
  const std::vector<SeenPlace>& known_;
};

// Adds a place in the stead of the same triangulated one of no more views, or leaves that.
void Merge(const SeenPlace& place, std::vector<SeenPlace>& places) {
  const auto apart = [&](const SeenPlace& p) {
    return p.is_at_common_height ? std::numeric_limits<double>::infinity()
                                 : Apart(p.position, p.sigma_m, place.position, place.sigma_m);
  };
  const auto same =
      std::min_element(places.begin(), places.end(),
                       [&](const SeenPlace& a, const SeenPlace& b) { return apart(a) < apart(b); });
  if (same == places.end() || apart(*same) >= 3) {
    places.push_back(place);
  } else if (same->views <= place.views) {
    *same = place;
  }
}

// Returns whether each blob that shows the place shows a sure place, too.
bool IsChanceCrossing(const SeenPlace& place, const PlaceSights& sights,
                      const std::vector<SeenPlace>& places) {
  const auto is_other = [&](const PhotoBlobs& photo, const BrightBlob& blob) {
    return std::any_of(places.begin(), places.end(), [&](const SeenPlace& other) {
      return IsSure(other) && sights.Shows(photo, blob, other);
    });
  };
  for (const PhotoBlobs& photo : sights.photos()) {
    if (std::count(place.states.begin(), place.states.end(), photo.state) == 0) continue;
    for (const BrightBlob& blob : photo.blobs)
      if (sights.Shows(photo, blob, place) && !is_other(photo, blob)) return false;
  }
  return true;
}

}  // namespace

void AddPlacesAtCommonHeights(const PlaceSights& sights, std::vector<SeenPlace>& places) {
  const std::vector<CommonHeight> heights = CommonHeights(places);
  for (const CommonHeight& height : heights) {
    const std::vector<SeenPlace> found = PlacesAtHeight(sights, height, places).Run();
    for (const SeenPlace& place : found) Merge(place, places);
  }
  if (heights.empty()) return;
  const std::vector<SeenPlace> all = places;
  places.erase(std::remove_if(places.begin(), places.end(),
                              [&](const SeenPlace& place) {
                                return !IsSure(place) && !place.is_at_common_height &&
                                       IsChanceCrossing(place, sights, all);
                              }),
               places.end());
}

}  // namespace luxfit
