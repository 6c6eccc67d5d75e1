// Predicts an observation of photometric stereo with its derivatives, and orders the shared unknowns.
//
// The order of the shared unknowns is: the curve's parameters, two tangent components of every free
// direction, and the logarithm of every strength where strengths are free.
#ifndef LUXFIT_INVERSE_ALBEDO_INTERNAL_STEREO_TERMS_H_
#define LUXFIT_INVERSE_ALBEDO_INTERNAL_STEREO_TERMS_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/albedo/internal/stereo_adjustment.h"
#include "inverse/model/internal/condensed_problem.h"

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

// Unknowns x are steps from the state: of the curve's parameters, along the tangents of a direction, and of
// the logarithm of a strength.
class SharedUnknowns {
 public:
  SharedUnknowns(const StereoProblem& problem, const StereoState& state);

  Eigen::Index count() const { return count_; }
  // Bounds of x: the curve's own, and what is too far for one linearization.
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }
  StereoState Applied(StereoState state, const Eigen::VectorXd& x) const;
  // Returns the same unknowns, with slopes as they are at x.
  SharedUnknowns At(const Eigen::VectorXd& x) const;
  // Returns the unit direction that nothing determines: the common factor of all strengths. 0: there is none.
  const Eigen::VectorXd& held() const { return held_; }
  // Adds the directions' priors at x, and a prior that keeps x from going along held().
  void AddPriors(const Eigen::VectorXd& x, NormalEquations& equations) const;

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
  void SetBounds(const ReflectanceCurve& curve);

  Eigen::Index count_ = 0, curve_count_ = 0, strength_at_ = -1;
  std::vector<Eigen::Index> direction_at_;             // one for each image, -1: held
  std::vector<Eigen::Vector3d> directions_;            // of the state, where free
  std::vector<Eigen::Matrix<double, 3, 2>> tangents_;  // derivatives of the direction by its steps
  double held_weight_ = 0;
  Eigen::VectorXd held_;
  Eigen::VectorXd lower_, upper_, prior_weight_, prior_x_;  // prior: weight (x - prior_x)^2
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ALBEDO_INTERNAL_STEREO_TERMS_H_
