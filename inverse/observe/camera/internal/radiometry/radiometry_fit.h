// Fits combinations of free radiometric parameters to samples of photos, and scores them on data left out.
//
//   x -> x + (N + P)^-1 (J'W z - P x)      N, J, W, z: inverse/observe/camera/internal/radiometry/photo_equations.h, P: prior
//
// Each fold of patches is left out in turn and scored with the step that the other folds ask for. Residuals
// of one facet are not independent: the covariance sums their gradients before it squares them.
//
// Source: inverse/observe/camera/self_calibration.h.
#ifndef LUXFIT_INVERSE_OBSERVE_CAMERA_INTERNAL_RADIOMETRY_RADIOMETRY_FIT_H_
#define LUXFIT_INVERSE_OBSERVE_CAMERA_INTERNAL_RADIOMETRY_RADIOMETRY_FIT_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/observe/camera/internal/radiometry/photo_equations.h"
#include "inverse/observe/camera/self_calibration.h"

namespace luxfit {

constexpr int kRadiometryRounds = 12;  // at most

// Says what may be free.
struct FreeRadiometry {
  OpenRadiometry open;
  std::vector<bool> camera_gain;  // one for each camera
  int photos = 0;
  double gain_sigma = 0.05;  // prior, of ln exposure
  int least_rounds = 3;  // a fit of no unknowns takes no steps: only more rounds settle its robust weights
};

class RadiometryFit {
 public:
  // Keeps a reference to `equations`. Sets what.parameters.
  RadiometryFit(const PhotoEquations& equations, RadiometryCandidate& what, const FreeRadiometry& free);

  void Solve();
  GroupScores Score() const;

  double sigma() const { return fit_.sigma; }
  const RadiometryUnknowns& unknowns() const { return unknowns_; }
  const Eigen::VectorXd& x() const { return fit_.x; }

  Eigen::MatrixXd Covariance() const;
  // Returns the inverse curvature alone: it tells whether the samples determine a parameter at all.
  Eigen::MatrixXd Information() const;
  // Return the largest sigma of any camera, from a covariance of the unknowns.
  double CornerSigma(const Eigen::MatrixXd& covariance) const;
  double ExponentSigma(const Eigen::MatrixXd& covariance) const;
  double CameraSigma(const Eigen::MatrixXd& covariance) const;
  bool IsAtBound() const;

 private:
  PhotoEquations::Sums Total(int without) const;
  Eigen::VectorXd Bounded(Eigen::VectorXd x) const;
  Eigen::MatrixXd PriorCurvature() const;
  Eigen::VectorXd StepWithout(int fold) const;

  const PhotoEquations& equations_;
  int photos_;
  double gain_sigma_;
  int least_rounds_;
  RadiometryUnknowns unknowns_;
  PhotoEquations::Fit fit_;
  std::vector<PhotoEquations::Sums> by_fold_;
  Eigen::MatrixXd curvature_;
};

// Lists the combinations of photos' gains, orders of vignetting and an exponent, all with cameras' gains or
// all without.
std::vector<RadiometryCandidate> RadiometryCandidates(const OpenRadiometry& open, bool camera_gains,
                                                      int max_order);

struct RadiometryComparison {
  std::vector<RadiometryFit> fits;                   // one for each candidate
  std::vector<double> corner_sigma, exponent_sigma;  // by the curvature alone, one for each candidate
  double noise = 0;                                  // robust sigma that the fullest candidates leave
  int chosen = 0;
};

// Fits and scores all candidates, completes them, and chooses. All are scored with the noise that `fullest`
// leave, with or without an exponent, whichever is smaller. It becomes the common sigma of `equations`.
RadiometryComparison CompareRadiometry(PhotoEquations& equations, const FreeRadiometry& free,
                                       std::vector<RadiometryCandidate>& candidates,
                                       std::vector<RadiometryCandidate> fullest,
                                       const SelfCalibrationOptions& options);

// Returns the candidates that have everything free, without and with an exponent.
std::vector<RadiometryCandidate> FullestRadiometry(const OpenRadiometry& open, bool camera_gains,
                                                   int max_order);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_CAMERA_INTERNAL_RADIOMETRY_RADIOMETRY_FIT_H_
