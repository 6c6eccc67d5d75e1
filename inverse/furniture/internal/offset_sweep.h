// Sweeps a plane of the room's hull along its normal, and tells at each offset how much views differ there.
//
//   loss(o) = sum over places and pairs of views of  q / (1 + q)        q = mean_s (a_s - b_s)^2 / (t^2 + var a_s + var b_s)
//
// a, b: signatures of a place at offset o in two views. A pair counts where both views see the place at every offset, so
// that losses compare. What stands before the plane, and what mirrors, costs about 1 a pair at every offset.
//
// A pose that errs moves what its view shows along the plane, and with it the offset at which pairs of views agree:
//
//   do = sum over pairs T . (ds_a - ds_b) / sum |T|^2        T = t_a - t_b
//
// t: along the plane, how the place that a pixel shows moves with the offset; ds: how it moves with the pose.
// Source: Collins (1996) for the sweep; Geman and McClure (1987) for the loss.
#ifndef LUXFIT_INVERSE_FURNITURE_INTERNAL_OFFSET_SWEEP_H_
#define LUXFIT_INVERSE_FURNITURE_INTERNAL_OFFSET_SWEEP_H_

#include <Eigen/Core>
#include <vector>

#include "forward/room/visibility.h"
#include "inverse/furniture/internal/hull_planes.h"
#include "inverse/furniture/signature_view.h"

namespace luxfit {

// Offsets are k kOffsetStepM from -kOffsetReachM to kOffsetReachM, m, along the normal.
constexpr int kOffsetSteps = 20, kOffsets = 2 * kOffsetSteps + 1;
constexpr double kOffsetStepM = 0.01, kOffsetReachM = kOffsetSteps * kOffsetStepM;

using OffsetLosses = Eigen::Array<double, Eigen::Dynamic, kOffsets>;

struct SweptOffsets {
  OffsetLosses by_place;            // one row for each cell of the plane
  std::vector<int> pairs_of_place;  // of views
  OffsetLosses by_view;             // one row for each view: of the pairs that it is in
  std::vector<int> pairs_of_view;
  double pose_sigma_m = 0;  // of the offset, by the covariance of each view's pose
};

// `mesh`: rays of the scene that the plane belongs to.
SweptOffsets SweepOffsets(const HullPlane& plane, const RayScene& mesh,
                          const std::vector<SignatureView>& views, double tolerance);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_INTERNAL_OFFSET_SWEEP_H_
