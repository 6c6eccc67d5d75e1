// Photos of an object and of a mirror sphere as photometric stereo takes them.
//
// Throws std::runtime_error for masks and photos that differ in size, and for a mirror sphere whose mask is
// no circle or that shows no highlight.
#ifndef LUXFIT_APPS_STAGES_INTERNAL_STEREO_PHOTOS_H_
#define LUXFIT_APPS_STAGES_INTERNAL_STEREO_PHOTOS_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "apps/session/session.h"
#include "inverse/albedo/photometric_stereo.h"

namespace luxfit {

struct StereoPhotos {
  StereoData data;                      // pixels of the object and of the reference
  std::vector<std::string> states;      // one an image
  std::vector<Eigen::Vector2i> places;  // (u, v) of every pixel
  std::vector<bool> is_object;          // of every pixel
  std::vector<bool> is_reference;
  int width_px = 0, height_px = 0;
};

// `session` is linearized and has lights.
StereoPhotos ReadStereoPhotos(const Session& session);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_INTERNAL_STEREO_PHOTOS_H_
