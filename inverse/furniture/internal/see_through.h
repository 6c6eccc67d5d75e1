// Tells how much of a piece of furniture the views see, and through how much of it they see what lies behind.
//
// A view sees a place where it faces it and the mesh hides it from nobody. Where three views or more see one, it is
//   confirmed      three or more of them, and 60 %, agree on it
//   seen through   not confirmed, and in 60 % of them other views show the same signature where the ray meets the mesh
//                  without the piece, 10 cm or more behind
//
// A mirror is neither: views agree neither on it nor with what lies behind. Views never see through a thing that lies
// flat on a wall.
#ifndef LUXFIT_INVERSE_FURNITURE_INTERNAL_SEE_THROUGH_H_
#define LUXFIT_INVERSE_FURNITURE_INTERNAL_SEE_THROUGH_H_

#include <cstdint>
#include <vector>

#include "forward/room/scene.h"
#include "forward/room/visibility.h"
#include "inverse/furniture/signature_view.h"

namespace luxfit {

struct SeeThrough {
  double judged_m2 = 0, confirmed_m2 = 0, through_m2 = 0;
  std::uint64_t views = 0;  // that see through
};

// `piece`, `left_out`: facets of the mesh; `rays`: of the mesh without those left out. What lies behind is traced where
// `least_m2` or more are not confirmed.
SeeThrough LookThrough(const Scene& mesh, const std::vector<int>& left_out, const RayScene& rays,
                       const std::vector<int>& piece, const std::vector<SignatureView>& views,
                       double tolerance, double least_m2);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_INTERNAL_SEE_THROUGH_H_
