// Predicts an observation of photometric stereo with its derivatives, and orders the shared unknowns.
//
// The order of the shared unknowns is: the curve's parameters, two tangent components of every free
// direction, and the logarithm of every strength where strengths are free.
#ifndef LUXFIT_INVERSE_ALBEDO_INTERNAL_STEREO_TERMS_H_
#define LUXFIT_INVERSE_ALBEDO_INTERNAL_STEREO_TERMS_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/albedo/internal/stereo_adjustment.h"

namespace luxfit {

struct StereoTerm {
  double value = 0;
  Eigen::Vector3d d_b = Eigen::Vector3d::Zero();
  Eigen::Vector3d d_light = Eigen::Vector3d::Zero();  // by the direction, as if it were free in space
  Eigen::Vector3d d_curve = Eigen::Vector3d::Zero();  // by the curve's parameters
  double d_log_strength = 0;
};

class StereoPixel {
 public:
  StereoPixel(const StereoState& state, Eigen::Index pixel);
  StereoTerm Term(Eigen::Index image, bool with_slopes = true) const;

 private:
  const StereoState& state_;
  double albedo_;
  Eigen::Vector3d normal_;
};

class SharedUnknowns {
 public:
  SharedUnknowns(const StereoProblem& problem, const StereoState& state);

  Eigen::Index count() const { return count_; }
  // The weights of the priors, and the state's deviation from them, in the order of the unknowns.
  const Eigen::VectorXd& PriorWeights() const { return prior_weights_; }
  const Eigen::VectorXd& PriorDeviation() const { return prior_deviation_; }
  // Returns unit directions that nothing determines and that are held: the common factor of all strengths.
  std::vector<Eigen::VectorXd> HeldDirections() const;
  StereoState Applied(StereoState state, const Eigen::VectorXd& step) const;

  // Calls add(index, slope) for every shared unknown that an observation of `image` depends on.
  template <typename Add>
  void Row(const StereoTerm& term, Eigen::Index image, const Add& add) const {
    for (Eigen::Index p = 0; p < curve_count_; ++p) add(p, term.d_curve[p]);
    const Eigen::Index direction = direction_at_[static_cast<size_t>(image)];
    if (direction >= 0) {
      add(direction, tangents_[static_cast<size_t>(image)].col(0).dot(term.d_light));
      add(direction + 1, tangents_[static_cast<size_t>(image)].col(1).dot(term.d_light));
    }
    if (strength_at_ >= 0) add(strength_at_ + image, term.d_log_strength);
  }

 private:
  Eigen::Index count_ = 0, curve_count_ = 0, strength_at_ = -1;
  std::vector<Eigen::Index> direction_at_;  // one for each image, -1: held
  std::vector<Eigen::Matrix<double, 3, 2>> tangents_;
  Eigen::VectorXd prior_weights_, prior_deviation_;
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ALBEDO_INTERNAL_STEREO_TERMS_H_
