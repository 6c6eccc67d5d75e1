// Defines the frame of unsurveyed tags, whose photos tell only how they hang relative to each other.
//
// The adjustment holds one tag, whose own corners are no better than any other's. Afterwards all is moved so
// that all corners together lie best on their places in the first map (without scale). The covariance is that
// of this frame, not of one tag's. With G the six rows
//   sum over corners of dx = 0,   sum over corners of (x - mean) x dx = 0
// it is (N + w G^T G)^-1 of the normal matrix N with all tags free, w large.
// Source: Meissl (1962), "Die innere Genauigkeit eines Punkthaufens"; Triggs et al. (2000), 9.4.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_FREE_FRAME_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_FREE_FRAME_H_

#include <Eigen/Core>
#include <vector>

#include "calib/register/internal/bundle/bundle_adjustment.h"

namespace luxfit {

// Moves views, tags and points to that frame.
void SettleFrame(BundleAdjustment& adjustment);

// Returns G for unknowns in which each tag has six in a row: its displacement and half its turn. The tags
// begin at column `first`, in the order of `ids`; there are `columns` in all.
Eigen::MatrixXd FrameRows(const BundleAdjustment& adjustment, const std::vector<int>& ids, int first,
                          int columns);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_FREE_FRAME_H_
