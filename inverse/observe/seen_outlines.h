// Turns contours of bright blobs into rays: outlines of luminaires as photos show them.
//
// Each outline keeps the eye of its view and, for each point of the contour, the direction of its ray and the
// photo's scale there. Directions are unit vectors in the world frame; scales are in pixels per radian.
//
// Highlights, windows and washed surfaces have outlines too. MatchOutlines keeps those that belong to a
// luminaire whose place is known to about 5 cm: its direction lies inside the outline, or near it. An
// outline that two luminaires share (their blobs run into one) is left out. Of the photos of one view, that
// with the fewest luminaires on counts: the same outline again is no new evidence.
//
// Throws std::invalid_argument for a view out of range.
#ifndef LUXFIT_INVERSE_OBSERVE_SEEN_OUTLINES_H_
#define LUXFIT_INVERSE_OBSERVE_SEEN_OUTLINES_H_

#include <Eigen/Core>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/register/registration.h"
#include "forward/luminaire/luminaire.h"
#include "inverse/observe/seen_luminaires.h"

namespace luxfit {

struct OutlineRay {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  double px_per_rad = 1;
};

struct SeenOutline {
  int view = 0, camera = 0, state = 0;
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();
  std::vector<OutlineRay> rays;
};

struct LuminaireOutline {
  int luminaire = 0;
  SeenOutline seen;
};

// Returns the outlines of all blobs, photo by photo. Those of fewer than 6 points are left out.
std::vector<SeenOutline> FindSeenOutlines(const std::vector<Camera>& cameras,
                                          const std::vector<RegisteredView>& views,
                                          const std::vector<PhotoBlobs>& photos);

// `dimming`: one vector for each state, by luminaire.
std::vector<LuminaireOutline> MatchOutlines(const std::vector<SeenOutline>& outlines,
                                            const std::vector<Luminaire>& luminaires,
                                            const std::vector<Eigen::VectorXd>& dimming);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_SEEN_OUTLINES_H_
