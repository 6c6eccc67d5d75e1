// Matches states across views: which group of photos of one view shows what a group of another view shows.
//
// Three explanations are tried:
//   walk     every state was photographed in all views before the next one was switched
//   order    every view was photographed in the same order of states; views of fewer states skip those that fit least
//   light    groups whose tags are lit alike are of one state; all groups of a view are matched together
// How well a group fits a state is the mean d to the groups that have it. Where these share no tags with the group, it
// is the difference in the share of their views' greatest brightness.
//
//   disagreement = mean over pairs of groups of different views that share tags of
//                  min(d, 1) + 0.02 |difference of shares| in one state, max(0, 0.3 - d) in two
//   d = TagLightDifference, without the biases that the explanation implies (tag_bias.h)
//
// The explanation of least disagreement is chosen; of equal ones, the first.
#ifndef LUXFIT_APPS_SESSION_PHOTOS_INTERNAL_MATCH_STATES_H_
#define LUXFIT_APPS_SESSION_PHOTOS_INTERNAL_MATCH_STATES_H_

#include <string>
#include <vector>

#include "apps/session/photos/internal/tag_light.h"

namespace luxfit {

struct MatchedStates {
  std::vector<int> state;          // of each group, numbered in the order of first photos
  std::vector<std::string> doubt;  // of each group; empty: none
  std::string because;             // what the chosen explanation is
};

// `groups` are in the order in which they were taken. No two of one view get one state.
MatchedStates MatchStates(const std::vector<LightGroup>& groups);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_PHOTOS_INTERNAL_MATCH_STATES_H_
