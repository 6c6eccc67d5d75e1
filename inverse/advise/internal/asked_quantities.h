// Holds the quantities whose sigmas are asked for, as sums of parameters.
#ifndef LUXFIT_INVERSE_ADVISE_INTERNAL_ASKED_QUANTITIES_H_
#define LUXFIT_INVERSE_ADVISE_INTERNAL_ASKED_QUANTITIES_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/advise/advise.h"
#include "inverse/advise/internal/prior_knowledge.h"

namespace luxfit {

class AskedQuantities {
 public:
  // Adds what `options` asks for of the luminaires; fluxes and positions that the fit held are none.
  AskedQuantities(const PriorKnowledge& known, bool is_absolute, const AdviceOptions& options);
  // Adds a predicted reading where it is asked for. `derivative`: of its logarithm.
  void AddReading(const PriorKnowledge& known, const std::string& id, const Eigen::VectorXd& derivative);

  size_t size() const { return quantities_.size(); }
  const AdviceQuantity& Of(size_t quantity) const { return quantities_[quantity]; }
  bool IsDetermined(size_t quantity) const { return is_determined_[quantity]; }
  // Returns the sigma of each, where C = root root^T and `information` is added to it.
  std::vector<double> Sigmas(const Eigen::MatrixXd& root, const Eigen::MatrixXd& information) const;

 private:
  // Each row is a sum of parameters; the variances of all are summed.
  void Add(const PriorKnowledge& known, const AdviceQuantity& quantity, const Eigen::MatrixXd& rows);

  AdviceOptions options_;
  std::vector<AdviceQuantity> quantities_;
  std::vector<bool> is_determined_;
  std::vector<Eigen::Index> row_counts_;
  Eigen::MatrixXd rows_;  // of all, in their order
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ADVISE_INTERNAL_ASKED_QUANTITIES_H_
