// Tells from which views photos would show a luminaire at a place.
//
// A view's picture is bounded by rays: a place is in it where its direction lies inside all great circles through two neighbours: where a lens
// curves the border, a little of the picture is left out. Where several views have
// a place in their pictures, in free sight, and a luminaire there would shine towards them, photos show it: what they
// do not show shines elsewhere, is hidden, or is not there.
// World frame.
#ifndef LUXFIT_INVERSE_OBSERVE_WATCHERS_H_
#define LUXFIT_INVERSE_OBSERVE_WATCHERS_H_

#include <Eigen/Core>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/register/registration.h"
#include "inverse/observe/seen_luminaires.h"

namespace luxfit {

struct Watcher {
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d>
      border;               // unit directions along the picture's border, in order; empty: it shows all round
  std::vector<int> states;  // of its photos
};

// Returns one for each registered view. One of a lens without rays along its border shows nothing.
std::vector<Watcher> WatchersOf(const std::vector<Camera>& cameras, const std::vector<RegisteredView>& views,
                                const std::vector<PhotoBlobs>& photos);

// Returns whether a direction from the eye lies in the picture.
bool IsInPicture(const Watcher& view, const Eigen::Vector3d& direction);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_WATCHERS_H_
