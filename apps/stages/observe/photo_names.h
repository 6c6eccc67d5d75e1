// Names what messages and artifacts speak of: the photos of a room, their cameras and states.
#ifndef LUXFIT_APPS_STAGES_OBSERVE_PHOTO_NAMES_H_
#define LUXFIT_APPS_STAGES_OBSERVE_PHOTO_NAMES_H_

#include <string>
#include <vector>

#include "apps/stages/stages.h"

namespace luxfit {

struct PhotoNames {
  std::vector<std::string> cameras, states;
  std::vector<std::string>
      photos;  // for messages: "photos.csv:12 (IMG_0012.png)"; one for each of RoomPhotos::photos
};

PhotoNames PhotoNamesOf(const Session& session, const LinearizedPhotos& photos);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_OBSERVE_PHOTO_NAMES_H_
