#include "calib/calibrate/internal/target_adjustment.h"

#include <ceres/ceres.h>

#include <array>
#include <memory>

#include "calib/lens/lens_family.h"

namespace luxfit {
namespace {

using Pose = std::array<double, 6>;
using RowMajor36 = Eigen::Matrix<double, 3, 6, Eigen::RowMajor>;
using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using RowMajor2N = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double kCoefficientPx = 1e-3;  // residual of a distortion coefficient of 1
constexpr double kControlPointPx = 5;    // residual of a control point of 1

// Holds the cost of one corner. Parameters: lens, rig_from_target, and cam_from_rig for all but the first
// camera; two residuals.
class CornerCost : public ceres::CostFunction {
 public:
  CornerCost(const LensFunction& lens, const Eigen::Vector3d& point, const CornerObservation& corner)
      : lens_(lens), point_(point), pixel_(corner.pixel), weight_(corner.weight), in_rig_(corner.camera > 0) {
    set_num_residuals(2);
    mutable_parameter_block_sizes()->push_back(ParameterCount(lens));
    mutable_parameter_block_sizes()->push_back(6);
    if (in_rig_) mutable_parameter_block_sizes()->push_back(6);
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    RowMajor36 d_target, d_rig;
    RowMajor3 d_rig_point;
    Eigen::Vector3d p, in_rig;
    mrcal_transform_point_rt(in_rig.data(), d_target.data(), nullptr, parameters[1], point_.data());
    p = in_rig;
    d_rig_point.setIdentity();
    if (in_rig_)
      mrcal_transform_point_rt(p.data(), d_rig.data(), d_rig_point.data(), parameters[2], in_rig.data());
    const bool with_lens = jacobians != nullptr && jacobians[0] != nullptr;
    const LensPoint image = ProjectByLens(lens_, parameters[0], p, with_lens);
    if (!image.pixel.allFinite()) return false;
    Eigen::Map<Eigen::Vector2d>(residuals, 2) = weight_ * (image.pixel - pixel_);
    if (jacobians == nullptr) return true;
    if (with_lens)
      Eigen::Map<RowMajor2N>(jacobians[0], 2, ParameterCount(lens_)) = weight_ * image.d_parameters;
    if (jacobians[1] != nullptr)
      Eigen::Map<RowMajor2N>(jacobians[1], 2, 6) = weight_ * image.d_point * d_rig_point * d_target;
    if (in_rig_ && jacobians[2] != nullptr)
      Eigen::Map<RowMajor2N>(jacobians[2], 2, 6) = weight_ * image.d_point * d_rig;
    return true;
  }

 private:
  LensFunction lens_;
  Eigen::Vector3d point_;
  Eigen::Vector2d pixel_;
  double weight_;
  bool in_rig_;
};

class DistortionPrior : public ceres::CostFunction {
 public:
  DistortionPrior(int parameters, double scale) : scale_(scale) {
    set_num_residuals(parameters - 4);
    mutable_parameter_block_sizes()->push_back(parameters);
  }
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const int rows = num_residuals();
    for (int i = 0; i < rows; ++i) residuals[i] = scale_ * parameters[0][4 + i];
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> jacobian(
        jacobians[0], rows, rows + 4);
    jacobian.setZero();
    jacobian.rightCols(rows).diagonal().setConstant(scale_);
    return true;
  }

 private:
  double scale_;
};

// Holds the parameter blocks and the problem over them.
class Adjustment {
 public:
  Adjustment(const CalibrationProblem& problem, const CalibrationState& state,
             const SolveSelection& selection)
      : state_(state) {
    for (const Eigen::Isometry3d& pose : state.cam_from_rig) cam_from_rig_.push_back(Blocked(pose));
    for (const Eigen::Isometry3d& pose : state.rig_from_target) rig_from_target_.push_back(Blocked(pose));
    ordering_ = std::make_shared<ceres::ParameterBlockOrdering>();
    for (const CornerObservation& corner : problem.corners) {
      if (corner.used) Add(problem, corner);
    }
    for (std::vector<double>& parameters : state_.intrinsics) AddLens(parameters, selection);
  }

  bool Solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_SCHUR;
    options.linear_solver_ordering = ordering_;
    options.max_num_iterations = 100;
    options.function_tolerance = 1e-12;
    options.parameter_tolerance = 1e-12;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return summary.IsSolutionUsable();
  }

