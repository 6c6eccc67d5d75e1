#include "apps/stages/observe/observed_words.h"

#include "apps/stages/observe/explained_photos.h"
#include "apps/stages/observe/observed_light.h"
#include "apps/text/suggest.h"

namespace luxfit {
namespace {

void RecordAmbient(const ObservedPhotos& observed, Findings& findings) {
  if (!observed.has_ambient) return;
  findings.choices.push_back(
      {"ambient light", "subtracted", {}, "photos of a state with all luminaires off are given"});
  if (observed.views_without_ambient.empty()) return;
  findings.warnings.push_back(
      {"ambient_missing",
       "views " + ListNames(observed.views_without_ambient) +
           " have no photo with all luminaires off: they show ambient light that cannot be "
           "subtracted, and were not used",
       "photograph these views with all luminaires off too"});
}

}  // namespace

void RecordObserved(const ObservedPhotos& observed, const RoomPhotos& photos,
                    const std::vector<RegisteredView>& views, const PhotoNames& names, Findings& findings) {
  RecordAmbient(observed, findings);
  WarnOfPhotos(observed.evidence.photos_as_if, photos, views, names, findings);
  WarnOfStates(observed.evidence.states_as_if, findings);
  if (observed.radiometry) RecordRadiometry(*observed.radiometry, photos, names, findings);
}

}  // namespace luxfit
