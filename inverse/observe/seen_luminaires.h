// Finds places where luminaires may hang by triangulating bright blobs of several views.
//
//   A = median_v(blob area / |d pixel / d place|) / |cos| of the direction to v against the vertical
//
// A: emitting area of a luminaire that faces down (or up); NaN where every view saw it edge-on. Units: m, m2;
// world frame.
//
// The blobs of all views are triangulated state by state (calib/register/triangulation.h). A place is dropped
// where it lies outside the room, or where more of the photos that should show it miss it than show it. A
// highlight moves with the camera, and a washed-out surface is not washed out in a shorter exposure. So is a place on
// the paper of a surveyed tag.
//
// A luminaire that is bright in one state is so in each in which it is dimmed no lower, whatever else is on: a lit wall is
// not. So a place also has the states in which photos show it dark.
//
// Where three places and more have one height, one view is enough to find others there
// (inverse/observe/internal/places_at_height.h).
//
// The remaining places may hold a luminaire. White things on a desk, mirror images and windows stay among them
// where several views saw them alike. The light decides which are right (inverse/model/internal/search/first_guess.h).
// Blobs at a photo's edge are cut: their centres are not used, but they count as seen.
//
// Throws std::invalid_argument for a view out of range. Sources: those of bright_blobs.h and triangulation.h.
#ifndef LUXFIT_INVERSE_OBSERVE_SEEN_LUMINAIRES_H_
#define LUXFIT_INVERSE_OBSERVE_SEEN_LUMINAIRES_H_

#include <Eigen/Core>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/luminance/bright_blobs.h"
#include "calib/register/registration.h"
#include "calib/targets/tags.h"
#include "forward/light/room.h"
#include "forward/luminaire/luminaire.h"

namespace luxfit {

// Holds the blobs of one photo. A photo without blobs is listed, too.
struct PhotoBlobs {
  int view = 0;  // index of the registered view
  int state = 0;
  std::vector<BrightBlob> blobs;
};

struct SeenPlace {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double sigma_m = 0;            // standard deviation along the worst direction
  std::vector<int> states;       // states in which it is bright
  std::vector<int> dark_states;  // states in which most photos that should show it do not
  std::vector<int>
      covered_states;  // other states in which most photos that should show it have something bright on it
  int photos = 0;      // photos of those states that show it
  int views = 0;       // views from which it was triangulated, in one state
  int missing = 0;     // photos of those states that should show it and do not
  double area_m2 = 0;
  // The horizontal rectangle with the second moments of what photos show: its sides, the longer one first, and the direction of that,
  // a unit vector. 0: no photo shows it whole, or all look along a side.
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();
  Eigen::Vector3d heading = Eigen::Vector3d::UnitX();
  bool is_at_common_height = false;  // placed on the height that others of its area share: `views` may be one
};

// Returns whether enough views saw the place that chance is excluded: three, or two at a known height.
inline bool IsSure(const SeenPlace& place) { return place.views >= (place.is_at_common_height ? 2 : 3); }

// Returns whether the place may be that of the luminaire: bright in states where it is on and in no other, not dark in
// one in which it is dimmed no lower, and not covered in one in which it is off: the end of a long luminaire that another one
// lights is part of the former. `dimming`: one vector for each state, by luminaire.
bool MayBePlaceOf(const SeenPlace& place, const std::vector<Eigen::VectorXd>& dimming, int luminaire);

struct SeenLuminairesOptions {
  int min_views = 2;  // three would exclude chance; here the light decides
  double center_sigma_px = 1;
  // As a share of the width of a square as large as the blob, or as long: a blob's centre is not the image of the
  // luminaire's centre, the less the longer it is.
  double width_sigma = 0.05;
  std::vector<SurveyedTag> tags;  // their paper is no luminaire
};

// Returns the places, those of most views first.
std::vector<SeenPlace> FindSeenLuminaires(const Room& room, const std::vector<Camera>& cameras,
                                          const std::vector<RegisteredView>& views,
                                          const std::vector<PhotoBlobs>& photos,
                                          const SeenLuminairesOptions& options = {});

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

#endif  // LUXFIT_INVERSE_OBSERVE_SEEN_LUMINAIRES_H_
