// What the names of photos tell: which show one view, and what was on in each.
//
//   day1/IMG_1.png, day2/IMG_1.png    the same names in several folders: folder = state, name = view
//   v00_A.png, v00_all.png            two names and more that share what is before the last _ or -:
//   view_state;
//                                     state_view where the first part is a word for a state (all, off, ...)
//   anything else, numbers for states every photo is a view of its own, all in one state
//
// Guesses, for `luxfit init` to write down and a person to check.
#ifndef LUXFIT_APPS_SESSION_PHOTO_NAMES_H_
#define LUXFIT_APPS_SESSION_PHOTO_NAMES_H_

#include <string>
#include <vector>

namespace luxfit {

struct NamedPhoto {
  std::string file;  // as given
  std::string view, state;
};

struct PhotoNames {
  std::vector<NamedPhoto> photos;
  std::string because;
};

// Paths relative to the folder of the photos.
PhotoNames GuessViewsAndStates(const std::vector<std::string>& files);

// What may be on in each state, by its name: nothing (off, dark, ambient, none), the one luminaire of that
// name (A, B2, lamp1), else everything (all, on, full, and occasions such as evening, whose dimming nobody
// can guess). Where no name looks like a luminaire's, every other one is taken for one.
struct GuessedState {
  std::string id;
  std::vector<std::string> luminaires;
};
std::vector<GuessedState> GuessStates(const PhotoNames& names);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_PHOTO_NAMES_H_
