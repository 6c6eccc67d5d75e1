#include "calib/calibrate/internal/mrcal_calibration.h"

#include <suitesparse/cholmod.h>

#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "calib/lens/internal/rotation_vector.h"
#include "calib/lens/lens_family.h"

namespace luxfit {
namespace {

mrcal_pose_t MrcalPose(const Eigen::Isometry3d& pose) {
  const Eigen::Matrix<double, 6, 1> rt = RodriguesOf(pose);
  mrcal_pose_t out;
  for (int i = 0; i < 3; ++i) {
    out.r.xyz[i] = rt[i];
    out.t.xyz[i] = rt[3 + i];
  }
  return out;
}

Eigen::Isometry3d IsometryOf(const mrcal_pose_t& pose) { return PoseOf(pose.r.xyz, pose.t.xyz); }

mrcal_problem_selections_t SelectionsOf(const LensFunction& lens, const SolveSelection& selection,
                                        bool is_grid, bool has_extrinsics) {
  mrcal_problem_selections_t out{};
  out.do_optimize_intrinsics_core = FirstFreeParameter(lens) == 0;
  out.do_optimize_intrinsics_distortions = selection.distortion && ParameterCount(lens) > 4;
  out.do_optimize_extrinsics = has_extrinsics;
  out.do_optimize_frames = is_grid;
  out.do_optimize_calobject_warp = is_grid && selection.warp;
  out.do_apply_regularization = true;
  out.do_apply_outlier_rejection = false;
  return out;
}

// Holds the arguments that libmrcal's functions share.
struct MrcalArguments {
  bool is_grid = false;
  int cameras = 0, extrinsics = 0, frames = 0, points = 0;
  int columns = 0, rows = 0;
  double spacing_m = 0;
  std::vector<double> intrinsics;
  std::vector<mrcal_pose_t> cam_from_reference, reference_from_target;
  std::vector<mrcal_point3_t> points_in_reference;
  mrcal_calobject_warp_t warp{};
  std::vector<mrcal_observation_board_t> boards;
  std::vector<mrcal_observation_point_t> point_observations;
  std::vector<mrcal_point3_t> pool;
  std::vector<int> image_sizes;
  mrcal_lensmodel_t model{};
  mrcal_problem_selections_t selections{};
  // libmrcal penalises points whose range lies outside these limits.
  mrcal_problem_constants_t constants{1e-6, 1e9};

