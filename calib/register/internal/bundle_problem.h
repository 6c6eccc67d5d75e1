// The bundle adjustment as Ceres sees it: parameter blocks, residuals and the order to eliminate them in.
//
// Blocks live in the BundleAdjustment, which must outlive the problem and stay where it is.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_PROBLEM_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_PROBLEM_H_

#include <ceres/loss_function.h>
#include <ceres/problem.h>

#include <memory>
#include <vector>

#include "calib/register/internal/bundle_adjustment.h"
#include "calib/register/internal/reprojection_cost.h"

namespace luxfit {

struct BundleProblem {
  // Shared by all residuals and pose blocks, as the problem is told; destroyed after it.
  std::unique_ptr<ceres::LossFunction> loss;
  std::unique_ptr<ceres::Manifold> pose_manifold, turn_manifold;
  std::unique_ptr<ceres::Problem> problem;
  // What is free, by kind.
  std::vector<double*> poses;      // of the active views, in their order
  std::vector<double*> tag_parts;  // displacement and, of tags that nobody surveyed, turn of each
  std::vector<int> tag_ids;        // of the tags that have a part
  std::vector<double*> points;
  double* size_error = nullptr;  // null: held
};

// Whether the tag that is the frame is held where no tag is surveyed.
enum class Frame { kHeld, kFree };

BundleProblem BuildBundleProblem(const BundleContext& context, BundleAdjustment& adjustment,
                                 Frame frame = Frame::kHeld);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_PROBLEM_H_
