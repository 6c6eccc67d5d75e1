// Builds the Ceres problem of the bundle adjustment: parameter blocks, residuals and elimination order.
//
// Blocks are stored in the BundleAdjustment, which must outlive the problem and must not move.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_BUNDLE_PROBLEM_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_BUNDLE_PROBLEM_H_

#include <ceres/loss_function.h>
#include <ceres/problem.h>

#include <memory>
#include <vector>

#include "calib/register/internal/bundle/bundle_adjustment.h"
#include "calib/register/internal/bundle/reprojection_cost.h"

namespace luxfit {

struct BundleProblem {
  // Shared by all residuals and pose blocks, and owned here, not by the problem; destroyed after it.
  std::unique_ptr<ceres::LossFunction> loss;
  std::unique_ptr<ceres::Manifold> pose_manifold, turn_manifold;
  std::unique_ptr<ceres::Problem> problem;
  // Free blocks, by kind.
  std::vector<double*> poses;      // active views, in their order
  std::vector<double*> tag_parts;  // by tag: displacement and, if unsurveyed, turn
  std::vector<int> tag_ids;        // tags that have a part
  std::vector<double*> points;
  double* size_error = nullptr;  // null: held
};

// Tells whether the tag that defines the frame is held where no tag is surveyed.
enum class Frame { kHeld, kFree };

BundleProblem BuildBundleProblem(const BundleContext& context, BundleAdjustment& adjustment,
                                 Frame frame = Frame::kHeld);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_BUNDLE_PROBLEM_H_
