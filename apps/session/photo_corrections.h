// What an earlier run found the photos and cameras to be off (inverse/choose/self_calibration.h), for those who read
// the photos again: exposure by photo, vignetting and response by camera.
//
//   ln Y -> ln Y + q ln(Y t) - g - a_1 r^2 - a_2 r^4 - ...
//
// From OUT/stages/observe.json; nothing is corrected where the run chose "as recorded". Exposures of photos
// that were not in that run are taken as stated.
#ifndef LUXFIT_APPS_SESSION_PHOTO_CORRECTIONS_H_
#define LUXFIT_APPS_SESSION_PHOTO_CORRECTIONS_H_

#include <map>
#include <string>
#include <vector>

#include "apps/session/session.h"
#include "calib/luminance/luminance.h"

namespace luxfit {

struct PhotoCorrections {
  struct OfCamera {
    std::vector<double> vignetting;  // a_1, a_2, ...
    double exponent = 0;             // q
  };
  std::map<std::string, double> log_gain;     // g, by file
  std::map<std::string, OfCamera> of_camera;  // by id
};
PhotoCorrections ReadPhotoCorrections(const std::string& out);

LuminanceImage Corrected(LuminanceImage image, const PhotoCorrections& corrections, const Session& session,
                         const SessionPhoto& photo);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_PHOTO_CORRECTIONS_H_
