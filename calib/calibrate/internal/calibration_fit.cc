#include "calib/calibrate/internal/calibration_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calib/calibrate/internal/mrcal_calibration.h"
#include "calib/calibrate/internal/opencv_calibration.h"
#include "calib/calibrate/internal/target_adjustment.h"
#include "calib/lens/lens_family.h"
#include "calib/luminance/median.h"

namespace luxfit {
namespace {

constexpr int kMostRounds = 12;
constexpr int kMedianRounds = 2;              // rounds that take the noise from the median
constexpr double kMedianOfTwoAxes = 1.17741;  // median of |r| for two axes of sigma 1
constexpr double kGateOfDiagonal = 0.02;      // gate of the seed, whose lens has no distortion
// A pose has six parameters, and a corner gives two equations. Three corners determine a pose with nothing over
// to tell a wrong one. Six leave as many equations over as the pose takes; the seed asks as many of an image.
constexpr int kLeastCornersOfSet = 6;

double Weighted(const CalibrationProblem& problem, const Eigen::Matrix2Xd& residuals, std::size_t k) {
  return problem.corners[k].weight * residuals.col(static_cast<Eigen::Index>(k)).norm();
}

double MedianNoisePx(const CalibrationProblem& problem, const Eigen::Matrix2Xd& residuals) {
  std::vector<double> lengths;
  lengths.reserve(problem.corners.size());
  for (std::size_t k = 0; k < problem.corners.size(); ++k) {
    const double length = Weighted(problem, residuals, k);
    lengths.push_back(std::isfinite(length) ? length : 1e9);
  }
  return Quantile(std::move(lengths), 0.5) / kMedianOfTwoAxes;
}

// Returns the number of free parameters of the adjustment, whether or not the corners determine them.
double FreeParameters(const CalibrationProblem& problem, const CalibrationState& state, bool warp) {
  const int lens = ParameterCount(state.lens) - FirstFreeParameter(state.lens);
  const auto cameras = static_cast<int>(state.intrinsics.size());
  return static_cast<double>(cameras) * lens + 6.0 * (cameras - 1) + 6.0 * problem.sets + (warp ? 2 : 0);
}

double UsedNoisePx(const CalibrationProblem& problem, const Eigen::Matrix2Xd& residuals, double parameters) {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < problem.corners.size(); ++k) {
    if (!problem.corners[k].used) continue;
    const double length = Weighted(problem, residuals, k);
    sum += length * length;
    count += 2;
  }
  // Control points that no corner determines take no freedom: parameters take at most half of the rows.
  return count > 0 ? std::sqrt(sum / (count - std::min(parameters, count / 2))) : 0;
}

// Marks the corners further off than `most_px` as outliers; returns whether any corner's use changed.
bool MarkOutliers(CalibrationProblem& problem, const Eigen::Matrix2Xd& residuals, double most_px) {
  bool changed = false;
  for (std::size_t k = 0; k < problem.corners.size(); ++k) {
    const bool used = Weighted(problem, residuals, k) <= most_px;
    changed = changed || used != problem.corners[k].used;
    problem.corners[k].used = used;
  }
  return changed;
}

// Leaves out all corners of the sets that keep too few for a pose; returns the number of such sets. Their poses
// would be undetermined, and with them the covariance of the cameras.
int LeaveOutStarvedSets(CalibrationProblem& problem) {
  std::vector<int> used(static_cast<std::size_t>(problem.sets), 0);
  for (const CornerObservation& corner : problem.corners)
    used[static_cast<std::size_t>(corner.set)] += corner.used ? 1 : 0;
  for (CornerObservation& corner : problem.corners)
    corner.used = corner.used && used[static_cast<std::size_t>(corner.set)] >= kLeastCornersOfSet;
  return static_cast<int>(
      std::count_if(used.begin(), used.end(), [](int count) { return count < kLeastCornersOfSet; }));
}

double DiagonalPx(const CalibrationProblem& problem) {
  double diagonal_px = 0;
  for (const CalibrationCamera& camera : problem.input->cameras)
    diagonal_px = std::max(diagonal_px, std::hypot(camera.width_px, camera.height_px));
  return diagonal_px;
}

// Returns the stereographic camera of the rig that sees the widest field.
Camera WidestCamera(const CalibrationProblem& problem, const CalibrationState& wide) {
  Camera widest;
  double best = 0;
  for (std::size_t c = 0; c < wide.intrinsics.size(); ++c) {
    const CalibrationCamera& size = problem.input->cameras[c];
    const Camera camera = CameraOf(wide.lens, wide.intrinsics[c], size.width_px, size.height_px);
    const double half = size.width_px / camera.fx_px;
    if (half <= best) continue;
    best = half;
    widest = camera;
  }
  return widest;
}

// Returns the start of a lens from a wide seed, which was fitted without distortion.
CalibrationState FromWide(const CalibrationProblem& problem, const CalibrationState& wide,
                          const LensKind& kind) {
  CalibrationState start = wide;
  const Camera widest = WidestCamera(problem, wide);
  const double half = std::hypot(widest.width_px, widest.height_px) / 2 / widest.fx_px;
  const LensOps& ops = OpsOf(kind.lens);
  const std::vector<double> distortion = ops.like_stereographic == nullptr
                                             ? std::vector<double>{}
                                             : ops.like_stereographic(2 * std::atan(half / 2));
  start.lens = MakeLensFunction(kind, widest);
  for (std::vector<double>& parameters : start.intrinsics) {
    parameters.resize(4);
    parameters.resize(static_cast<std::size_t>(ParameterCount(start.lens)), 0.0);
    std::copy(distortion.begin(), distortion.end(), parameters.begin() + 4);
  }
  return start;
}

CalibrationState FromSimpler(const CalibrationState& simpler, const LensKind& kind) {
  CalibrationState start = simpler;
  start.lens = MakeLensFunction(kind, {});
  for (std::vector<double>& parameters : start.intrinsics)
    parameters.resize(static_cast<std::size_t>(ParameterCount(start.lens)), 0.0);
  return start;
}

// Solves the adjustment from the fit's state and takes the solution over, or the reason why there is none.
bool SolveOnce(const CalibrationProblem& problem, const LensFitOptions& options, bool warp, LensFit& fit) {
  SolvedState solved = SolveCalibration(problem, fit.state, {true, warp}, options.back_end);
  if (!solved.ok) {
    fit.message = solved.message;
    return false;
  }
  fit.state = std::move(solved.state);
  fit.residuals = Residuals(problem, fit.state);
  return true;
}

}  // namespace

