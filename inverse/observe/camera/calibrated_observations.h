// Applies self-calibration to the observations of registered views, and judges what it found.
//
//   observations -> photos -> samples -> SelfCalibrate -> corrected observations, findings
//
//   Y' = f Y,   var(Y') = f^2 var(Y) + var(h_c + g_p) Y'^2,   ln f as in PhotoCorrection
//                                                             (calib/luminance/luminance.h)
//
// Y: relative luminance of an element in a photo. h_c, g_p: logarithms of the gains of its camera and of the
// photo itself. Their sigmas enter the fit through this variance, as if errors were independent from element
// to element. The part that all elements of a camera share is in no sigma of a luminaire: it is the sigma of
// h_c, some tenths of a percent where cameras share a hundred elements. A photo is a view in a state of the
// luminaires. An element is seen at the pixel of its centre.
// Source: inverse/observe/camera/self_calibration.h.
#ifndef LUXFIT_INVERSE_OBSERVE_CAMERA_CALIBRATED_OBSERVATIONS_H_
#define LUXFIT_INVERSE_OBSERVE_CAMERA_CALIBRATED_OBSERVATIONS_H_

#include <vector>

#include "calib/lens/camera.h"
#include "calib/register/registration.h"
#include "inverse/observe/camera/self_calibration.h"
#include "inverse/observe/observe.h"
#include "inverse/observe/room_photos.h"

namespace luxfit {

struct StatedPhoto {
  int view = 0, state = 0;
  double exposure_s = 0;  // relative; the longest of a bracket
};

// Returns the photos of the observations in the order in which they first appear. The caller states their
// exposures.
std::vector<StatedPhoto> PhotosIn(const std::vector<Observation>& observations);

// Returns one sample for each observation, numbered as `photos`. Throws std::invalid_argument for an
// observation of none of these photos, and for an exposure that is not > 0.
std::vector<PhotoSample> SamplesOf(const std::vector<Observation>& observations,
                                   const std::vector<StatedPhoto>& photos, const Patches& patches,
                                   const std::vector<Camera>& cameras,
                                   const std::vector<RegisteredView>& views);

// Returns the observations with the errors found taken out. `samples`: one for each observation.
std::vector<Observation> WithCorrections(std::vector<Observation> observations,
                                         const std::vector<PhotoSample>& samples,
                                         const SelfCalibration& found);

struct CameraFindings {
  bool darkens = false;                     // it is stated to have no vignetting, and has some
  bool is_curved = false;                   // its counts are not proportional to light
  bool vignetting_is_undetermined = false;  // asked for, and neither found nor excluded
};

struct RadiometryFindings {
  std::vector<CameraFindings> cameras;
  std::vector<int> wrong_photos;  // their exposure is off by more than 8 %, beyond their camera's gain
  // States whose photos' exposures nothing ties to those of the others, and the largest sigma of their common
  // factor. It is in no sigma of a luminaire.
  std::vector<int> loose_states;
  double loose_sigma = 0;
};

// `open`: what SelfCalibrate was given. `stated`: one for each camera.
RadiometryFindings FindingsOf(const SelfCalibration& found, const OpenRadiometry& open,
                              const std::vector<StatedVignetting>& stated);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_CAMERA_CALIBRATED_OBSERVATIONS_H_
