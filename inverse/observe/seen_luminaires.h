// Where luminaires hang, as the photos themselves show it: bright blobs of several views, triangulated.
//
// State by state the blobs of all views are triangulated (calib/register/triangulation.h). What lies outside the room,
// or is missing in more of the photos that ought to show it than it is in, is dropped: a highlight moves with
// the camera, a washed-out surface is not washed out in a shorter exposure. What is left are places where a
// luminaire may be, not luminaires: tags on a desk, mirror images and windows stay among them where several
// views saw them alike. Which are right, the light decides (inverse/model/first_guess.h).
//
//   A = median_v(blob area / |d pixel / d place|) / |cos| of the direction to v against the vertical
//
// is the emitting area of a luminaire that faces down (or up); NaN where every view saw it edge-on. m, world
// frame. Blobs at a photo's edge are cut: their centres are not used, but they count as seen. Throws
// std::invalid_argument for a view out of range. Sources: those of bright_blobs.h and triangulation.h.
#ifndef LUXFIT_INVERSE_OBSERVE_SEEN_LUMINAIRES_H_
#define LUXFIT_INVERSE_OBSERVE_SEEN_LUMINAIRES_H_

#include <Eigen/Core>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/luminance/bright_blobs.h"
#include "calib/register/registration.h"
#include "forward/light/room.h"

namespace luxfit {

// The blobs of one photo; a photo without any is one too.
struct PhotoBlobs {
  int view = 0;  // of the registered ones
  int state = 0;
  std::vector<BrightBlob> blobs;
};

struct SeenPlace {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double sigma_m = 0;       // along its worst direction
  std::vector<int> states;  // in which it is bright
  int photos = 0;           // that show it, of those states
  int views = 0;            // that it was triangulated from, in one state
  int missing = 0;          // photos of those states that ought to show it and do not
  double area_m2 = 0;
};

struct SeenLuminairesOptions {
  int min_views = 2;  // three where chance is to be excluded; here the light decides
  double center_sigma_px = 1;
  // Of a blob's width: the centre of a photo's blob is not the photo of the luminaire's centre.
  double width_sigma = 0.05;
};

// Most views first.
std::vector<SeenPlace> FindSeenLuminaires(const Room& room, const std::vector<Camera>& cameras,
                                          const std::vector<RegisteredView>& views,
                                          const std::vector<PhotoBlobs>& photos,
                                          const SeenLuminairesOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_SEEN_LUMINAIRES_H_