  CalibrationState State() const {
    CalibrationState out = state_;
    for (std::size_t c = 1; c < cam_from_rig_.size(); ++c)
      out.cam_from_rig[c] = PoseOf(cam_from_rig_[c].data());
    for (std::size_t s = 0; s < rig_from_target_.size(); ++s)
      out.rig_from_target[s] = PoseOf(rig_from_target_[s].data());
    return out;
  }

  LinearizedState Linearize() {
    LinearizedState out;
    ceres::Problem::EvaluateOptions options;
    int at = 0;
    const auto add = [&](double* block, int unknowns) {
      if (!problem_.HasParameterBlock(block)) return -1;
      options.parameter_blocks.push_back(block);
      at += unknowns;
      return at - unknowns;
    };
    const int lens_unknowns = ParameterCount(state_.lens) - FirstFreeParameter(state_.lens);
    for (std::vector<double>& parameters : state_.intrinsics)
      out.intrinsics_at.push_back(add(parameters.data(), lens_unknowns));
    for (std::size_t c = 0; c < cam_from_rig_.size(); ++c)
      out.cam_from_rig_at.push_back(c == 0 ? -1 : add(cam_from_rig_[c].data(), 6));
    for (Pose& pose : rig_from_target_) out.rig_from_target_at.push_back(add(pose.data(), 6));
    ceres::CRSMatrix jacobian;
    problem_.Evaluate(options, nullptr, nullptr, nullptr, &jacobian);
    const Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>> rows(
        jacobian.num_rows, jacobian.num_cols, static_cast<Eigen::Index>(jacobian.values.size()),
        jacobian.rows.data(), jacobian.cols.data(), jacobian.values.data());
    out.jacobian = rows;
    return out;
  }

 private:
  static Pose Blocked(const Eigen::Isometry3d& pose) {
    Pose block;
    Eigen::Map<Eigen::Matrix<double, 6, 1>>(block.data()) = RodriguesOf(pose);
    return block;
  }

  void Add(const CalibrationProblem& problem, const CornerObservation& corner) {
    const Eigen::Vector3d point = TargetPoint(problem.input->target, corner.point, state_.warp_m);
    double* const target = rig_from_target_[static_cast<std::size_t>(corner.set)].data();
    double* const lens = state_.intrinsics[static_cast<std::size_t>(corner.camera)].data();
    std::vector<double*> blocks = {lens, target};
    if (corner.camera > 0) blocks.push_back(cam_from_rig_[static_cast<std::size_t>(corner.camera)].data());
    problem_.AddResidualBlock(new CornerCost(state_.lens, point, corner), nullptr, blocks);
    ordering_->AddElementToGroup(target, 0);
    for (double* const block : blocks) {
      if (block != target) ordering_->AddElementToGroup(block, 1);
    }
  }

  void AddLens(std::vector<double>& parameters, const SolveSelection& selection) {
    const int count = ParameterCount(state_.lens), free = FirstFreeParameter(state_.lens);
    if (!problem_.HasParameterBlock(parameters.data()) || count == 4) return;
    std::vector<int> held;
    for (int i = 0; i < count; ++i) {
      if (i < free || (i >= 4 && !selection.distortion)) held.push_back(i);
    }
    if (!held.empty()) problem_.SetManifold(parameters.data(), new ceres::SubsetManifold(count, held));
    const bool is_splined = OpsOf(state_.lens.kind.lens).has_control_points;
    problem_.AddResidualBlock(new DistortionPrior(count, is_splined ? kControlPointPx : kCoefficientPx),
                              nullptr, parameters.data());
  }

  CalibrationState state_;
  std::vector<Pose> cam_from_rig_, rig_from_target_;
  ceres::Problem problem_;
  std::shared_ptr<ceres::ParameterBlockOrdering> ordering_;
};

}  // namespace

SolvedState SolveByCeres(const CalibrationProblem& problem, const CalibrationState& start,
                         const SolveSelection& selection) {
  if (!IsFinite(start)) return {false, start, "the start is not finite"};
  Adjustment adjustment(problem, start, selection);
  if (!adjustment.Solve())
    return {false, start, "no lens of this kind brings the corners to their places in the images"};
  SolvedState solved{true, adjustment.State(), ""};
  if (!IsFinite(solved.state)) return {false, start, "the fit ran away to infinity"};
  return solved;
}

LinearizedState LinearizeByCeres(const CalibrationProblem& problem, const CalibrationState& state,
                                 const SolveSelection& selection) {
  return Adjustment(problem, state, selection).Linearize();
}

}  // namespace luxfit
