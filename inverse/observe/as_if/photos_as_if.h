// Finds photos that look as if they had been taken in another state of the luminaires than given, or encoded in sRGB.
//
//   d_e = ln Y_evs - median_(v' != v) (ln Y_ev's' - g_v's')        g: inverse/observe/internal/photo_offsets.h
//   z_e = (d_e - median_e d) / sigma_e,   score(s') = mean min(z^2, 9), by patch
//   sigma_e^2 = noise + spread^2                                   spread: the middle photo's 1.4826 median |d - median d|
//                                                                  in its own state, at least 1 %
//
// Y_evs: luminance of element e in view v and state s. Surfaces are matt enough for all views to show one pattern of light
// in a state. A photo of state s looks as if it were of s' where s' contradicts s (inverse/select/contradicted.h), and
// the score of s is above 4.5, half of the worst, that of s' below. No light is fitted, and exposures do not matter:
// states that differ by a factor alone are not told apart.
//
// A photo among linear ones whose counts went through the curve of sRGB shows the right pattern with too little contrast. It looks
// so where its observations, decoded (inverse/observe/as_if/internal/srgb_observations.h), contradict those as given in the photo's own state by
// the same rule. Of several explanations the one of the lowest score counts.
//
// In the photo's own state an element counts where two other views or more show it. A photo of fewer than 30 such elements
// is not judged, nor is one that is right once some other view is not asked: of two views, nobody knows which is wrong.
// More than half of the views of a place have to be right. One other view is enough to say which state it is instead, and
// whether the photo of that state is of the first one's. The photo of the highest score goes first, and the rest is judged
// again without it. Source: own.
#ifndef LUXFIT_INVERSE_OBSERVE_AS_IF_PHOTOS_AS_IF_H_
#define LUXFIT_INVERSE_OBSERVE_AS_IF_PHOTOS_AS_IF_H_

#include <map>
#include <utility>
#include <vector>

#include "forward/room/patches.h"
#include "inverse/observe/observe.h"

namespace luxfit {

struct PhotoAsIf {
  int view = 0, state = 0;    // as given
  int as_if = 0;              // state whose light it shows; its own where it is_srgb
  bool is_exchanged = false;  // true: the photo of its view in `as_if` looks as if it were of `state`
  // Robust spread of ln Y against the other views, up to a factor: as given, and so read.
  double difference = 0, difference_as_if = 0;
  bool is_srgb = false;  // its counts went through the curve of sRGB
};

// Share of full scale that a relative luminance of 1 counts, by view and state.
using CountedShares = std::map<std::pair<int, int>, double>;

// `counted`: the photos whose counts are said to be proportional to light; no other is taken to be encoded.
std::vector<PhotoAsIf> FindPhotosAsIf(const Patches& patches, const std::vector<Observation>& observations,
                                      const CountedShares& counted = {});

// Returns the observations of all other photos.
std::vector<Observation> WithoutPhotos(const std::vector<Observation>& observations,
                                       const std::vector<PhotoAsIf>& photos);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_AS_IF_PHOTOS_AS_IF_H_
