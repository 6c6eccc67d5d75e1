// Turns photos of registered views into the evidence that a fit starts from.
//
//   photos, poses -> luminance of every element, without ambient light, in one camera's unit
//                 -> without the veil of a lens (inverse/observe/camera/veiling_glare.h)
//                 -> photos of another state, or encoded, left out -> states explained -> exposures, vignetting, response corrected
//                 -> places and outlines where luminaires show
//
// Y_s = Y_s(photo) - Y_dark(photo of the same view): where a state has all luminaires off, it is ambient light, and
// views without a photo of it are not used. Where the table of states is explained otherwise, self-calibration takes
// the first explanation's: it must not blame photos for the table's mistake. The table itself stays.
//
// Units: relative luminance of the unit camera (room_photos.h); m, world frame. Throws std::invalid_argument for a
// camera or state out of range. Source: the headers of the steps.
#ifndef LUXFIT_INVERSE_OBSERVE_EVIDENCE_H_
#define LUXFIT_INVERSE_OBSERVE_EVIDENCE_H_

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/register/registration.h"
#include "calib/targets/tags.h"
#include "forward/light/room.h"
#include "inverse/observe/ambient_light.h"
#include "inverse/observe/as_if/photos_as_if.h"
#include "inverse/observe/as_if/states_as_if.h"
#include "inverse/observe/camera/photo_radiometry.h"
#include "inverse/observe/camera/tone_mapping.h"
#include "inverse/observe/camera/veiling_glare.h"
#include "inverse/observe/observe.h"
#include "inverse/observe/room_photos.h"
#include "inverse/observe/seen_luminaires.h"
#include "inverse/observe/watchers.h"

namespace luxfit {

// Holds what photos of registered views show.
struct Evidence {
  std::vector<Observation> observations;  // Observation::view indexes the registered views
  std::vector<SeenPlace> seen;
  std::vector<SeenOutline> outlines;
  std::vector<Watcher> views;                  // the registered ones, with the states of their photos
  Eigen::MatrixXd pose_covariance;             // PoseErrorsOf
  double ambient_spread = 0;                   // AmbientLight::spread
  std::vector<PhotoAsIf> photos_as_if;         // left out of the above
  std::vector<StateExplanation> states_as_if;  // what the table of states gets wrong
};

// Returns the views' joint pose covariance where the survey is less accurate than given; else nothing, for
// the fit's sigma of outlines covers what an accurate survey leaves.
Eigen::MatrixXd PoseErrorsOf(const Registration& registration);

// Returns the dimming of the states as the photos say that it was: the first explanation's, else the table's. Of
// luminaires that nobody names, one stands for all.
std::vector<Eigen::VectorXd> DimmingSeen(const StateTable& states,
                                         const std::vector<StateExplanation>& explained);

struct ObservedPhotos {
  Evidence evidence;
  std::vector<size_t> elements;  // number of elements observed in each photo
  bool has_ambient = false;      // whether some photo shows ambient light alone
  AmbientLight ambient;          // how that light changed from photo to photo
  std::vector<std::string> views_without_ambient;
  std::optional<PhotoRadiometry> radiometry;             // absent where nothing was observed
  std::vector<std::optional<ToneMapping>> tone_mapping;  // by camera; absent where it is not judged
  // By camera; absent where it is not judged, as with tones mapped. Where it is found, observations are without it.
  std::vector<std::optional<VeilingGlare>> veiling_glare;
};

struct ObserveOptions {
  std::vector<SurveyedTag> tags;   // world frame; their paper hides surfaces, and is no luminaire
  std::function<void()> on_photo;  // called for each photo, by any thread; empty: no calls
  // Called as self-calibration begins; the token that it returns is released as it ends. Empty: no calls.
  std::function<std::shared_ptr<void>()> on_self_calibration;
};

// `cameras`: those of the registration, one for each of photos.cameras. Photos of views that are not registered are
// not read.
ObservedPhotos Observe(const Room& room, const RoomPhotos& photos, const std::vector<Camera>& cameras,
                       const Registration& registration, const StateTable& states,
                       const ObserveOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_EVIDENCE_H_
