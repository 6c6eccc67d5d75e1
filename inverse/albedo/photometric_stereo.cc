#include "inverse/albedo/photometric_stereo.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "calib/luminance/median.h"
#include "inverse/albedo/internal/stereo_adjustment.h"

namespace luxfit {
namespace {

// A normal and an albedo have three unknowns.
constexpr Eigen::Index kMinLights = 3;
// Fewer images leave no data to compare curves.
constexpr Eigen::Index kMinImagesToChoose = 5;
constexpr double kLargestZ2 = 9;  // limit of z^2 for one observation left out

void ExpectConsistent(const StereoData& data) {
  const Eigen::Index images = data.value.rows();
  const auto fits = [&](Eigen::Index size) { return size == 0 || size == images; };
  if (images < kMinLights || data.to_light.cols() != images || !fits(data.direction_sigma_rad.size()) ||
      !fits(data.strength.size()))
    throw std::invalid_argument(
        "SolvePhotometricStereo: expected three images or more, each with a direction");
  if (!((data.to_light.colwise().norm().array() - 1).abs() < 1e-6).all())
    throw std::invalid_argument("SolvePhotometricStereo: expected unit directions");
  if (data.strength.size() > 0 && !(data.strength.array() > 0).all())
    throw std::invalid_argument("SolvePhotometricStereo: expected strengths > 0");
}

// Returns the value below which 95 % lie; 0 where there is none.
double BrightestValue(const Eigen::MatrixXd& value) {
  std::vector<double> finite;
  finite.reserve(static_cast<size_t>(value.size()));
  std::copy_if(value.data(), value.data() + value.size(), std::back_inserter(finite),
               [](double v) { return std::isfinite(v); });
  if (finite.empty()) return 0;
  const auto at = finite.begin() + static_cast<std::ptrdiff_t>(static_cast<double>(finite.size() - 1) * 0.95);
  std::nth_element(finite.begin(), at, finite.end());
  return std::max(0.0, *at);
}

bool UsesShadows(StereoMethod method) { return method == StereoMethod::kLeastSquares; }
bool IsRobust(StereoMethod method) {
  return method == StereoMethod::kRobust || method == StereoMethod::kRobustStrengths;
}

StereoProblem ProblemOf(const StereoData& data, const PhotometricStereoOptions& options, double brightest) {
  const Eigen::Index images = data.value.rows();
  StereoProblem problem;
  problem.value = data.value / brightest;
  const double least = UsesShadows(options.method) ? -1e9 : options.shadow_fraction;
  problem.used = problem.value.array().isFinite() && problem.value.array() >= least;
  problem.to_light = data.to_light;
  problem.direction_sigma_rad = Eigen::VectorXd::Zero(images);
  if (IsRobust(options.method) && data.direction_sigma_rad.size() > 0)
    problem.direction_sigma_rad = data.direction_sigma_rad;
  problem.strengths_free = options.method == StereoMethod::kRobustStrengths;
  problem.robust = IsRobust(options.method);
  return problem;
}

StereoState StartOf(const StereoProblem& problem, const Eigen::VectorXd& strength, CurveKind kind) {
  return {SolveLambert(problem, strength), problem.to_light, strength, StartCurve(kind)};
}

StereoProblem ThinnedPixels(const StereoProblem& problem, int most) {
  const Eigen::Index pixels = problem.value.cols();
  if (pixels <= most) return problem;
  std::vector<Eigen::Index> kept;
  kept.reserve(static_cast<size_t>(most));
  for (int i = 0; i < most; ++i) kept.push_back(pixels * i / most);
  StereoProblem thinned = problem;
  thinned.value = problem.value(Eigen::all, kept);
  thinned.used = problem.used(Eigen::all, kept);
  return thinned;
}

// Holds residuals of observations left out of the fit, images x pixels; NaN elsewhere.
struct HeldOut {
  Eigen::MatrixXd residual;
  bool is_at_bound = false;  // true: a parameter is at its bound in any part
};
HeldOut LeaveOut(const StereoProblem& problem, const Eigen::VectorXd& strength, CurveKind kind, int folds) {
  HeldOut held_out{Eigen::MatrixXd::Constant(problem.value.rows(), problem.value.cols(), NAN)};
  for (int fold = 0; fold < folds; ++fold) {
    StereoProblem part = problem;
    // Every pixel leaves out other images, so that every image keeps most of its pixels.
    const auto is_out = [&](Eigen::Index k, Eigen::Index i) { return (k + i) % folds == fold; };
    for (Eigen::Index i = 0; i < part.used.cols(); ++i) {
      for (Eigen::Index k = 0; k < part.used.rows(); ++k) part.used(k, i) = part.used(k, i) && !is_out(k, i);
    }
    const StereoAdjustment fit = AdjustStereo(part, StartOf(part, strength, kind));
    held_out.is_at_bound = held_out.is_at_bound || IsAtBound(fit.state.curve);
    const Eigen::MatrixXd residuals = StereoResiduals(part, fit.state);
    for (Eigen::Index i = 0; i < part.used.cols(); ++i) {
      for (Eigen::Index k = 0; k < part.used.rows(); ++k) {
        if (problem.used(k, i) && is_out(k, i)) held_out.residual(k, i) = residuals(k, i);
      }
    }
  }
  return held_out;
}

double MedianSize(const Eigen::MatrixXd& residuals) {
  std::vector<double> size;
  for (const double r : residuals.reshaped()) {
    if (std::isfinite(r)) size.push_back(std::abs(r));
  }
  return Quantile(std::move(size), 0.5);
}

// Returns the mean of min(z^2, 9) of every image.
Eigen::VectorXd ScoreByImage(const Eigen::MatrixXd& residuals, double sigma) {
  Eigen::VectorXd score(residuals.rows());
  for (Eigen::Index k = 0; k < residuals.rows(); ++k) {
    double sum = 0;
    int count = 0;
    for (const double r : residuals.row(k)) {
      if (!std::isfinite(r)) continue;
      sum += std::min(r * r / (sigma * sigma), kLargestZ2);
      ++count;
    }
    score[k] = count > 0 ? sum / count : 0;
  }
  return score;
}

struct ChosenCurve {
  CurveKind kind = CurveKind::kLambert;
  std::vector<CurveScore> scores;
  std::string because;
};

// Returns the simplest candidate within one standard error of the best.
ChosenCurve SimplestOfTheBest(const std::vector<CurveKind>& among,
                              const std::vector<Eigen::VectorXd>& scores) {
  const auto better = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) { return a.mean() < b.mean(); };
  const Eigen::VectorXd& best = *std::min_element(scores.begin(), scores.end(), better);
  ChosenCurve chosen;
  chosen.because = "fewest parameters within one standard error of the best on observations left out";
  int fewest = kMaxCurveParameters + 1;
  double score_of_chosen = INFINITY;
  for (size_t c = 0; c < among.size(); ++c) {
    const Eigen::ArrayXd difference = (scores[c] - best).array();
    const double n = static_cast<double>(difference.size());
    const double error = std::sqrt((difference - difference.mean()).square().sum() / (n * (n - 1)));
    chosen.scores.push_back({among[c], scores[c].mean(), error});
    const int parameters = ParameterCount(among[c]);
    const bool is_simpler =
        parameters < fewest || (parameters == fewest && scores[c].mean() < score_of_chosen);
    if (difference.mean() <= error && is_simpler) {
      chosen.kind = among[c];
      fewest = parameters;
      score_of_chosen = scores[c].mean();
    }
  }
  return chosen;
}

ChosenCurve ChooseCurve(const StereoProblem& problem, const Eigen::VectorXd& strength,
                        const PhotometricStereoOptions& options) {
  const std::vector<CurveKind>& candidates = options.curves;
  if (candidates.size() < 2)
    return {candidates.empty() ? CurveKind::kLambert : candidates[0], {}, "the only candidate"};
  const Eigen::Index images = problem.value.rows();
  if (images < kMinImagesToChoose) {
    return {CurveKind::kLambert, {}, std::to_string(images) + " images leave none over to compare curves on"};
  }
  const StereoProblem thinned = ThinnedPixels(problem, options.choice_pixels);
  const int folds = std::min(static_cast<int>(images), options.max_folds);
  std::vector<CurveKind> among;
  std::vector<Eigen::MatrixXd> residuals;
  double sigma = INFINITY;
  for (const CurveKind kind : candidates) {
    HeldOut held_out = LeaveOut(thinned, strength, kind, folds);
    if (held_out.is_at_bound && kind != CurveKind::kLambert) continue;
    // The common error is the smallest that any candidate reached.
    sigma = std::min(sigma, std::max(kSigmaPerMad * MedianSize(held_out.residual), 1e-9));
    among.push_back(kind);
    residuals.push_back(std::move(held_out.residual));
  }
  if (!std::isfinite(sigma)) return {CurveKind::kLambert, {}, "no observation could be left out"};
  std::vector<Eigen::VectorXd> scores;
  scores.reserve(residuals.size());
  for (const Eigen::MatrixXd& r : residuals) scores.push_back(ScoreByImage(r, sigma));
  return SimplestOfTheBest(among, scores);
}

void FillSigmas(const StereoProblem& problem, const StereoAdjustment& fit, double brightest,
                PhotometricStereo& result) {
  const std::vector<Eigen::Matrix3d> covariance = StereoCovariance(problem, fit);
  const Eigen::Index pixels = fit.state.b.cols();
  result.albedo_sigma = Eigen::VectorXd::Constant(pixels, NAN);
  result.normal_sigma_rad = Eigen::VectorXd::Constant(pixels, NAN);
  for (Eigen::Index i = 0; i < pixels; ++i) {
    const Eigen::Matrix3d& c = covariance[static_cast<size_t>(i)];
    const Eigen::Vector3d normal = result.normal.col(i);
    const double along = normal.dot(c * normal);
    result.albedo_sigma[i] = brightest * std::sqrt(std::max(0.0, along));
    result.normal_sigma_rad[i] = std::sqrt(std::max(0.0, c.trace() - along)) / fit.state.b.col(i).norm();
  }
}

void FillPixels(const Eigen::Matrix3Xd& b, double brightest, PhotometricStereo& result) {
  result.albedo = brightest * b.colwise().norm().transpose();
  result.normal = b;
  for (Eigen::Index i = 0; i < b.cols(); ++i) {
    const bool is_solved = b.col(i).squaredNorm() > 0 && b.col(i).allFinite();
    if (is_solved) {
      result.normal.col(i).normalize();
    } else {
      result.normal.col(i).setConstant(NAN);
      result.albedo[i] = NAN;
    }
  }
}

std::string Undetermined(const PhotometricStereo& result) {
  if (result.albedo.array().isFinite().any()) return "";
  return "no pixel has three valid images or more whose lights are not in one plane";
}

}  // namespace

