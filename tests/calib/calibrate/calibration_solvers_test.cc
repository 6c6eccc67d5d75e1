// The two adjustments against each other, and their derivatives against finite differences.
#include <gtest/gtest.h>

#include <cmath>

#include "calib/calibrate/internal/calibration_seed.h"
#include "calib/calibrate/internal/mrcal_calibration.h"
#include "calib/calibrate/internal/target_adjustment.h"
#include "tests/support/calib/board_views.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::BoardViews;
using support::BoardViewsOptions;
using support::OpenCv8Camera;

CalibrationInput RigInput(std::mt19937_64& rng, int images) {
  BoardViewsOptions views;
  views.images = images;
  Eigen::Isometry3d second = Eigen::Isometry3d::Identity();
  second.linear() = Eigen::AngleAxisd(0.1, Eigen::Vector3d(0.1, 1, 0.2).normalized()).toRotationMatrix();
  second.translation() = Eigen::Vector3d(-0.1, 0.02, 0.01);
  return BoardViews(support::GridTarget(), {OpenCv8Camera(), OpenCv8Camera()},
                    {Eigen::Isometry3d::Identity(), second}, views, rng)
      .input();
}

CalibrationState StartOf(const CalibrationProblem& problem) {
  const CalibrationSeed seed = SeedCalibration(problem, 0);
  EXPECT_TRUE(seed.ok) << seed.message;
  CalibrationState start = seed.pinhole;
  start.lens = MakeLensFunction({LensModel::kOpenCv, 5, 0}, {});
  for (std::vector<double>& parameters : start.intrinsics) parameters.resize(9, 0.0);
  return start;
}

TEST(CalibrationSolvers, MrcalAndCeresAgreeOnARig) {
  auto rng = support::TestRng();
  const CalibrationInput input = RigInput(rng, 10);
  const CalibrationProblem problem = MakeProblem(input);
  const CalibrationState start = StartOf(problem);
  const SolvedState by_mrcal = SolveByMrcal(problem, start, {true, false});
  const SolvedState by_ceres = SolveByCeres(problem, start, {true, false});
  ASSERT_TRUE(by_mrcal.ok && by_ceres.ok) << by_mrcal.message << by_ceres.message;
  // Only their weak regularisation differs: less than 0.01 sigma of a focal length (0.5 px).
  for (std::size_t c = 0; c < 2; ++c) {
    EXPECT_NEAR(by_mrcal.state.intrinsics[c][0], by_ceres.state.intrinsics[c][0], 0.02);
    EXPECT_NEAR(by_mrcal.state.intrinsics[c][2], by_ceres.state.intrinsics[c][2], 0.02);
    EXPECT_NEAR(by_mrcal.state.intrinsics[c][4], by_ceres.state.intrinsics[c][4], 1e-4);
  }
  EXPECT_TRUE(by_mrcal.state.cam_from_rig[1].isApprox(by_ceres.state.cam_from_rig[1], 1e-5));
  EXPECT_NEAR(Residuals(problem, by_mrcal.state).norm(), Residuals(problem, by_ceres.state).norm(),
              1e-4 * Residuals(problem, by_ceres.state).norm());
}

// One unknown of the state, by the order of LinearizedState.
void Move(CalibrationState& state, const LinearizedState& layout, int unknown, double by) {
  for (std::size_t c = 0; c < state.intrinsics.size(); ++c) {
    const int k = unknown - layout.intrinsics_at[c];
    if (k >= 0 && k < static_cast<int>(state.intrinsics[c].size()))
      state.intrinsics[c][static_cast<std::size_t>(k)] += by;
  }
  const auto move_pose = [&](Eigen::Isometry3d& pose, int at) {
    if (at < 0 || unknown < at || unknown >= at + 6) return;
    Eigen::Matrix<double, 6, 1> rt = RodriguesOf(pose);
    rt[unknown - at] += by;
    pose = PoseOf(rt.data());
  };
  for (std::size_t c = 0; c < state.cam_from_rig.size(); ++c)
    move_pose(state.cam_from_rig[c], layout.cam_from_rig_at[c]);
  for (std::size_t s = 0; s < state.rig_from_target.size(); ++s)
    move_pose(state.rig_from_target[s], layout.rig_from_target_at[s]);
  if (layout.warp_at >= 0 && unknown >= layout.warp_at) state.warp_m[unknown - layout.warp_at] += by;
}

// J^T r of the corners alone against differences of their sum of squares.
void ExpectGradient(const CalibrationProblem& problem, const CalibrationState& state,
                    const LinearizedState& linearized) {
  const Eigen::MatrixXd jacobian = linearized.jacobian;
  const Eigen::VectorXd squares = jacobian.colwise().squaredNorm();
  for (int unknown = 0; unknown < jacobian.cols(); ++unknown) {
    const double step = 1e-4 / std::sqrt(squares[unknown]);
    CalibrationState plus = state, minus = state;
    Move(plus, linearized, unknown, step);
    Move(minus, linearized, unknown, -step);
    const Eigen::Matrix2Xd slope = (Residuals(problem, plus) - Residuals(problem, minus)) / (2 * step);
    EXPECT_NEAR(slope.norm(), std::sqrt(squares[unknown]), 2e-3 * slope.norm()) << unknown;
  }
}

TEST(CalibrationSolvers, DerivativesAreThoseOfTheResiduals) {
  auto rng = support::TestRng();
  const CalibrationInput input = RigInput(rng, 3);
  const CalibrationProblem problem = MakeProblem(input);
  const SolvedState solved = SolveByMrcal(problem, StartOf(problem), {true, true});
  ASSERT_TRUE(solved.ok) << solved.message;
  ExpectGradient(problem, solved.state, LinearizeByMrcal(problem, solved.state, {true, true}));
  ExpectGradient(problem, solved.state, LinearizeByCeres(problem, solved.state, {true, false}));
}

TEST(CalibrationSolvers, WhatLibmrcalWouldAbortOnIsRefused) {
  auto rng = support::TestRng();
  const CalibrationInput input = RigInput(rng, 3);
  const CalibrationProblem problem = MakeProblem(input);
  CalibrationState state = StartOf(problem);
  EXPECT_FALSE(MrcalCanSolve(problem, {LensModel::kFisheye, 4, 0}));
  CalibrationState broken = state;
  broken.intrinsics[0][0] = std::nan("");
  EXPECT_FALSE(SolveByMrcal(problem, broken, {true, false}).ok);
  broken = state;
  broken.intrinsics[1].resize(4);
  EXPECT_THROW(SolveByMrcal(problem, broken, {true, false}), std::invalid_argument);
  broken = state;
  broken.rig_from_target.pop_back();
  EXPECT_THROW(SolveByMrcal(problem, broken, {true, false}), std::invalid_argument);
  CalibrationProblem empty = problem;
  empty.corners.clear();
  EXPECT_THROW(SolveByMrcal(empty, state, {true, false}), std::invalid_argument);
  CalibrationProblem unused = problem;
  for (CornerObservation& corner : unused.corners) corner.used = false;
  EXPECT_NO_THROW(SolveByMrcal(unused, state, {true, false}));
}

}  // namespace
}  // namespace luxfit
