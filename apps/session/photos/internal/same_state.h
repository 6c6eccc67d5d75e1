// Groups the photos of one view by what was on: where the light has one pattern and one strength, nothing was switched.
//
//   d(p) = ln light_a(p) - ln light_b(p) = level + slope l(p) + rest,   l = (ln light_a + ln light_b) / 2
//   spread = sigma of the rest, from its median absolute deviation
//   strength = level - ln (exposure_a / exposure_b)
//
// The slope takes up a tone curve that is not the one that is divided out. One state has a small spread and a strength
// near 0. Photos whose exposure is not known are compared without the strength.
#ifndef LUXFIT_APPS_SESSION_PHOTOS_INTERNAL_SAME_STATE_H_
#define LUXFIT_APPS_SESSION_PHOTOS_INTERNAL_SAME_STATE_H_

#include <optional>
#include <vector>

#include "apps/session/photos/photo_look.h"

namespace luxfit {

struct LightComparison {
  double spread = 0;
  double slope = 0;
  std::optional<double> strength;  // empty where an exposure is not known
};

// Compares two photos of one pose. Empty where fewer than 100 pixels are usable in both.
std::optional<LightComparison> CompareLight(const PhotoLook& a, const PhotoLook& b);

// Returns for each of these photos of one view the number of its state, from 0 in the order of the photos, and whether
// that is doubtful.
struct StateOfPhoto {
  int state = 0;
  bool is_doubtful = false;
};
std::vector<StateOfPhoto> GroupByLight(const std::vector<const PhotoLook*>& photos);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_PHOTOS_INTERNAL_SAME_STATE_H_
