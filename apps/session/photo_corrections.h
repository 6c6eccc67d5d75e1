// Reads by how much an earlier run found the photos and cameras to be off, for callers that read the photos
// again: exposure by photo, gain, vignetting and response by camera (inverse/observe/camera/self_calibration.h).
//
// The corrections (calib/luminance/luminance.h) come from OUT/stages/observe.json. Where the run chose "as
// recorded", only the gains of its cameras are corrected. Exposures of photos that were not in that run are
// taken as stated.
#ifndef LUXFIT_APPS_SESSION_PHOTO_CORRECTIONS_H_
#define LUXFIT_APPS_SESSION_PHOTO_CORRECTIONS_H_

#include <map>
#include <string>

#include "calib/luminance/luminance.h"

namespace luxfit {

// Holds the correction of each camera, by id, and of each photo that the run read beyond it, by file. Other
// photos take that of their camera, with their exposure as stated.
struct PhotoCorrections {
  std::map<std::string, double> log_gain;
  std::map<std::string, PhotoCorrection> of_camera;

  PhotoCorrection Of(const std::string& camera, const std::string& file) const;
};
PhotoCorrections ReadPhotoCorrections(const std::string& out);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_PHOTO_CORRECTIONS_H_
