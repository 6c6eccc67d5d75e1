// Evaluates links of hierarchical radiosity: the light a receiver gets from a source, and its uncertainty.
//
// The factor times the source's light is, by kind of receiver <- source (d: unit direction to the source):
//   element <- element   F V          times M                                   = illuminance
//   element <- cluster   V cos / r^2  times intensity I(-d)                     = illuminance
//   cluster <- element   V A cos / (pi r^2)  times M          } illuminance perpendicular to d, which the
//   cluster <- cluster     V / r^2      times intensity I(-d)   } members turn into theirs
// Ends too near each other to be seen as points (AreNear; a cluster and itself too):
//   cluster and any      share of a member's rays that meet the source, times M = illuminance of any member
#ifndef LUXFIT_FORWARD_RADIOSITY_INTERNAL_LIGHT_LINKS_H_
#define LUXFIT_FORWARD_RADIOSITY_INTERNAL_LIGHT_LINKS_H_

#include <Eigen/Core>
#include <cstdint>

#include "forward/radiosity/internal/light_tree.h"
#include "forward/room/visibility.h"

namespace luxfit {

struct LightLink {
  int32_t receiver = 0, source = 0;
  float factor = 0;
  // Error of the receiver's illuminance over the source's mean exitance, rms over the receiver; negative
  // where to cut the source gains more.
  float error = 0;
  // Rms over the source of the visible share of each of its points, times the unoccluded factor: an uneven
  // source may show the receiver its bright part only.
  float shadow = 0;
  // Change that one more ray might bring: the unoccluded factor over the number of rays cast, where they
  // agreed and more would help; else 0. A smaller tolerance asks for more rays before it trusts them.
  float doubt = 0;
};

// Tells whether two nodes, at least one of them a cluster, are so near that light between them has no one
// direction or distance.
bool AreNear(const LightNode& p, const LightNode& q);

struct LinkEvaluation {
  enum class Verdict { kNone, kLink, kTooNear };  // no light passes; link; cut first
  Verdict verdict = Verdict::kNone;
  LightLink link;
};

// Evaluates a link. `tolerance` is the error that needs no further rays or cuts, in illuminance over the
// source's mean exitance.
LinkEvaluation EvaluateLink(const LightTree& tree, const RayScene& rays, int receiver, int source,
                            double tolerance);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_RADIOSITY_INTERNAL_LIGHT_LINKS_H_
