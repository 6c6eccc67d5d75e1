// Holds the photos of a room: what is stated of each and of its camera, and how to read it.
//
//   L = k Y,   gain = k_unit / k,   Y_unit = Y / gain
//
// L: cd/m2, Y: relative luminance of a camera (calib/luminance/luminance.h), k: cdm2_per_unit. The unit is that of
// the first camera that has photos and a stated k, else that of the first camera.
#ifndef LUXFIT_INVERSE_OBSERVE_ROOM_PHOTOS_H_
#define LUXFIT_INVERSE_OBSERVE_ROOM_PHOTOS_H_

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calib/luminance/luminance.h"
#include "calib/register/registration.h"
#include "inverse/observe/observe.h"

namespace luxfit {

// Tells what is stated of a camera's vignetting.
enum class StatedVignetting { kNone, kEstimate, kFlatField };

struct StatedCamera {
  StatedVignetting vignetting = StatedVignetting::kNone;
  bool vignetting_is_open = true;  // false: a flat field has taken it out
  bool response_is_open = true;    // false: a curve has made counts proportional to light
  std::optional<double> cdm2_per_unit;
};

// One photo of a view in a state; its bracket is merged.
struct RoomPhoto {
  std::string view;       // photos of one view share one pose
  int camera = 0;         // index of the camera
  int state = 0;          // state of the luminaires
  double exposure_s = 1;  // relative to the camera's other photos; the longest of a bracket
};

using LuminanceReader = std::function<std::shared_ptr<const LuminanceImage>(size_t photo)>;

struct RoomPhotos {
  std::vector<StatedCamera> cameras;
  std::vector<RoomPhoto> photos;
  LuminanceReader read;  // of the photo of that index; any thread may call it, more than once for one photo
};

// Returns a reader of photos that are in memory.
LuminanceReader InMemory(std::vector<LuminanceImage> images);

// Returns the index of the camera in whose unit luminances are. Expects a camera.
int UnitCamera(const RoomPhotos& photos);

// Returns relative luminance per cd/m2 in that unit; empty where it is not stated.
std::optional<double> StatedScale(const RoomPhotos& photos);

// Returns the gain of each camera; 1 where it or the unit's has no stated k. Expects a camera.
std::vector<double> StatedGains(const RoomPhotos& photos);

// Returns the index of the photo's view among the registered ones; nothing where it is not there.
std::optional<size_t> ViewOf(const RoomPhoto& photo, const std::vector<RegisteredView>& views);

// Returns the observations of each camera divided by its stated gain.
std::vector<Observation> InOneUnit(std::vector<Observation> observations, const RoomPhotos& photos,
                                   const std::vector<RegisteredView>& views);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_ROOM_PHOTOS_H_
