#include "inverse/choose/self_calibration.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "inverse/choose/internal/left_out.h"
#include "inverse/choose/internal/photo_equations.h"
#include "inverse/select/one_standard_error.h"

namespace luxfit {
namespace {

constexpr int kCalibrationRounds = 12;
constexpr double kConverged = 1e-4;  // largest step of any unknown; views differ by ten times as much
constexpr double kTail = 2;          // Cauchy scale of the gains' prior, in its sigmas
constexpr double kUnseen = 1e-6;     // curvature of a direction that no data determine
// Limits of q: light to the power 2 to that of 1/3, steeper than any display's curve.
constexpr double kLeastExponent = -0.5, kMostExponent = 2;
constexpr int kMinElements = 20;
// Share of the best score. All elements of a view share its pose's error, and furniture that the mesh lacks
// is at another place in each view. Gains absorb some of it, and then predict the data left out better, too.
constexpr double kWorthHaving = 0.25;
// Smallest spread between views of a surface. Below it they differ for reasons that no camera model contains.
constexpr double kLeastRatioSigma = 1e-3;

using Sums = PhotoEquations::Sums;

void ExpectInRange(const Patches& patches, const std::vector<Eigen::VectorXd>& dimming,
                   const std::vector<PhotoSample>& samples, const OpenRadiometry& open) {
  const size_t cameras = open.vignetting.size();
  if (open.response.size() != cameras || dimming.empty())
    throw std::invalid_argument("SelfCalibrate: expected a state, and what is open of every camera");
  for (const PhotoSample& s : samples) {
    const bool known = s.element >= 0 && s.element < static_cast<int>(patches.elements.size()) &&
                       s.state >= 0 && s.state < static_cast<int>(dimming.size()) && s.photo >= 0 &&
                       s.camera >= 0 && s.camera < static_cast<int>(cameras);
    if (!known || !std::isfinite(s.log_value) || !std::isfinite(s.log_share) || !std::isfinite(s.radius2) ||
        !(s.relative_sigma > 0) || !std::isfinite(s.relative_sigma))
      throw std::invalid_argument("SelfCalibrate: expected samples of known elements, finite, sigmas > 0");
  }
}

// Fits one combination of free parameters to all samples, and without each fold.
class Candidate {
 public:
  Candidate(const PhotoEquations& equations, RadiometryCandidate& what, const OpenRadiometry& open,
            int photos, double gain_sigma)
      : equations_(equations), photos_(what.gains ? photos : 0), gain_sigma_(gain_sigma) {
    for (size_t c = 0; c < open.vignetting.size(); ++c) {
      const bool darkens = open.vignetting[c] && what.order > 0, bends = open.response[c] && what.exponent;
      unknowns_.vignetting.push_back(darkens ? unknowns_.count : -1);
      unknowns_.count += darkens ? what.order : 0;
      unknowns_.exponent.push_back(bends ? unknowns_.count : -1);
      unknowns_.count += bends ? 1 : 0;
    }
    unknowns_.order = what.order;
    if (what.gains) unknowns_.first_gain = unknowns_.count;
    // One gain is not counted: the light absorbs it.
    what.parameters = unknowns_.count + std::max(0, photos_ - 1);
    unknowns_.count += photos_;
  }

  void Solve() {
    fit_ = equations_.Start(unknowns_);
    for (int round = 0; round < kCalibrationRounds; ++round) {
      by_fold_ = equations_.Linearize(unknowns_, fit_);
      const Eigen::VectorXd step = StepWithout(-1);
      fit_.x = Bounded(fit_.x + step);
      equations_.Reweigh(unknowns_, fit_);
      if (round > 1 && (step.size() == 0 || step.cwiseAbs().maxCoeff() < kConverged)) break;
    }
    by_fold_ = equations_.Linearize(unknowns_, fit_);
    curvature_ = Total(-1).normal + PriorCurvature();
  }

