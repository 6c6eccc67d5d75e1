// Refuses lobes that photos would show and do not.
//
//   a lobe at p is refused where I(d_v) > 0.3 max I for three views v and more that have p in their pictures, in free sight
//
// d_v: direction from p to the eye of v. Places that photos show are tried apart (sparse_luminaires.h); a luminaire at any other place shines
// elsewhere, is hidden, or is not there. World frame.
// Source: own.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_WATCHED_PLACES_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_WATCHED_PLACES_H_

#include <Eigen/Core>
#include <vector>

#include "forward/light/room.h"
#include "inverse/model/internal/search/lobes.h"
#include "inverse/observe/seen_luminaires.h"
#include "inverse/observe/watchers.h"

namespace luxfit {

// A view that has a place in its picture, in free sight.
struct WatchingView {
  int view = 0;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  // unit, from the place to the eye
};

// Returns the views where photos show a luminaire beyond doubt (IsSure); none where they show none: they may not show any.
std::vector<Watcher> WatchingViews(const std::vector<SeenPlace>& seen, const std::vector<Watcher>& views);

std::vector<WatchingView> ViewsOf(const Room& room, const std::vector<Watcher>& views,
                                  const Eigen::Vector3d& place);

// `counts`: by view, whether it has a photo in which the luminaire is on.
bool IsRefuted(const Lobe& lobe, const std::vector<WatchingView>& of_place, const std::vector<bool>& counts);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_WATCHED_PLACES_H_
