#include "calib/calibrate/internal/lens_choice.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/calibrate/internal/calibration_covariance.h"
#include "calib/calibrate/internal/target_pose.h"
#include "calib/lens/lens_family.h"

namespace luxfit {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kLeastSets = 3;  // two to fit, one to hold out
constexpr int kPoseSteps = 30;
constexpr double kCornersPerParameter = 2;  // a lens with fewer is not worth trying

// Holds the problem without the sets of one fold, and the number of each of its sets in the whole problem.
struct TrainingProblem {
  CalibrationProblem problem;
  std::vector<int> whole_set;
};

TrainingProblem Without(const CalibrationProblem& whole, const std::vector<bool>& used, int fold, int folds) {
  TrainingProblem training;
  training.problem.input = whole.input;
  std::vector<int> number(static_cast<std::size_t>(whole.sets), -1);
  for (std::size_t k = 0; k < whole.corners.size(); ++k) {
    CornerObservation corner = whole.corners[k];
    if (corner.set % folds == fold) continue;
    int& set = number[static_cast<std::size_t>(corner.set)];
    if (set < 0) {
      set = training.problem.sets++;
      training.whole_set.push_back(corner.set);
    }
    corner.set = set;
    corner.used = used[k];
    training.problem.corners.push_back(corner);
  }
  return training;
}

void ScoreSet(const CalibrationProblem& problem, const CalibrationState& lens, const Eigen::Isometry3d& start,
              const std::vector<bool>& counted, int set, HeldOutScore& score) {
  std::vector<SeenPoint> points;
  for (std::size_t k = 0; k < problem.corners.size(); ++k) {
    const CornerObservation& corner = problem.corners[k];
    if (corner.set != set || !counted[k]) continue;
    const auto camera = static_cast<std::size_t>(corner.camera);
    points.push_back({TargetPoint(problem.input->target, corner.point, lens.warp_m), corner.pixel,
                      corner.weight, &lens.intrinsics[camera], lens.cam_from_rig[camera]});
  }
  const double freedom = 2.0 * static_cast<double>(points.size()) - 6;
  if (freedom < 2) return;
  const Eigen::Isometry3d pose = RefinePose(lens.lens, points, start, 0, kPoseSteps);
  double sum = 0;
  for (const SeenPoint& seen : points) {
    const Eigen::Vector3d p = seen.cam_from_rig * (pose * seen.point);
    sum += seen.weight * seen.weight *
           (ProjectByLens(lens.lens, seen.parameters->data(), p, false).pixel - seen.pixel).squaredNorm();
  }
  score.squares[static_cast<std::size_t>(set)] = std::isfinite(sum) ? sum : kInfinity;
  score.freedom[static_cast<std::size_t>(set)] = freedom;
}

void ScoreFold(const CalibrationProblem& problem, const LensFit& fit, const std::vector<bool>& counted,
               int fold, int folds, const LensFitOptions& options, HeldOutScore& score) {
  const TrainingProblem training = Without(problem, fit.used, fold, folds);
  if (training.problem.sets < 2 || !SeesEveryCamera(training.problem)) return;
  CalibrationState start = fit.state;
  start.rig_from_target.clear();
  for (const int set : training.whole_set)
    start.rig_from_target.push_back(fit.state.rig_from_target[static_cast<std::size_t>(set)]);
  const bool warp = options.warp && problem.input->target.IsGrid();
  const SolvedState solved = SolveCalibration(training.problem, start, {true, warp}, options.back_end);
  for (int set = fold; set < problem.sets; set += folds) {
    if (!solved.ok) {
      score.squares[static_cast<std::size_t>(set)] = kInfinity;
      score.freedom[static_cast<std::size_t>(set)] = 1;
      continue;
    }
    ScoreSet(problem, solved.state, fit.state.rig_from_target[static_cast<std::size_t>(set)], counted, set,
             score);
  }
}

// Marks the corners that at least one candidate explains.
std::vector<bool> CountedCorners(const std::vector<LensCandidate>& candidates, std::size_t corners) {
  std::vector<bool> counted(corners, false);
  for (const LensCandidate& candidate : candidates) {
    for (std::size_t k = 0; candidate.fit.ok && k < corners; ++k)
      counted[k] = counted[k] || candidate.fit.used[k];
  }
  return counted;
}

// Returns the mean square of the lens' own projection uncertainty at its corners, per axis, px^2.
double OwnUncertaintyPx2(const CalibrationProblem& problem, const LensFit& fit,
                         const LensFitOptions& options) {
  CalibrationProblem used = problem;
  for (std::size_t k = 0; k < used.corners.size(); ++k) used.corners[k].used = fit.used[k];
  const bool warp = options.warp && problem.input->target.IsGrid();
  const CalibrationCovariance covariance =
      CovarianceOf(used, fit.state, LinearizeCalibration(used, fit.state, {true, warp}), fit.noise_px);
  constexpr std::size_t kSamples = 200;
  const std::size_t step = 1 + used.corners.size() / kSamples;
  double sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < used.corners.size(); k += step) {
    const CornerObservation& corner = used.corners[k];
    const auto c = static_cast<std::size_t>(corner.camera);
    const CalibrationCamera& size = problem.input->cameras[c];
    const Camera camera = CameraOf(fit.state.lens, fit.state.intrinsics[c], size.width_px, size.height_px);
    const double range_m =
        (fit.state.cam_from_rig[c] * (fit.state.rig_from_target[static_cast<std::size_t>(corner.set)] *
                                      TargetPoint(problem.input->target, corner.point, fit.state.warp_m)))
            .norm();
    const double variance =
        ProjectionCovarianceAt(camera, covariance.cameras[c], corner.pixel, range_m).trace() / 2;
    if (!corner.used || !std::isfinite(variance)) continue;
    sum += variance;
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

// Holds how much worse a is than b on held-out sets, px^2 per axis, and the standard error of that.
struct ScoreDifference {
  double px2 = kNaN, standard_error_px2 = 0;
};

ScoreDifference Difference(const HeldOutScore& a, const HeldOutScore& b) {
  std::vector<double> differences;
  double sum = 0, freedom = 0;
  for (std::size_t s = 0; s < a.squares.size(); ++s) {
    const double difference = a.squares[s] - b.squares[s];
    if (!std::isfinite(difference)) continue;
    differences.push_back(difference);
    sum += difference;
    freedom += a.freedom[s];
  }
  const auto n = static_cast<double>(differences.size());
  if (n < 2) return {};
  double scatter = 0;
  for (const double difference : differences) scatter += (difference - sum / n) * (difference - sum / n);
  return {sum / freedom, std::sqrt(n * scatter / (n - 1)) / freedom};
}

bool IsWorthTrying(const CalibrationProblem& problem, const LensKind& kind) {
  const CalibrationCamera& camera = problem.input->cameras.front();
  const double parameters = ParameterCount(kind, static_cast<double>(camera.height_px) / camera.width_px);
  const double per_camera =
      static_cast<double>(problem.corners.size()) / static_cast<double>(problem.input->cameras.size());
  return per_camera >= kCornersPerParameter * parameters;
}

void ScoreAll(const CalibrationProblem& problem, int folds, const LensFitOptions& options,
              std::vector<LensCandidate>& candidates) {
  const std::vector<bool> counted = CountedCorners(candidates, problem.corners.size());
  for (LensCandidate& candidate : candidates) {
    if (candidate.fit.ok && candidate.counted != counted) {
      candidate.counted = counted;
      candidate.score = ScoreHeldOut(problem, candidate.fit, counted, folds, options);
    }
  }
}

bool IsRicherSpline(const LensKind& kind, const std::vector<LensCandidate>& candidates) {
  return OpsOf(kind.lens).has_control_points && !candidates.empty() &&
         candidates.back().kind.lens == kind.lens;
}

// Splines take most of the time: a richer spline is tried only where the one before it beat all others.
bool IsLastTheBest(const std::vector<LensCandidate>& candidates) {
  const double last_px = candidates.back().score.PerAxisPx();
  return std::isfinite(last_px) &&
         std::all_of(candidates.begin(), candidates.end(), [&](const LensCandidate& candidate) {
           return !candidate.fit.ok || !(candidate.score.PerAxisPx() < last_px);
         });
}

std::string Decide(const CalibrationProblem& problem, const LensFitOptions& options, LensChoice& choice) {
  int best = -1;
  for (std::size_t i = 0; i < choice.candidates.size(); ++i) {
    const LensCandidate& candidate = choice.candidates[i];
    if (!candidate.fit.ok) continue;
    if (choice.chosen < 0) choice.chosen = static_cast<int>(i);  // the simplest, where nothing is held out
    if (best < 0 ||
        candidate.score.PerAxisPx() < choice.candidates[static_cast<std::size_t>(best)].score.PerAxisPx())
      best = static_cast<int>(i);
  }
  if (best < 0) return "no candidate could be fitted";
  const LensCandidate& winner = choice.candidates[static_cast<std::size_t>(best)];
  if (!std::isfinite(winner.score.PerAxisPx()))
    return "too few sets of images to hold any out: the simplest candidate";
  const double own_px2 = OwnUncertaintyPx2(problem, winner.fit, options);
  for (std::size_t i = 0; i < choice.candidates.size(); ++i) {
    const LensCandidate& candidate = choice.candidates[i];
    if (!candidate.fit.ok) continue;
    const ScoreDifference worse = Difference(candidate.score, winner.score);
    if (static_cast<int>(i) != best && !(worse.px2 <= std::max(worse.standard_error_px2, own_px2))) continue;
    choice.chosen = static_cast<int>(i);
    break;
  }
  if (choice.chosen == best) return "the least error on held-out images, and no simpler lens comes near it";
  return "the simplest whose error on held-out images is not above the best one's (" + ToString(winner.kind) +
         ") by more than one standard error or that lens' own uncertainty";
}

}  // namespace

double HeldOutScore::PerAxisPx() const {
  double sum = 0, count = 0;
  for (std::size_t s = 0; s < squares.size(); ++s) {
    if (std::isnan(squares[s])) continue;
    sum += squares[s];
    count += freedom[s];
  }
  return count > 0 ? std::sqrt(sum / count) : kNaN;
}

HeldOutScore ScoreHeldOut(const CalibrationProblem& problem, const LensFit& fit,
                          const std::vector<bool>& counted, int folds, const LensFitOptions& options) {
  HeldOutScore score;
  score.squares.assign(static_cast<std::size_t>(problem.sets), kNaN);
  score.freedom.assign(static_cast<std::size_t>(problem.sets), 0);
  const int parts = std::min(folds, problem.sets);
  if (problem.sets < kLeastSets || parts < 2) return score;
  // Folds are disjoint sets: each writes its own elements.
  tbb::parallel_for(0, parts,
                    [&](int fold) { ScoreFold(problem, fit, counted, fold, parts, options, score); });
  return score;
}

LensChoice ChooseLens(const CalibrationProblem& problem, const CalibrationSeed& seed,
                      const std::vector<LensKind>& kinds, int folds, const LensFitOptions& options) {
  LensChoice choice;
  const LensFit* simpler = nullptr;
  choice.candidates.reserve(kinds.size());
  for (const LensKind& kind : kinds) {
    if (kinds.size() > 1 && !IsWorthTrying(problem, kind)) continue;
    if (IsRicherSpline(kind, choice.candidates)) {
      ScoreAll(problem, folds, options, choice.candidates);
      if (!IsLastTheBest(choice.candidates)) continue;
    }
    choice.candidates.push_back({kind, FitLens(problem, seed, kind, simpler, options), {}, {}});
    const LensFit& fit = choice.candidates.back().fit;
    if (fit.ok && OpsOf(kind.lens).is_nested) simpler = &fit;
  }
  ScoreAll(problem, folds, options, choice.candidates);
  choice.because = Decide(problem, options, choice);
  if (kinds.size() == 1) choice.because = "asked for";
  return choice;
}

}  // namespace luxfit