  int board_count() const { return static_cast<int>(boards.size()); }
  int point_observation_count() const { return static_cast<int>(point_observations.size()); }
  int states() const {
    return mrcal_num_states(cameras, extrinsics, frames, points, points, board_count(), selections, &model);
  }
  int measurements() const {
    return mrcal_num_measurements(board_count(), point_observation_count(), columns, rows, cameras,
                                  extrinsics, frames, points, points, selections, &model);
  }
};

// Marks the sets with fewer corners in use than determine a pose.
std::vector<bool> StarvedSets(const CalibrationProblem& problem) {
  constexpr int kLeastCorners = 4;
  std::vector<int> used(static_cast<std::size_t>(problem.sets), 0);
  for (const CornerObservation& corner : problem.corners)
    used[static_cast<std::size_t>(corner.set)] += corner.used ? 1 : 0;
  std::vector<bool> starved;
  starved.reserve(used.size());
  for (const int count : used) starved.push_back(count < kLeastCorners);
  return starved;
}

// Returns a corner's pixel and weight; mrcal takes weights below 0 as "not seen". The pose of a starved set
// would make the equations singular, so its corners hold it with a small weight.
mrcal_point3_t Seen(const CornerObservation& corner, const std::vector<bool>& starved) {
  constexpr double kThread = 1e-3;
  mrcal_point3_t seen{};
  seen.x = corner.pixel.x();
  seen.y = corner.pixel.y();
  seen.z = corner.used ? corner.weight : -1;
  if (starved[static_cast<std::size_t>(corner.set)]) seen.z = kThread * corner.weight;
  return seen;
}

// Adds one observation per (set, camera), in that order, each with every corner of the grid.
void AddBoards(const CalibrationProblem& problem, MrcalArguments& arguments) {
  const CalibrationTarget& target = problem.input->target;
  arguments.columns = target.columns;
  arguments.rows = target.rows;
  arguments.spacing_m = target.spacing_m;
  const std::vector<bool> starved = StarvedSets(problem);
  mrcal_point3_t unseen{};
  unseen.z = -1;
  int image = -1;
  for (const CornerObservation& corner : problem.corners) {
    if (corner.image != image) {
      image = corner.image;
      mrcal_observation_board_t board{};
      board.icam.intrinsics = corner.camera;
      board.icam.extrinsics = corner.camera - 1;
      board.iframe = corner.set;
      arguments.boards.push_back(board);
      arguments.pool.resize(arguments.pool.size() + target.points.size(), unseen);
    }
    arguments.pool[arguments.pool.size() - target.points.size() + static_cast<std::size_t>(corner.point)] =
        Seen(corner, starved);
  }
}

void AddPoints(const CalibrationProblem& problem, MrcalArguments& arguments) {
  for (const Eigen::Vector3d& point : problem.input->target.points) {
    mrcal_point3_t p{};
    p.x = point.x();
    p.y = point.y();
    p.z = point.z();
    arguments.points_in_reference.push_back(p);
  }
  arguments.points = static_cast<int>(arguments.points_in_reference.size());
  const std::vector<bool> starved = StarvedSets(problem);
  arguments.point_observations.reserve(problem.corners.size());
  for (const CornerObservation& corner : problem.corners) {
    mrcal_observation_point_t observation{};
    observation.icam.intrinsics = 0;
    observation.icam.extrinsics = corner.set;
    observation.i_point = corner.point;
    observation.px = Seen(corner, starved);
    arguments.point_observations.push_back(observation);
  }
}

MrcalArguments MakeArguments(const CalibrationProblem& problem, const CalibrationState& state,
                             const SolveSelection& selection) {
  const CalibrationInput& input = *problem.input;
  if (!MrcalCanSolve(problem, state.lens.kind) || state.intrinsics.size() != input.cameras.size() ||
      state.cam_from_rig.size() != input.cameras.size() ||
      state.rig_from_target.size() != static_cast<std::size_t>(problem.sets) || problem.corners.empty())
    throw std::invalid_argument("calibration: not a problem for libmrcal");
  MrcalArguments arguments;
  arguments.is_grid = input.target.IsGrid();
  arguments.cameras = static_cast<int>(input.cameras.size());
  arguments.model = state.lens.model;
  for (std::size_t c = 0; c < input.cameras.size(); ++c) {
    if (static_cast<int>(state.intrinsics[c].size()) != ParameterCount(state.lens))
      throw std::invalid_argument("calibration: a wrong number of lens parameters");
    arguments.intrinsics.insert(arguments.intrinsics.end(), state.intrinsics[c].begin(),
                                state.intrinsics[c].end());
    arguments.image_sizes.push_back(input.cameras[c].width_px);
    arguments.image_sizes.push_back(input.cameras[c].height_px);
  }
  if (arguments.is_grid) {
    for (std::size_t c = 1; c < input.cameras.size(); ++c)
      arguments.cam_from_reference.push_back(MrcalPose(state.cam_from_rig[c]));
    for (const Eigen::Isometry3d& pose : state.rig_from_target)
      arguments.reference_from_target.push_back(MrcalPose(pose));
    AddBoards(problem, arguments);
  } else {
    for (const Eigen::Isometry3d& pose : state.rig_from_target)
      arguments.cam_from_reference.push_back(MrcalPose(pose));
    AddPoints(problem, arguments);
  }
  arguments.extrinsics = static_cast<int>(arguments.cam_from_reference.size());
  arguments.frames = static_cast<int>(arguments.reference_from_target.size());
  arguments.warp.x2 = state.warp_m.x();
  arguments.warp.y2 = state.warp_m.y();
  arguments.selections = SelectionsOf(state.lens, selection, arguments.is_grid, arguments.extrinsics > 0);
  return arguments;
}

CalibrationState StateOf(const MrcalArguments& arguments, CalibrationState state) {
  const auto parameters = static_cast<std::ptrdiff_t>(ParameterCount(state.lens));
  for (std::size_t c = 0; c < state.intrinsics.size(); ++c) {
    const auto first = arguments.intrinsics.begin() + static_cast<std::ptrdiff_t>(c) * parameters;
    state.intrinsics[c].assign(first, first + parameters);
  }
  if (arguments.is_grid) {
    for (std::size_t c = 1; c < state.cam_from_rig.size(); ++c)
      state.cam_from_rig[c] = IsometryOf(arguments.cam_from_reference[c - 1]);
  }
  const std::vector<mrcal_pose_t>& poses =
      arguments.is_grid ? arguments.reference_from_target : arguments.cam_from_reference;
  for (std::size_t s = 0; s < poses.size(); ++s) state.rig_from_target[s] = IsometryOf(poses[s]);
  state.warp_m = {arguments.warp.x2, arguments.warp.y2};
  return state;
}

// Scales a packed state to full units by libmrcal's function, which takes the number of boards, too, from 2.4 on.
template <typename Function>
void Unpack(Function* unpack, const MrcalArguments& a, std::vector<double>& state) {
  if constexpr (std::is_invocable_v<Function*, double*, int, int, int, int, int, mrcal_problem_selections_t,
                                    const mrcal_lensmodel_t*>) {
    unpack(state.data(), a.cameras, a.extrinsics, a.frames, a.points, a.points, a.selections, &a.model);
  } else {
    unpack(state.data(), a.cameras, a.extrinsics, a.frames, a.points, a.points, a.board_count(), a.selections,
           &a.model);
  }
}

// libmrcal gives the transpose of the Jacobian as compressed columns. The range of each point fills a third
// row, which holds no information.
Eigen::SparseMatrix<double> JacobianOf(const MrcalArguments& arguments) {
  const int states = arguments.states(), measurements = arguments.measurements();
  const int non_zeros = _mrcal_num_j_nonzero(
      arguments.board_count(), arguments.point_observation_count(), arguments.columns, arguments.rows,
      arguments.cameras, arguments.extrinsics, arguments.frames, arguments.points, arguments.points,
      arguments.boards.data(), arguments.point_observations.data(), arguments.selections, &arguments.model);
  std::vector<int> starts(static_cast<std::size_t>(measurements) + 1),
      indices(static_cast<std::size_t>(non_zeros));
  std::vector<double> values(static_cast<std::size_t>(non_zeros)), b(static_cast<std::size_t>(states)),
      x(static_cast<std::size_t>(measurements));
  cholmod_sparse transpose{};
  transpose.nrow = static_cast<std::size_t>(states);
  transpose.ncol = static_cast<std::size_t>(measurements);
  transpose.nzmax = static_cast<std::size_t>(non_zeros);
  transpose.p = starts.data();
  transpose.i = indices.data();
  transpose.x = values.data();
  transpose.itype = CHOLMOD_INT;
  transpose.xtype = CHOLMOD_REAL;
  transpose.dtype = CHOLMOD_DOUBLE;
  transpose.sorted = 1;
  transpose.packed = 1;
  if (!mrcal_optimizer_callback(
          b.data(), states * static_cast<int>(sizeof(double)), x.data(),
          measurements * static_cast<int>(sizeof(double)), &transpose, arguments.intrinsics.data(),
          arguments.cam_from_reference.data(), arguments.reference_from_target.data(),
          arguments.points_in_reference.data(), &arguments.warp, arguments.cameras, arguments.extrinsics,
          arguments.frames, arguments.points, arguments.points, arguments.boards.data(),
          arguments.point_observations.data(), arguments.board_count(), arguments.point_observation_count(),
          arguments.pool.data(), &arguments.model, arguments.image_sizes.data(), arguments.selections,
          &arguments.constants, arguments.spacing_m, arguments.columns, arguments.rows, false))
    throw std::runtime_error("calibration: libmrcal refused its optimiser's callback");
  std::vector<double> scale(static_cast<std::size_t>(states), 1.0);
  Unpack(&mrcal_unpack_solver_state_vector, arguments, scale);
  const Eigen::Map<const Eigen::VectorXd> unit(scale.data(), states);
  const Eigen::Map<const Eigen::SparseMatrix<double>> jt(states, measurements, non_zeros, starts.data(),
                                                         indices.data(), values.data());
  return Eigen::SparseMatrix<double>(jt.transpose()) * unit.cwiseInverse().asDiagonal();
}

}  // namespace

bool MrcalCanSolve(const CalibrationProblem& problem, const LensKind& kind) {
  return OpsOf(kind.lens).is_in_mrcal &&
         (problem.input->target.IsGrid() || problem.input->cameras.size() == 1);
}

SolvedState SolveByMrcal(const CalibrationProblem& problem, const CalibrationState& start,
                         const SolveSelection& selection) {
  if (!IsFinite(start)) return {false, start, "the start is not finite"};
  MrcalArguments arguments = MakeArguments(problem, start, selection);
  std::vector<double> b(static_cast<std::size_t>(arguments.states())),
      x(static_cast<std::size_t>(arguments.measurements()));
  if (b.empty() || x.size() < b.size()) return {false, start, "fewer corners than unknowns"};
  const mrcal_stats_t stats = mrcal_optimize(
      b.data(), static_cast<int>(b.size() * sizeof(double)), x.data(),
      static_cast<int>(x.size() * sizeof(double)), arguments.intrinsics.data(),
      arguments.cam_from_reference.data(), arguments.reference_from_target.data(),
      arguments.points_in_reference.data(), &arguments.warp, arguments.cameras, arguments.extrinsics,
      arguments.frames, arguments.points, arguments.points, arguments.boards.data(),
      arguments.point_observations.data(), arguments.board_count(), arguments.point_observation_count(),
      arguments.pool.data(), &arguments.model, arguments.image_sizes.data(), arguments.selections,
      &arguments.constants, arguments.spacing_m, arguments.columns, arguments.rows, false, false);
  if (!(stats.rms_reproj_error__pixels >= 0))
    return {false, start, "no lens of this kind brings the corners to their places in the images"};
  SolvedState solved{true, StateOf(arguments, start), ""};
  if (!IsFinite(solved.state)) return {false, start, "the fit ran away to infinity"};
  return solved;
}

LinearizedState LinearizeByMrcal(const CalibrationProblem& problem, const CalibrationState& state,
                                 const SolveSelection& selection) {
  const MrcalArguments a = MakeArguments(problem, state, selection);
  LinearizedState out;
  out.jacobian = JacobianOf(a);
  const int boards = a.board_count();
  for (int c = 0; c < a.cameras; ++c) {
    out.intrinsics_at.push_back(mrcal_state_index_intrinsics(c, a.cameras, a.extrinsics, a.frames, a.points,
                                                             a.points, boards, a.selections, &a.model));
    const bool moves = a.is_grid && c > 0;
    out.cam_from_rig_at.push_back(moves ? mrcal_state_index_extrinsics(c - 1, a.cameras, a.extrinsics,
                                                                       a.frames, a.points, a.points, boards,
                                                                       a.selections, &a.model)
                                        : -1);
  }
  for (int s = 0; s < problem.sets; ++s) {
    out.rig_from_target_at.push_back(
        a.is_grid ? mrcal_state_index_frames(s, a.cameras, a.extrinsics, a.frames, a.points, a.points, boards,
                                             a.selections, &a.model)
                  : mrcal_state_index_extrinsics(s, a.cameras, a.extrinsics, a.frames, a.points, a.points,
                                                 boards, a.selections, &a.model));
  }
  if (a.selections.do_optimize_calobject_warp)
    out.warp_at = mrcal_state_index_calobject_warp(a.cameras, a.extrinsics, a.frames, a.points, a.points,
                                                   boards, a.selections, &a.model);
  return out;
}

}  // namespace luxfit
