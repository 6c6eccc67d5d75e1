#include "inverse/observe/camera/self_calibration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "inverse/observe/camera/internal/radiometry/camera_ties.h"
#include "inverse/observe/camera/internal/radiometry/photo_equations.h"
#include "inverse/observe/camera/internal/radiometry/radiometry_fit.h"

namespace luxfit {
namespace {

constexpr int kMinElements = 20;
constexpr double kContradiction = 3;  // in sigmas

void ExpectInRange(const Patches& patches, const std::vector<Eigen::VectorXd>& dimming,
                   const std::vector<PhotoSample>& samples, const OpenRadiometry& open) {
  const size_t cameras = open.vignetting.size();
  const size_t stated = open.gain_is_stated.size();
  if (open.response.size() != cameras || (stated != 0 && stated != cameras) || dimming.empty())
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

bool IsStated(const OpenRadiometry& open, size_t camera) {
  return !open.gain_is_stated.empty() && open.gain_is_stated[camera];
}

bool IsAnyFree(const FreeRadiometry& free) {
  return std::find(free.camera_gain.begin(), free.camera_gain.end(), true) != free.camera_gain.end();
}

// Frees the gain of every camera that shares surfaces with a reference, and records the ties. Returns the
// samples that can be compared.
std::vector<PhotoSample> FreeTiedCameras(const Patches& patches, const std::vector<PhotoSample>& samples,
                                         FreeRadiometry& free, SelfCalibration& result) {
  const size_t cameras = free.open.vignetting.size();
  std::vector<bool> stated(cameras);
  for (size_t c = 0; c < cameras; ++c) stated[c] = IsStated(free.open, c);
  const CameraTies ties = TieCameras(patches, samples, stated);
  free.camera_gain.resize(cameras);
  result.camera_gains.resize(cameras);
  for (size_t c = 0; c < cameras; ++c) {
    free.camera_gain[c] = ties.reference[c] != static_cast<int>(c);
    result.camera_gains[c].reference = ties.reference[c];
    result.camera_gains[c].is_tied = ties.is_tied[c];
  }
  return SamplesWithinGroups(samples, ties.reference);
}

// Holds all cameras' gains and says that those of `undetermined` are not tied.
void HoldCameras(const std::vector<bool>& undetermined, FreeRadiometry& free, SelfCalibration& result) {
  for (size_t c = 0; c < free.camera_gain.size(); ++c) {
    if (undetermined[c] && !IsStated(free.open, c)) result.camera_gains[c].is_tied = false;
    result.camera_gains[c].reference = static_cast<int>(c);
    free.camera_gain[c] = false;
  }
}

// Returns the cameras whose gains a fit leaves less certain than `max_sigma`.
std::vector<bool> UncertainCameras(const RadiometryFit& fit, double max_sigma) {
  const Eigen::MatrixXd information = fit.Information();
  const std::vector<int>& unknown = fit.unknowns().camera;
  std::vector<bool> uncertain(unknown.size());
  for (size_t c = 0; c < unknown.size(); ++c)
    uncertain[c] = unknown[c] >= 0 && !(std::sqrt(information(unknown[c], unknown[c])) <= max_sigma);
  return uncertain;
}

// Judges stated gains by a fit with the exposures' own errors free, and holds those that it does not
// contradict. A contradicted one stays free, so that no photo is blamed for it.
void JudgeStatedGains(const PhotoEquations& shared, RadiometryCandidate chosen, FreeRadiometry& free,
                      SelfCalibration& result) {
  const std::vector<bool>& stated = free.open.gain_is_stated;
  if (std::find(stated.begin(), stated.end(), true) == stated.end()) return;
  chosen.gains = free.open.gains;
  RadiometryFit fit(shared, chosen, free);
  fit.Solve();
  const Eigen::MatrixXd covariance = fit.Covariance();
  for (size_t c = 0; c < free.camera_gain.size(); ++c) {
    if (!free.camera_gain[c] || !IsStated(free.open, c)) continue;
    const int at = fit.unknowns().camera[c];
    const double log_ratio = fit.x()[at], sigma = std::sqrt(covariance(at, at));
    free.camera_gain[c] = std::abs(log_ratio) > kContradiction * sigma;
    int& reference = result.camera_gains[c].reference;
    if (free.camera_gain[c])
      result.contradictions.push_back({static_cast<int>(c), reference, log_ratio, sigma});
    reference = static_cast<int>(c);
  }
}

// Decides whether cameras have gains of their own. `free` then says which ones.
void DecideCameraGains(PhotoEquations& shared, const SelfCalibrationOptions& options, FreeRadiometry& free,
                       SelfCalibration& result) {
  OpenRadiometry held = free.open;
  held.gains = false;
  std::vector<RadiometryCandidate> candidates = RadiometryCandidates(held, false, options.max_order);
  const size_t first_with = candidates.size();
  const std::vector<RadiometryCandidate> with = RadiometryCandidates(held, true, options.max_order);
  candidates.insert(candidates.end(), with.begin(), with.end());
  // The scatter of exposures is noise here. A photo that is off must not speak for a gain only because a fit
  // with one has more rounds to leave it out.
  FreeRadiometry settled = free;
  settled.least_rounds = kRadiometryRounds;
  const RadiometryComparison compared = CompareRadiometry(
      shared, settled, candidates, FullestRadiometry(held, true, options.max_order), options);
  const RadiometryCandidate& chosen = candidates[static_cast<size_t>(compared.chosen)];
  result.score_of_equal_cameras = result.score_of_camera_gains = std::numeric_limits<double>::infinity();
  for (const RadiometryCandidate& candidate : candidates) {
    double& best = candidate.camera_gains ? result.score_of_camera_gains : result.score_of_equal_cameras;
    if (candidate.is_determined) best = std::min(best, candidate.score);
  }
  if (chosen.camera_gains) {
    JudgeStatedGains(shared, chosen, free, result);
  } else {
    HoldCameras(UncertainCameras(compared.fits[first_with], options.max_camera_sigma), free, result);
  }
}

// Returns d (h + g) / dx, photos x unknowns. A stated gain is not corrected, whatever the fit says of it.
Eigen::MatrixXd GainsOfUnknowns(const RadiometryUnknowns& unknowns, const std::vector<PhotoSample>& samples,
                                const OpenRadiometry& open, Eigen::Index photos) {
  Eigen::MatrixXd gains = Eigen::MatrixXd::Zero(photos, unknowns.count);
  for (Eigen::Index p = 0; p < photos && unknowns.first_gain >= 0; ++p) gains(p, unknowns.first_gain + p) = 1;
  for (const PhotoSample& sample : samples) {
    const size_t camera = static_cast<size_t>(sample.camera);
    if (unknowns.camera[camera] >= 0 && !IsStated(open, camera))
      gains(sample.photo, unknowns.camera[camera]) = 1;
  }
  return gains;
}

void ReportCameras(const RadiometryUnknowns& unknowns, const Eigen::VectorXd& x,
                   const Eigen::MatrixXd& covariance, const OpenRadiometry& open, SelfCalibration& result) {
  for (size_t c = 0; c < unknowns.vignetting.size(); ++c) {
    const Eigen::Index camera = static_cast<Eigen::Index>(c);
    if (unknowns.vignetting[c] >= 0)
      result.vignetting.col(camera).head(unknowns.order) = x.segment(unknowns.vignetting[c], unknowns.order);
    if (unknowns.exponent[c] >= 0) result.exponent[camera] = x[unknowns.exponent[c]];
    const int at = unknowns.camera[c];
    if (at < 0 || IsStated(open, c)) continue;
    result.camera_gains[c].log_gain = x[at];
    result.camera_gains[c].sigma = std::sqrt(covariance(at, at));
  }
}

void ReportStates(const std::vector<PhotoSample>& samples, int states, double gain_sigma,
                  SelfCalibration& result) {
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(result.log_gain.size(), states);
  for (const PhotoSample& sample : samples) mean(sample.photo, sample.state) = 1;
  const Eigen::VectorXd all = mean.rowwise().sum().cwiseMin(1.0);
  for (int s = 0; s < states; ++s) {
    if (mean.col(s).sum() == 0) continue;
    const Eigen::VectorXd against = mean.col(s) / mean.col(s).sum() - all / all.sum();
    result.state_sigma[s] = std::sqrt(std::max(0.0, against.dot(result.covariance * against)));
    result.state_prior_sigma[s] = gain_sigma * against.norm();
  }
}

// Reports the chosen combination in the caller's terms.
void Report(const RadiometryFit& chosen, const std::vector<PhotoSample>& samples, int states,
            const FreeRadiometry& free, SelfCalibration& result) {
  const RadiometryUnknowns& unknowns = chosen.unknowns();
  const Eigen::MatrixXd covariance = chosen.Covariance();
  if (result.Chosen().order > 0) result.corner_sigma = chosen.CornerSigma(covariance);
  if (result.Chosen().exponent) result.exponent_sigma = chosen.ExponentSigma(covariance);
  ReportCameras(unknowns, chosen.x(), covariance, free.open, result);
  const Eigen::Index photos = result.log_gain.size();
  const Eigen::MatrixXd gains = GainsOfUnknowns(unknowns, samples, free.open, photos);
  // A factor common to all photos belongs to the camera's scale and is not an error of any photo.
  const Eigen::MatrixXd relative = Eigen::MatrixXd::Identity(photos, photos) -
                                   Eigen::MatrixXd::Constant(photos, photos, 1 / static_cast<double>(photos));
  result.covariance = relative * (gains * covariance * gains.transpose()) * relative.transpose();
  if (unknowns.first_gain < 0) return;
  result.log_gain = chosen.x().segment(unknowns.first_gain, photos);
  ReportStates(samples, states, free.gain_sigma, result);
}

}  // namespace

PhotoCorrection SelfCalibration::CorrectionOf(int photo, int camera) const {
  const auto coefficients = vignetting.col(camera);
  return {camera_gains[static_cast<size_t>(camera)].log_gain + log_gain[photo],
          {coefficients.begin(), coefficients.end()},
          exponent[camera]};
}

double SelfCalibration::CornerShare(int camera) const { return std::exp(vignetting.col(camera).sum()); }

double SelfCalibration::ResponsePower(int camera) const { return 1 / (1 + exponent[camera]); }

SelfCalibration SelfCalibrate(const Patches& patches, const std::vector<Eigen::VectorXd>& dimming,
                              const std::vector<PhotoSample>& samples, const OpenRadiometry& open,
                              const SelfCalibrationOptions& options) {
  ExpectInRange(patches, dimming, samples, open);
  FreeRadiometry free;
  free.open = open;
  free.gain_sigma = options.gain_sigma;
  for (const PhotoSample& sample : samples) free.photos = std::max(free.photos, sample.photo + 1);
  const Eigen::Index cameras = static_cast<Eigen::Index>(open.vignetting.size());
  const int states = static_cast<int>(dimming.size());
  SelfCalibration result;
  result.log_gain = Eigen::VectorXd::Zero(free.photos);
  result.vignetting = Eigen::MatrixXd::Zero(options.max_order, cameras);
  result.exponent = Eigen::VectorXd::Zero(cameras);
  result.covariance = Eigen::MatrixXd::Zero(free.photos, free.photos);
  result.state_sigma = result.state_prior_sigma = Eigen::VectorXd::Zero(states);
  const std::vector<PhotoSample> comparable = FreeTiedCameras(patches, samples, free, result);
  PhotoEquations equations(patches, dimming, comparable, options.max_elements);
  if (equations.elements() < kMinElements) {
    result.message = "fewer than " + std::to_string(kMinElements) + " surfaces are seen in several photos";
    HoldCameras(std::vector<bool>(free.camera_gain), free, result);
    result.candidates = RadiometryCandidates(open, false, options.max_order);
    return result;
  }
  if (IsAnyFree(free)) {
    PhotoEquations shared(patches, dimming, SamplesSeenBySeveral(comparable), options.max_elements);
    DecideCameraGains(shared, options, free, result);
  }
  const bool camera_gains = IsAnyFree(free);
  result.candidates = RadiometryCandidates(open, camera_gains, options.max_order);
  const RadiometryComparison compared = CompareRadiometry(
      equations, free, result.candidates, FullestRadiometry(open, camera_gains, options.max_order), options);
  for (size_t c = 0; c < compared.fits.size(); ++c) {
    const RadiometryCandidate& candidate = result.candidates[c];
    if (candidate.gains) continue;
    if (candidate.order == 1 && !candidate.exponent) result.corner_sigma = compared.corner_sigma[c];
    if (candidate.order == 0 && candidate.exponent) result.exponent_sigma = compared.exponent_sigma[c];
  }
  result.residual_sigma = compared.noise;
  result.chosen = compared.chosen;
  result.is_possible = true;
  Report(compared.fits[static_cast<size_t>(result.chosen)], samples, states, free, result);
  return result;
}

}  // namespace luxfit
