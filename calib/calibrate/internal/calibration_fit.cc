#include "calib/calibrate/internal/calibration_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "calib/calibrate/internal/mrcal_calibration.h"
#include "calib/calibrate/internal/opencv_calibration.h"
#include "calib/calibrate/internal/target_adjustment.h"

namespace luxfit {
namespace {

constexpr int kMostRounds = 12;
constexpr int kMedianRounds = 2;                          // with the noise of the median
constexpr double kMedianOfTwoAxes = 1.17741;              // median of |r| of two axes of sigma 1
constexpr double kGateOfDiagonal = 0.02;                  // of the seed, whose lens has no distortion
constexpr double kStereographicToEquidistant = 1.0 / 12;  // 2 tan(theta / 2) = theta + theta^3 / 12 + ...

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
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle / kMedianOfTwoAxes;
}

// Free parameters of the adjustment, of corners that determine them at all.
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
  // Control points that no corner determines take no freedom: never more than half is granted to parameters.
  return count > 0 ? std::sqrt(sum / (count - std::min(parameters, count / 2))) : 0;
}

// Whether any corner's use changed. A camera's set keeps at least as many corners as a pose needs, or none.
bool MarkOutliers(CalibrationProblem& problem, const Eigen::Matrix2Xd& residuals, double most_px) {
  bool changed = false;
  for (std::size_t k = 0; k < problem.corners.size(); ++k) {
    const bool used = Weighted(problem, residuals, k) <= most_px;
    changed = changed || used != problem.corners[k].used;
    problem.corners[k].used = used;
  }
  return changed;
}

double DiagonalPx(const CalibrationProblem& problem) {
  double diagonal_px = 0;
  for (const CalibrationCamera& camera : problem.input->cameras)
    diagonal_px = std::max(diagonal_px, std::hypot(camera.width_px, camera.height_px));
  return diagonal_px;
}

// The stereographic camera that sees as far as any of the rig's.
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

// k1, k2 that bring a pinhole nearest to the stereographic lens, over the angles that it sees:
//   tan(theta) (1 + k1 tan^2 + k2 tan^4) = 2 tan(theta / 2)
Eigen::Vector2d StereographicDistortion(const Camera& wide) {
  constexpr double kWidest = 1.1;  // rad: beyond, two coefficients cannot follow
  constexpr int kSteps = 20;
  const double half = std::hypot(wide.width_px, wide.height_px) / 2 / wide.fx_px;
  const double most = std::min(kWidest, 2 * std::atan(half / 2));
  Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  for (int i = 1; i <= kSteps; ++i) {
    const double theta = most * i / kSteps, r = std::tan(theta);
    const Eigen::Vector2d d(r * r * r, std::pow(r, 5));
    hessian += d * d.transpose();
    gradient += d * (2 * std::tan(theta / 2) - r);
  }
  return hessian.inverse() * gradient;
}

// The start of a lens that a wide seed, fitted without distortion, gives.
CalibrationState FromWide(const CalibrationProblem& problem, const CalibrationState& wide,
                          const LensKind& kind) {
  CalibrationState start = wide;
  const Camera widest = WidestCamera(problem, wide);
  const Eigen::Vector2d distortion = StereographicDistortion(widest);
  start.lens = MakeLensFunction(kind, widest);
  for (std::vector<double>& parameters : start.intrinsics) {
    parameters.resize(4);
    parameters.resize(static_cast<std::size_t>(ParameterCount(start.lens)), 0.0);
    if (kind.lens == LensModel::kFisheye) parameters[4] = kStereographicToEquidistant;
    if (kind.lens == LensModel::kOpenCv)
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
  const double parameters = FreeParameters(problem, fit.state, warp);
  for (int round = 0; round < kMostRounds; ++round) {
    SolvedState solved = SolveCalibration(problem, fit.state, {true, warp}, options.back_end);
    if (!solved.ok) {
      fit.message = solved.message;
      return fit;
    }
    fit.state = std::move(solved.state);
    fit.residuals = Residuals(problem, fit.state);
    const double noise_px = round < kMedianRounds ? MedianNoisePx(problem, fit.residuals)
                                                  : UsedNoisePx(problem, fit.residuals, parameters);
    const bool changed = MarkOutliers(problem, fit.residuals, options.outlier_sigmas * noise_px + 1e-6);
    if (!changed && round >= kMedianRounds) break;
  }
  fit.noise_px = UsedNoisePx(problem, fit.residuals, parameters);
  fit.used.reserve(problem.corners.size());
  for (const CornerObservation& corner : problem.corners) fit.used.push_back(corner.used);
  fit.ok = true;
  return fit;
}

LensFit FitLens(CalibrationProblem problem, const CalibrationSeed& seed, const LensKind& kind,
                const LensFit* simpler, const LensFitOptions& options) {
  if (simpler != nullptr && simpler->ok && simpler->state.lens.kind.lens == LensModel::kOpenCv &&
      kind.lens == LensModel::kOpenCv) {
    for (std::size_t k = 0; k < problem.corners.size(); ++k) problem.corners[k].used = simpler->used[k];
    return FitFrom(std::move(problem), FromSimpler(simpler->state, kind), options);
  }
  const CalibrationState& better = seed.is_wide ? seed.wide : seed.pinhole;
  MarkOutliers(problem, Residuals(problem, better), kGateOfDiagonal * DiagonalPx(problem));
  const bool from_pinhole = kind.lens == LensModel::kOpenCv && !seed.is_wide;
  const CalibrationState& family = from_pinhole ? seed.pinhole : seed.wide;
  const SolvedState solved = SolveCalibration(problem, family, {false, false}, CalibrationBackEnd::kMrcal);
  const CalibrationState core = solved.ok ? solved.state : family;
  MarkOutliers(problem, Residuals(problem, core), kGateOfDiagonal * DiagonalPx(problem));
  const CalibrationState start = from_pinhole ? FromSimpler(core, kind) : FromWide(problem, core, kind);
  return FitFrom(std::move(problem), start, options);
}

}  // namespace luxfit
