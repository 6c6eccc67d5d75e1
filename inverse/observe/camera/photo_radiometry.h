// Corrects the photos themselves by observations of the same elements from several views.
//
//   observations, what is stated -> SelfCalibrate -> findings, gains that apply, corrected observations
//
// An element is diffuse: in one state its luminance is the same in every photo. Photos that disagree have another
// exposure than stated, the lens darkens towards the corners, or counts are not proportional to light. A correction
// applies where calib did not fix it (no flat field, no response curve) and where the criterion selects it. Gains of
// cameras are decided before single photos are judged.
// Source: inverse/observe/camera/self_calibration.h, inverse/observe/camera/calibrated_observations.h.
#ifndef LUXFIT_INVERSE_OBSERVE_CAMERA_PHOTO_RADIOMETRY_H_
#define LUXFIT_INVERSE_OBSERVE_CAMERA_PHOTO_RADIOMETRY_H_

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/register/registration.h"
#include "forward/room/patches.h"
#include "inverse/observe/camera/calibrated_observations.h"
#include "inverse/observe/camera/self_calibration.h"
#include "inverse/observe/observe.h"
#include "inverse/observe/room_photos.h"

namespace luxfit {

// Holds a camera's gain against the camera that it is relative to, as it was divided out.
struct AppliedGain {
  size_t camera = 0, reference = 0;
  double gain = 1, relative_sigma = 0;
  bool is_stated = false;
};

struct PhotoRadiometry {
  SelfCalibration found;
  RadiometryFindings findings;
  std::vector<size_t> photos;      // index into RoomPhotos::photos of each photo that `found` numbers
  std::vector<AppliedGain> gains;  // of the cameras that have one
  int unit_camera = 0;
};

struct CorrectedObservations {
  std::vector<Observation> observations;
  std::optional<PhotoRadiometry> radiometry;  // absent where there are no observations
};

// Divides observations by the errors found in the photos' exposures, vignetting and response and by the gains of
// cameras, and adds the variance of their gains. `observations`: of `views` and in one unit (InOneUnit). `dimming`:
// one vector for each state, by luminaire. Throws std::invalid_argument for an observation of none of the photos,
// and as SelfCalibrate does.
CorrectedObservations CorrectRadiometry(const Patches& patches, const RoomPhotos& photos,
                                        const std::vector<Camera>& cameras,
                                        const std::vector<RegisteredView>& views,
                                        const std::vector<Eigen::VectorXd>& dimming,
                                        std::vector<Observation> observations);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_CAMERA_PHOTO_RADIOMETRY_H_
