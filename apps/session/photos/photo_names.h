// Guesses from the names of photos which of them show one view, and what was on in each.
//
//   day1/IMG_1.png, day2/IMG_1.png    the same names in several folders: folder = state, name = view
//   v00/A.png, v01/A.png, v01/all.png the other way round, where folders are called as views are (v00, view 1, 2), or
//                                     files as states (all, off)
//   v00_A.png, v00_all.png            two names and more that share the part before the last _ or -:
//                                     view_state;
//                                     state_view where the first part is a word for a state (all, off, ...)
//   v00_A_1.png, v00_A_2.png          as above, with the number of an exposure
//   anything else, numbers for states names do not tell: every photo is a view of its own, all in one state
//
// `luxfit init` writes the guesses down for a person to check. Where names do not tell, it looks at what the photos show
// (photo_groups.h).
#ifndef LUXFIT_APPS_SESSION_PHOTOS_PHOTO_NAMES_H_
#define LUXFIT_APPS_SESSION_PHOTOS_PHOTO_NAMES_H_

#include <string>
#include <vector>

namespace luxfit {

struct NamedPhoto {
  std::string file;  // as given
  std::string view, state;
  std::string note = {};  // why, where the photo's content told; begins with CHECK where that is doubtful
};

bool IsDoubtful(const NamedPhoto& photo);

struct PhotoNames {
  std::vector<NamedPhoto> photos;
  std::string because;
  bool do_names_tell = true;  // false: each photo is taken for a view of its own
};

// `files` are paths relative to the folder of the photos.
PhotoNames GuessViewsAndStates(const std::vector<std::string>& files);

// Guesses from its name what is on in a state. Names such as off, dark, ambient and none mean nothing; the
// name of a luminaire (A, B2, lamp1) means that one. All other names (all, on, full, and occasions such as
// evening, of which a name does not tell what is on) mean everything. Where no name looks like a luminaire's, every
// other name is taken for one.
struct GuessedState {
  std::string id;
  std::vector<std::string> luminaires;
  std::vector<double> dimming = {};  // of each luminaire; empty: all 1
  std::string because = "by its name";
  bool is_occasion = false;  // its light may tell more (StatesByNamesAndLight)
  bool is_unnamed = false;   // found by light; `id` is a number
};
std::vector<GuessedState> GuessStates(const PhotoNames& names);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_PHOTOS_PHOTO_NAMES_H_
