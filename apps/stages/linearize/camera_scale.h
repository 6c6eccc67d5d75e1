// Tells in which camera's unit luminances are, and what is stated of the others against it.
//
//   L = k Y,   k = cdm2_per_count_s (full_scale - black),   gain = k_unit / k,   Y_unit = Y / gain
//
// L: cd/m2, Y: relative luminance of a camera (calib/luminance/luminance.h). The unit is that of the first
// camera that has photos and a stated factor, else that of the first camera.
#ifndef LUXFIT_APPS_STAGES_LINEARIZE_CAMERA_SCALE_H_
#define LUXFIT_APPS_STAGES_LINEARIZE_CAMERA_SCALE_H_

#include <optional>
#include <vector>

#include "apps/stages/linearize/linearized_session.h"
#include "calib/register/registration.h"
#include "inverse/observe/observe.h"

namespace luxfit {

// Returns k; empty where it is not stated.
std::optional<double> LuminancePerUnit(const LinearizedCamera& camera);

// Returns an index into photos.cameras. Expects a camera.
int UnitCamera(const LinearizedPhotos& photos);

// Returns the gain of each camera; 1 where it or the unit's has no stated factor.
std::vector<double> StatedGains(const LinearizedPhotos& photos);

// Returns the observations of each camera divided by its stated gain.
std::vector<Observation> InOneUnit(std::vector<Observation> observations, const LinearizedPhotos& photos,
                                   const std::vector<RegisteredView>& views);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_LINEARIZE_CAMERA_SCALE_H_
