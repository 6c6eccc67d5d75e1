// Groups photos by pose: photos of one camera that show tags or edges at the same pixels.
//
//   shift = median over the corners of common tags |p_a - p_b| / width
//   agreement = edges_a . edges_b    (PhotoLook::edges)
//
// Common tags decide: the same pose where the shift is below 0.4 %. One tag is enough, for its four corners fix a pose.
// Photos that both show two tags or more, and none in common, are of two poses. Others are of one where their edges
// agree by 0.15: in photos of two poses they agree by less than 0.06, in dark ones of one pose by more than 0.3.
#ifndef LUXFIT_APPS_SESSION_PHOTOS_INTERNAL_SAME_VIEW_H_
#define LUXFIT_APPS_SESSION_PHOTOS_INTERNAL_SAME_VIEW_H_

#include <string>
#include <vector>

#include "apps/session/photos/photo_look.h"

namespace luxfit {

struct PoseGuess {
  int view = 0;          // numbered in the order of their first photos
  int tags = 0;          // that another photo of the view shows at the same pixels
  double agreement = 0;  // of the edges with the best other photo of the view; 0: it is alone
  std::string doubt;     // empty: none
};

// Returns one guess for each photo. Photos are those that LookAtPhoto returns.
std::vector<PoseGuess> GroupByPose(const std::vector<PhotoLook>& photos);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_PHOTOS_INTERNAL_SAME_VIEW_H_