SolvedState SolveCalibration(const CalibrationProblem& problem, const CalibrationState& start,
                             const SolveSelection& selection, CalibrationBackEnd back_end) {
  if (back_end == CalibrationBackEnd::kOpenCv && OpenCvCanSolve(problem, start.lens.kind))
    return SolveByOpenCv(problem, start);
  if (MrcalCanSolve(problem, start.lens.kind)) return SolveByMrcal(problem, start, selection);
  return SolveByCeres(problem, start, selection);
}

LinearizedState LinearizeCalibration(const CalibrationProblem& problem, const CalibrationState& state,
                                     const SolveSelection& selection) {
  if (MrcalCanSolve(problem, state.lens.kind)) return LinearizeByMrcal(problem, state, selection);
  return LinearizeByCeres(problem, state, selection);
}

LensFit FitFrom(CalibrationProblem problem, CalibrationState start, const LensFitOptions& options) {
  LensFit fit;
  fit.state = std::move(start);
  const bool warp = options.warp && problem.input->target.IsGrid();
  double parameters = FreeParameters(problem, fit.state, warp);
  for (int round = 0; round < kMostRounds; ++round) {
    if (!SolveOnce(problem, options, warp, fit)) return fit;
    const double noise_px = round < kMedianRounds ? MedianNoisePx(problem, fit.residuals)
                                                  : UsedNoisePx(problem, fit.residuals, parameters);
    const bool changed = MarkOutliers(problem, fit.residuals, options.outlier_sigmas * noise_px + 1e-6);
    if (!changed && round >= kMedianRounds) break;
  }
  // Only the last round decides: until then corners may come back.
  if (const int starved = LeaveOutStarvedSets(problem)) {
    if (!SeesEveryCamera(problem)) {
      fit.message = "a camera has no image with " + std::to_string(kLeastCornersOfSet) + " corners that fit";
      return fit;
    }
    if (!SolveOnce(problem, options, warp, fit)) return fit;
    parameters -= 6.0 * starved;
  }
  fit.noise_px = UsedNoisePx(problem, fit.residuals, parameters);
  fit.used.reserve(problem.corners.size());
  for (const CornerObservation& corner : problem.corners) fit.used.push_back(corner.used);
  fit.ok = true;
  return fit;
}

LensFit FitLens(CalibrationProblem problem, const CalibrationSeed& seed, const LensKind& kind,
                const LensFit* simpler, const LensFitOptions& options) {
  const LensOps& ops = OpsOf(kind.lens);
  if (ops.is_nested && simpler != nullptr && simpler->ok && simpler->state.lens.kind.lens == kind.lens) {
    for (std::size_t k = 0; k < problem.corners.size(); ++k) problem.corners[k].used = simpler->used[k];
    return FitFrom(std::move(problem), FromSimpler(simpler->state, kind), options);
  }
  const CalibrationState& better = seed.is_wide ? seed.wide : seed.pinhole;
  MarkOutliers(problem, Residuals(problem, better), kGateOfDiagonal * DiagonalPx(problem));
  const bool from_pinhole = ops.is_pinhole && !seed.is_wide;
  const CalibrationState& family = from_pinhole ? seed.pinhole : seed.wide;
  const SolvedState solved = SolveCalibration(problem, family, {false, false}, CalibrationBackEnd::kMrcal);
  const CalibrationState core = solved.ok ? solved.state : family;
  MarkOutliers(problem, Residuals(problem, core), kGateOfDiagonal * DiagonalPx(problem));
  const CalibrationState start = from_pinhole ? FromSimpler(core, kind) : FromWide(problem, core, kind);
  return FitFrom(std::move(problem), start, options);
}

}  // namespace luxfit
