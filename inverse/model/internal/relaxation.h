// Relaxes rounds of a fit whose steps lead back on one another.
//
// Each round weighs the rows anew and then solves. Weights follow the solution, so that rounds may go to and fro between two
// states, or round several, for ever. From the first step on that leads back on the last one, half of each step is taken,
// from the next such step a quarter, then an eighth: the states in between settle.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_RELAXATION_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_RELAXATION_H_

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace luxfit {

class Relaxation {
 public:
  // Compares what a step and the last one do to the weighted rows. One leads back where their cosine is below -0.5.
  void Compare(const Eigen::VectorXd& step, const Eigen::VectorXd& last) {
    constexpr double kOpposite = -0.5, kLeastShare = 0.125;
    if (step.dot(last) < kOpposite * step.norm() * last.norm()) share_ = std::max(kLeastShare, 0.5 * share_);
  }

  bool IsPartial() const { return share_ < 1; }

  // Returns where a step that ends at `end` is left.
  Eigen::VectorXd PartOf(const Eigen::VectorXd& step, const Eigen::VectorXd& end) const {
    return end - (1 - share_) * step;
  }
  // Returns the value, above 0, that takes the place of `last` where `next` was estimated.
  double Between(double last, double next) const {
    return IsPartial() ? last * std::pow(next / last, share_) : next;
  }

 private:
  double share_ = 1;
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_RELAXATION_H_
