// Guesses from what photos show which of them are of one view, and what was on in each, where names tell neither.
//
//   pose      tags, or edges, at the same pixels: one view                          internal/photo_groups/same_view.h
//   pattern   one pattern and strength of light, after exposure: one state          internal/photo_groups/same_state.h
//   exposure  one view and state, several exposures: a bracket
//   states    matched across views by the light on tags and by the order of capture internal/photo_groups/match_states.h
//   names     one luminaire, a mix, all, off                                        internal/photo_groups/name_states.h
//
// Sub-folders that agree with nine in ten of these guesses name the views, or the states.
#ifndef LUXFIT_APPS_SESSION_PHOTOS_PHOTO_GROUPS_H_
#define LUXFIT_APPS_SESSION_PHOTOS_PHOTO_GROUPS_H_

#include <string>
#include <vector>

#include "apps/session/photos/photo_look.h"
#include "apps/session/photos/photo_names.h"

namespace luxfit {

struct GroupedPhotos {
  PhotoNames names;  // in the order of `photos`; each with a note of its reason
  std::vector<GuessedState> states;
  std::vector<int> camera;  // of each photo, numbered in their order
};

// Guesses what is on in the states that names tell: from the name of a luminaire, or all; by the light of the photos where
// the name is that of an occasion (evening). `photos` are those of the names, in their order.
std::vector<GuessedState> StatesByNamesAndLight(const PhotoNames& names,
                                                const std::vector<PhotoLook>& photos);

// Throws std::invalid_argument for no photos.
GroupedPhotos GroupPhotos(const std::vector<PhotoLook>& photos);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_PHOTOS_PHOTO_GROUPS_H_
