#include "apps/stages/observe/photo_names.h"

#include "apps/stages/linearize/linearize.h"

namespace luxfit {

PhotoNames PhotoNamesOf(const Session& session, const LinearizedPhotos& photos) {
  PhotoNames names;
  for (const SessionCamera& camera : session.cameras) names.cameras.push_back(camera.id);
  for (const SessionState& state : session.states) names.states.push_back(state.id);
  for (const LinearizedPhoto& photo : photos.photos)
    names.photos.push_back(PhotoName(session, photo.bracket.front()));
  return names;
}

}  // namespace luxfit