std::string ToString(StereoMethod method) {
  switch (method) {
    case StereoMethod::kLeastSquares:
      return "least squares";
    case StereoMethod::kWithoutShadows:
      return "without shadows";
    case StereoMethod::kRobust:
      return "robust";
    case StereoMethod::kRobustStrengths:
      return "robust, strengths unknown";
  }
  return "";
}

PhotometricStereo SolvePhotometricStereo(const StereoData& data, const PhotometricStereoOptions& options) {
  ExpectConsistent(data);
  PhotometricStereo result;
  const Eigen::Index images = data.value.rows();
  const double brightest = BrightestValue(data.value);
  if (!(brightest > 0)) {
    result.message = "no valid value above 0";
    return result;
  }
  const Eigen::VectorXd strength = data.strength.size() > 0 ? data.strength : Eigen::VectorXd::Ones(images);
  const StereoProblem problem = ProblemOf(data, options, brightest);
  StereoAdjustment fit{StartOf(problem, strength, CurveKind::kLambert)};
  result.because = "the method has no other";
  if (IsRobust(options.method)) {
    ChosenCurve chosen = ChooseCurve(problem, strength, options);
    result.scores = std::move(chosen.scores);
    result.because = std::move(chosen.because);
    fit = AdjustStereo(problem, StartOf(problem, strength, chosen.kind));
  } else {
    fit = AdjustStereo(problem, fit.state, 0);  // only for its residuals
  }
  FillPixels(fit.state.b, brightest, result);
  result.to_light = fit.state.to_light;
  result.strength = fit.state.strength;
  result.curve = fit.state.curve;
  result.residual = brightest * StereoResiduals(problem, fit.state);
  result.residual_sigma = brightest * fit.residual_sigma;
  result.message = Undetermined(result);
  if (!result.message.empty()) return result;
  result.status = StereoStatus::kDone;
  result.message = options.method == StereoMethod::kRobustStrengths
                       ? "albedo and the strengths of all lights are known up to one common factor"
                       : "albedo is in units of value over strength of light";
  if (options.covariance) FillSigmas(problem, fit, brightest, result);
  return result;
}

}  // namespace luxfit
