// Finds the posterior of the labels of one element's views (inverse/observe/surface_labels.h).
#ifndef LUXFIT_INVERSE_OBSERVE_INTERNAL_LABEL_POSTERIOR_H_
#define LUXFIT_INVERSE_OBSERVE_INTERNAL_LABEL_POSTERIOR_H_

#include <Eigen/Core>

namespace luxfit {

struct LabelPosterior {
  Eigen::VectorXd own;    // by view: probability that it shows the element
  Eigen::MatrixXd other;  // (a, b): probability that a shows the element and b does not
};

// `log_own`, `log_other`: ln N_ab and ln M_ab, views x views. `prior`: p by view, strictly between 0 and 1.
LabelPosterior PosteriorOf(const Eigen::MatrixXd& log_own, const Eigen::MatrixXd& log_other,
                           const Eigen::VectorXd& prior);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_INTERNAL_LABEL_POSTERIOR_H_
