// Prepares photos of an object and of a mirror sphere for photometric stereo.
//
// Throws std::runtime_error for masks and photos that differ in size, and for a mirror sphere whose mask is
// not a circle or that shows no highlight.
#ifndef LUXFIT_APPS_STAGES_INTERNAL_STEREO_PHOTOS_H_
#define LUXFIT_APPS_STAGES_INTERNAL_STEREO_PHOTOS_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "apps/stages/linearize/linearized_session.h"
#include "inverse/albedo/photometric_stereo.h"

namespace luxfit {

struct StereoPhotos {
  StereoData data;                      // values at pixels of the object and of the reference
  std::vector<std::string> states;      // one for each image
  std::vector<Eigen::Vector2i> places;  // (u, v) of every pixel
  StereoRegions regions;
  int width_px = 0, height_px = 0;
};

// `session` must have lights.
StereoPhotos ReadStereoPhotos(const Session& session, const LinearizedPhotos& linearized);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_INTERNAL_STEREO_PHOTOS_H_
