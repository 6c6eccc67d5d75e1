// Measures how brightly the tags of a view are lit in its photos. A tag is the same flat, matt print in every photo: what
// is on lights it alike, from wherever it is seen. So it tells states across views.
//
//   ln light of a tag = ln (mean light over its square) - ln exposure
#ifndef LUXFIT_APPS_SESSION_PHOTOS_INTERNAL_TAG_LIGHT_H_
#define LUXFIT_APPS_SESSION_PHOTOS_INTERNAL_TAG_LIGHT_H_

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/session/photos/photo_look.h"

namespace luxfit {

// Photos of one view and state.
struct LightGroup {
  int view = 0;
  std::vector<size_t> photos;       // in the order in which they were taken
  std::map<int, double> log_light;  // by tag
  double level = 0;                 // the median of the whole pictures, as log_light
  bool is_absolute = true;          // all exposures are known
  std::string camera;
};

// Sets log_light, level, is_absolute and camera of the groups of one view. A tag that some of the photos are too dark to
// show is measured in them, too, at the place where the others show it.
void MeasureTagLight(const std::vector<PhotoLook>& photos, const std::vector<LightGroup*>& groups);

// Returns the mean |difference| of ln light over the common tags; empty where fewer than two are common. Where exposures
// are not known, or of two cameras, a common factor is left out, and three tags are needed.
std::optional<double> TagLightDifference(const LightGroup& a, const LightGroup& b);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_PHOTOS_INTERNAL_TAG_LIGHT_H_
