#include "inverse/observe/camera/internal/radiometry/radiometry_fit.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "inverse/select/one_standard_error.h"

namespace luxfit {
namespace {

constexpr double kConverged = 1e-4;  // largest step of any unknown; views differ by ten times as much
constexpr double kTail = 2;          // Cauchy scale of the gains' prior, in its sigmas
constexpr double kUnseen = 1e-6;     // curvature of a direction that no data determine
// Limits of q: light to the power 2 to that of 1/3, steeper than any display's curve.
constexpr double kLeastExponent = -0.5, kMostExponent = 2;
// Smallest spread between views of a surface. Below it they differ for reasons that no camera model contains.
constexpr double kLeastRatioSigma = 1e-3;

using Sums = PhotoEquations::Sums;

bool IsAnyOpen(const std::vector<bool>& open) {
  return std::find(open.begin(), open.end(), true) != open.end();
}

double LargestSigma(const std::vector<int>& unknowns, const Eigen::MatrixXd& covariance) {
  double largest = 0;
  for (const int at : unknowns) {
    if (at >= 0) largest = std::max(largest, covariance(at, at));
  }
  return std::sqrt(largest);
}

std::string NameOf(const RadiometryCandidate& c) {
  std::string name = c.gains ? "gains" : "";
  const auto add = [&](const std::string& part) { name += (name.empty() ? "" : " + ") + part; };
  if (c.order > 0) add("vignetting of order " + std::to_string(c.order));
  if (c.exponent) add("response exponent");
  return name.empty() ? "as recorded" : name;
}

RadiometryCandidate CandidateOf(bool camera_gains, bool gains, int order, bool exponent) {
  RadiometryCandidate candidate;
  candidate.camera_gains = camera_gains;
  candidate.gains = gains;
  candidate.order = order;
  candidate.exponent = exponent;
  candidate.name = NameOf(candidate);
  return candidate;
}

// Chooses among the candidates that the samples determine.
int Choose(std::vector<RadiometryCandidate>& candidates, const std::vector<GroupScores>& scores) {
  std::vector<SelectionCandidate> selectable;
  selectable.reserve(candidates.size());
  for (size_t c = 0; c < candidates.size(); ++c)
    selectable.push_back(
        {scores[c], static_cast<double>(candidates[c].parameters), candidates[c].is_determined});
  SelectionOptions options;
  // All elements of a view share its pose's error, and furniture that the mesh lacks is at another place in each
  // view. Gains absorb some of it, and then predict the data left out better, too.
  options.worth_having = kWorthHaving;
  const Selection selection = SimplestWithinOneStandardError(selectable, options);
  for (size_t c = 0; c < candidates.size(); ++c) {
    candidates[c].score = selection.score[c];
    candidates[c].standard_error = selection.standard_error[c];
  }
  return static_cast<int>(selection.chosen);
}

double NoiseOf(const PhotoEquations& equations, const FreeRadiometry& free,
               std::vector<RadiometryCandidate>& fullest) {
  double sigma = std::numeric_limits<double>::infinity();
  for (RadiometryCandidate& candidate : fullest) {
    RadiometryFit fit(equations, candidate, free);
    fit.Solve();
    sigma = std::min(sigma, fit.sigma());
  }
  return sigma;
}

}  // namespace

RadiometryFit::RadiometryFit(const PhotoEquations& equations, RadiometryCandidate& what,
                             const FreeRadiometry& free)
    : equations_(equations),
      photos_(what.gains ? free.photos : 0),
      gain_sigma_(free.gain_sigma),
      least_rounds_(free.least_rounds) {
  const auto take = [&](bool is_free, int count) {
    const int first = is_free ? unknowns_.count : -1;
    unknowns_.count += is_free ? count : 0;
    return first;
  };
  for (size_t c = 0; c < free.open.vignetting.size(); ++c) {
    unknowns_.vignetting.push_back(take(free.open.vignetting[c] && what.order > 0, what.order));
    unknowns_.exponent.push_back(take(free.open.response[c] && what.exponent, 1));
    unknowns_.camera.push_back(take(free.camera_gain[c] && what.camera_gains, 1));
  }
  unknowns_.order = what.order;
  if (what.gains) unknowns_.first_gain = unknowns_.count;
  // One gain is not counted: the light absorbs it.
  what.parameters = unknowns_.count + std::max(0, photos_ - 1);
  unknowns_.count += photos_;
}

void RadiometryFit::Solve() {
  fit_ = equations_.Start(unknowns_);
  for (int round = 0; round < kRadiometryRounds; ++round) {
    by_fold_ = equations_.Linearize(unknowns_, fit_);
    const Eigen::VectorXd step = StepWithout(-1);
    fit_.x = Bounded(fit_.x + step);
    equations_.Reweigh(unknowns_, fit_);
    if (round + 1 >= least_rounds_ && (step.size() == 0 || step.cwiseAbs().maxCoeff() < kConverged)) break;
  }
  by_fold_ = equations_.Linearize(unknowns_, fit_);
  curvature_ = Total(-1).normal + PriorCurvature();
}

GroupScores RadiometryFit::Score() const {
  std::vector<GroupScores> of_fold(PhotoEquations::kFolds);
  tbb::parallel_for(0, PhotoEquations::kFolds, [&](int fold) {
    of_fold[static_cast<size_t>(fold)] =
        equations_.Score(unknowns_, fit_, Bounded(fit_.x + StepWithout(fold)), fold);
  });
  GroupScores all;
  for (const auto& scores : of_fold) {
    for (const auto& [group, score] : scores) {
      all[group].sum += score.sum;
      all[group].count += score.count;
    }
  }
  return all;
}

Eigen::MatrixXd RadiometryFit::Covariance() const {
  Eigen::MatrixXd scatter = PriorCurvature();
  const auto gradients = equations_.GradientByGroup(unknowns_, fit_);
  const double groups = static_cast<double>(gradients.size());
  for (const auto& [group, g] : gradients) scatter += groups / std::max(1.0, groups - 1) * g * g.transpose();
  const Eigen::LDLT<Eigen::MatrixXd> curvature(curvature_);
  return curvature.solve(curvature.solve(scatter).transpose());
}

Eigen::MatrixXd RadiometryFit::Information() const {
  return curvature_.ldlt().solve(Eigen::MatrixXd::Identity(unknowns_.count, unknowns_.count));
}

double RadiometryFit::CornerSigma(const Eigen::MatrixXd& covariance) const {
  double largest = 0;
  for (const int first : unknowns_.vignetting) {
    if (first >= 0)
      largest = std::max(largest, covariance.block(first, first, unknowns_.order, unknowns_.order).sum());
  }
  return std::sqrt(largest);
}

double RadiometryFit::ExponentSigma(const Eigen::MatrixXd& covariance) const {
  return LargestSigma(unknowns_.exponent, covariance);
}

double RadiometryFit::CameraSigma(const Eigen::MatrixXd& covariance) const {
  return LargestSigma(unknowns_.camera, covariance);
}

bool RadiometryFit::IsAtBound() const { return !Bounded(fit_.x * (1 + 1e-9)).isApprox(fit_.x * (1 + 1e-9)); }

Sums RadiometryFit::Total(int without) const {
  Sums total{Eigen::MatrixXd::Zero(unknowns_.count, unknowns_.count), Eigen::VectorXd::Zero(unknowns_.count)};
  for (int fold = 0; fold < PhotoEquations::kFolds; ++fold) {
    if (fold == without) continue;
    total.normal += by_fold_[static_cast<size_t>(fold)].normal;
    total.right += by_fold_[static_cast<size_t>(fold)].right;
  }
  return total;
}

Eigen::VectorXd RadiometryFit::Bounded(Eigen::VectorXd x) const {
  for (const int at : unknowns_.exponent) {
    if (at >= 0) x[at] = std::clamp(x[at], kLeastExponent, kMostExponent);
  }
  return x;
}

Eigen::MatrixXd RadiometryFit::PriorCurvature() const {
  Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(unknowns_.count, kUnseen);
  for (int p = 0; p < photos_; ++p) {
    const double z = fit_.x[unknowns_.first_gain + p] / gain_sigma_;
    diagonal[unknowns_.first_gain + p] = 1 / (gain_sigma_ * gain_sigma_ * (1 + z * z / (kTail * kTail)));
  }
  return diagonal.asDiagonal();
}

Eigen::VectorXd RadiometryFit::StepWithout(int fold) const {
  const Sums total = Total(fold);
  const Eigen::MatrixXd prior = PriorCurvature();
  if (unknowns_.count == 0) return {};
  return (total.normal + prior).ldlt().solve(total.right - prior * fit_.x);
}

std::vector<RadiometryCandidate> RadiometryCandidates(const OpenRadiometry& open, bool camera_gains,
                                                      int max_order) {
  std::vector<RadiometryCandidate> candidates;
  for (int exponent = 0; exponent <= (IsAnyOpen(open.response) ? 1 : 0); ++exponent) {
    for (int gains = 0; gains <= (open.gains ? 1 : 0); ++gains) {
      for (int order = 0; order <= (IsAnyOpen(open.vignetting) ? max_order : 0); ++order)
        candidates.push_back(CandidateOf(camera_gains, gains == 1, order, exponent == 1));
    }
  }
  return candidates;
}

std::vector<RadiometryCandidate> FullestRadiometry(const OpenRadiometry& open, bool camera_gains,
                                                   int max_order) {
  const int order = IsAnyOpen(open.vignetting) ? max_order : 0;
  std::vector<RadiometryCandidate> fullest = {CandidateOf(camera_gains, open.gains, order, false)};
  if (IsAnyOpen(open.response)) fullest.push_back(CandidateOf(camera_gains, open.gains, order, true));
  return fullest;
}

RadiometryComparison CompareRadiometry(PhotoEquations& equations, const FreeRadiometry& free,
                                       std::vector<RadiometryCandidate>& candidates,
                                       std::vector<RadiometryCandidate> fullest,
                                       const SelfCalibrationOptions& options) {
  RadiometryComparison compared;
  compared.noise = NoiseOf(equations, free, fullest);
  equations.set_common_sigma(std::max(kLeastRatioSigma, compared.noise));
  compared.fits.reserve(candidates.size());
  compared.corner_sigma.reserve(candidates.size());
  compared.exponent_sigma.reserve(candidates.size());
  for (RadiometryCandidate& candidate : candidates) compared.fits.emplace_back(equations, candidate, free);
  std::vector<GroupScores> scores(candidates.size());
  tbb::parallel_for(size_t{0}, candidates.size(), [&](size_t c) {
    compared.fits[c].Solve();
    scores[c] = compared.fits[c].Score();
  });
  for (size_t c = 0; c < candidates.size(); ++c) {
    const RadiometryFit& fit = compared.fits[c];
    const Eigen::MatrixXd information = fit.Information();
    compared.corner_sigma.push_back(fit.CornerSigma(information));
    compared.exponent_sigma.push_back(fit.ExponentSigma(information));
    // With photos' gains free, only their prior tells a camera's gain from those of its photos.
    const bool cameras_are = candidates[c].gains || fit.CameraSigma(information) <= options.max_camera_sigma;
    candidates[c].is_determined = compared.corner_sigma[c] <= options.max_corner_sigma &&
                                  compared.exponent_sigma[c] <= options.max_exponent_sigma && cameras_are &&
                                  !fit.IsAtBound();
  }
  compared.chosen = Choose(candidates, scores);
  return compared;
}

}  // namespace luxfit