  GroupScores Score() const {
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

  double sigma() const { return fit_.sigma; }

  // Residuals of one facet are not independent: their gradients are summed before they are squared.
  Eigen::MatrixXd Covariance() const {
    Eigen::MatrixXd scatter = PriorCurvature();
    const auto gradients = equations_.GradientByGroup(unknowns_, fit_);
    const double groups = static_cast<double>(gradients.size());
    for (const auto& [group, g] : gradients)
      scatter += groups / std::max(1.0, groups - 1) * g * g.transpose();
    const Eigen::LDLT<Eigen::MatrixXd> curvature(curvature_);
    return curvature.solve(curvature.solve(scatter).transpose());
  }

  // Returns the curvature alone: it tells whether the samples determine a parameter at all.
  Eigen::MatrixXd Information() const {
    return curvature_.ldlt().solve(Eigen::MatrixXd::Identity(unknowns_.count, unknowns_.count));
  }
  // Returns the largest sigma of any camera, from a covariance of the unknowns.
  double CornerSigma(const Eigen::MatrixXd& covariance) const {
    double largest = 0;
    for (const int first : unknowns_.vignetting) {
      if (first >= 0)
        largest = std::max(largest, covariance.block(first, first, unknowns_.order, unknowns_.order).sum());
    }
    return std::sqrt(largest);
  }
  double ExponentSigma(const Eigen::MatrixXd& covariance) const {
    double largest = 0;
    for (const int at : unknowns_.exponent) {
      if (at >= 0) largest = std::max(largest, covariance(at, at));
    }
    return std::sqrt(largest);
  }
  bool IsAtBound() const { return !Bounded(fit_.x * (1 + 1e-9)).isApprox(fit_.x * (1 + 1e-9)); }

  const RadiometryUnknowns& unknowns() const { return unknowns_; }
  const Eigen::VectorXd& x() const { return fit_.x; }

 private:
  Sums Total(int without) const {
    Sums total{Eigen::MatrixXd::Zero(unknowns_.count, unknowns_.count),
               Eigen::VectorXd::Zero(unknowns_.count)};
    for (int fold = 0; fold < PhotoEquations::kFolds; ++fold) {
      if (fold == without) continue;
      total.normal += by_fold_[static_cast<size_t>(fold)].normal;
      total.right += by_fold_[static_cast<size_t>(fold)].right;
    }
    return total;
  }

  Eigen::VectorXd Bounded(Eigen::VectorXd x) const {
    for (const int at : unknowns_.exponent) {
      if (at >= 0) x[at] = std::clamp(x[at], kLeastExponent, kMostExponent);
    }
    return x;
  }

  Eigen::MatrixXd PriorCurvature() const {
    Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(unknowns_.count, kUnseen);
    for (int p = 0; p < photos_; ++p) {
      const double z = fit_.x[unknowns_.first_gain + p] / gain_sigma_;
      diagonal[unknowns_.first_gain + p] = 1 / (gain_sigma_ * gain_sigma_ * (1 + z * z / (kTail * kTail)));
    }
    return diagonal.asDiagonal();
  }

  Eigen::VectorXd StepWithout(int fold) const {
    const Sums total = Total(fold);
    const Eigen::MatrixXd prior = PriorCurvature();
    if (unknowns_.count == 0) return {};
    return (total.normal + prior).ldlt().solve(total.right - prior * fit_.x);
  }

  const PhotoEquations& equations_;
  int photos_;
  double gain_sigma_;
  RadiometryUnknowns unknowns_;
  PhotoEquations::Fit fit_;
  std::vector<Sums> by_fold_;
  Eigen::MatrixXd curvature_;
};

std::string NameOf(const RadiometryCandidate& c) {
  std::string name = c.gains ? "gains" : "";
  const auto add = [&](const std::string& part) { name += (name.empty() ? "" : " + ") + part; };
  if (c.order > 0) add("vignetting of order " + std::to_string(c.order));
  if (c.exponent) add("response exponent");
  return name.empty() ? "as recorded" : name;
}

std::vector<RadiometryCandidate> CandidatesOf(const OpenRadiometry& open, int max_order) {
  const auto any = [](const std::vector<bool>& list) {
    return std::count(list.begin(), list.end(), true) > 0;
  };
  std::vector<RadiometryCandidate> candidates;
  for (int exponent = 0; exponent <= (any(open.response) ? 1 : 0); ++exponent) {
    for (int gains = 0; gains <= (open.gains ? 1 : 0); ++gains) {
      for (int order = 0; order <= (any(open.vignetting) ? max_order : 0); ++order) {
        RadiometryCandidate candidate;
        candidate.gains = gains == 1;
        candidate.order = order;
        candidate.exponent = exponent == 1;
        candidate.name = NameOf(candidate);
        candidates.push_back(std::move(candidate));
      }
    }
  }
  return candidates;
}

// Chooses among the candidates that the samples determine.
int Choose(std::vector<RadiometryCandidate>& candidates, const std::vector<GroupScores>& scores) {
  std::vector<SelectionCandidate> selectable;
  for (size_t c = 0; c < candidates.size(); ++c)
    selectable.push_back(
        {scores[c], static_cast<double>(candidates[c].parameters), candidates[c].is_determined});
  SelectionOptions options;
  options.worth_having = kWorthHaving;
  const Selection selection = SimplestWithinOneStandardError(selectable, options);
  for (size_t c = 0; c < candidates.size(); ++c) {
    candidates[c].score = selection.score[c];
    candidates[c].standard_error = selection.standard_error[c];
  }
  return static_cast<int>(selection.chosen);
}

// Reports the chosen combination in the caller's terms.
void Report(const Candidate& chosen, const std::vector<PhotoSample>& samples, int states, double gain_sigma,
            SelfCalibration& result) {
  const RadiometryUnknowns& unknowns = chosen.unknowns();
  const Eigen::VectorXd& x = chosen.x();
  const Eigen::MatrixXd covariance = chosen.Covariance();
  if (result.Chosen().order > 0) result.corner_sigma = chosen.CornerSigma(covariance);
  if (result.Chosen().exponent) result.exponent_sigma = chosen.ExponentSigma(covariance);
  for (size_t c = 0; c < unknowns.vignetting.size(); ++c) {
    const Eigen::Index camera = static_cast<Eigen::Index>(c);
    if (unknowns.vignetting[c] >= 0)
      result.vignetting.col(camera).head(unknowns.order) = x.segment(unknowns.vignetting[c], unknowns.order);
    if (unknowns.exponent[c] >= 0) result.exponent[camera] = x[unknowns.exponent[c]];
  }
  if (unknowns.first_gain < 0) return;
  const Eigen::Index photos = result.log_gain.size();
  result.log_gain = x.segment(unknowns.first_gain, photos);
  // A factor common to all photos belongs to the camera's scale and is not an error of any photo.
  const Eigen::MatrixXd relative = Eigen::MatrixXd::Identity(photos, photos) -
                                   Eigen::MatrixXd::Constant(photos, photos, 1 / static_cast<double>(photos));
  result.covariance = relative * covariance.block(unknowns.first_gain, unknowns.first_gain, photos, photos) *
                      relative.transpose();
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(photos, states);
  for (const PhotoSample& sample : samples) mean(sample.photo, sample.state) = 1;
  const Eigen::VectorXd all = mean.rowwise().sum().cwiseMin(1.0);
  for (int s = 0; s < states; ++s) {
    if (mean.col(s).sum() == 0) continue;
    const Eigen::VectorXd against = mean.col(s) / mean.col(s).sum() - all / all.sum();
    result.state_sigma[s] = std::sqrt(std::max(0.0, against.dot(result.covariance * against)));
    result.state_prior_sigma[s] = gain_sigma * against.norm();
  }
}

}  // namespace

PhotoCorrection SelfCalibration::CorrectionOf(int photo, int camera) const {
  const auto coefficients = vignetting.col(camera);
  return {log_gain[photo], {coefficients.begin(), coefficients.end()}, exponent[camera]};
}

double SelfCalibration::CornerShare(int camera) const { return std::exp(vignetting.col(camera).sum()); }

double SelfCalibration::ResponsePower(int camera) const { return 1 / (1 + exponent[camera]); }

SelfCalibration SelfCalibrate(const Patches& patches, const std::vector<Eigen::VectorXd>& dimming,
                              const std::vector<PhotoSample>& samples, const OpenRadiometry& open,
                              const SelfCalibrationOptions& options) {
  ExpectInRange(patches, dimming, samples, open);
  int photos = 0;
  for (const PhotoSample& sample : samples) photos = std::max(photos, sample.photo + 1);
  const Eigen::Index cameras = static_cast<Eigen::Index>(open.vignetting.size());
  const int states = static_cast<int>(dimming.size());
  SelfCalibration result;
  result.log_gain = Eigen::VectorXd::Zero(photos);
  result.vignetting = Eigen::MatrixXd::Zero(options.max_order, cameras);
  result.exponent = Eigen::VectorXd::Zero(cameras);
  result.covariance = Eigen::MatrixXd::Zero(photos, photos);
  result.state_sigma = result.state_prior_sigma = Eigen::VectorXd::Zero(states);
  result.candidates = CandidatesOf(open, options.max_order);
  PhotoEquations equations(patches, dimming, samples, options.max_elements);
  if (equations.elements() < kMinElements) {
    result.message = "fewer than " + std::to_string(kMinElements) + " surfaces are seen in several photos";
    return result;
  }
  std::vector<Candidate> fitted;
  fitted.reserve(result.candidates.size());
  for (RadiometryCandidate& candidate : result.candidates)
    fitted.emplace_back(equations, candidate, open, photos, options.gain_sigma);
  // All are scored with the noise that the fullest model leaves, with or without an exponent, whichever is
  // smaller: an exponent that nothing determines misleads.
  double sigma = std::numeric_limits<double>::infinity();
  for (size_t c = 0; c < fitted.size(); ++c) {
    const bool is_fullest =
        c + 1 == fitted.size() || (result.candidates[c + 1].exponent && !result.candidates[c].exponent);
    if (!is_fullest) continue;
    fitted[c].Solve();
    sigma = std::min(sigma, fitted[c].sigma());
  }
  equations.set_common_sigma(std::max(kLeastRatioSigma, sigma));
  result.residual_sigma = sigma;
  std::vector<GroupScores> scores;
  scores.resize(fitted.size());
  tbb::parallel_for(size_t{0}, fitted.size(), [&](size_t c) {
    fitted[c].Solve();
    scores[c] = fitted[c].Score();
  });
  for (size_t c = 0; c < fitted.size(); ++c) {
    const Eigen::MatrixXd information = fitted[c].Information();
    const double corner = fitted[c].CornerSigma(information), exponent = fitted[c].ExponentSigma(information);
    result.candidates[c].is_determined = corner <= options.max_corner_sigma &&
                                         exponent <= options.max_exponent_sigma && !fitted[c].IsAtBound();
    if (result.candidates[c].order == 1 && !result.candidates[c].exponent && !result.candidates[c].gains)
      result.corner_sigma = corner;
    if (result.candidates[c].order == 0 && result.candidates[c].exponent && !result.candidates[c].gains)
      result.exponent_sigma = exponent;
  }
  result.chosen = Choose(result.candidates, scores);
  result.is_possible = true;
  const Candidate& chosen = fitted[static_cast<size_t>(result.chosen)];
  Report(chosen, samples, states, options.gain_sigma, result);
  return result;
}

}  // namespace luxfit
