// Stands for apps/session/photo_colours.cc: the session's reader is fuzzed, not those of photos.
#include "apps/session/photo_colours.h"

namespace luxfit {

Session WithColoursOfPhotos(Session session) { return session; }

}  // namespace luxfit
