#include "inverse/advise/internal/asked_quantities.h"

#include <algorithm>
#include <cmath>

#include "inverse/advise/information.h"

namespace luxfit {
namespace {

// Returns the row that sums these parameters; those that the fit held do not vary.
Eigen::RowVectorXd SumOf(const PriorKnowledge& known, const std::vector<ParameterId>& ids) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(known.covariance.cols());
  for (size_t p = 0; p < known.parameters.size(); ++p) {
    if (std::count(ids.begin(), ids.end(), known.parameters[p].id()) > 0)
      row[static_cast<Eigen::Index>(p)] = 1;
  }
  return row;
}

}  // namespace

AskedQuantities::AskedQuantities(const PriorKnowledge& known, bool is_absolute, const AdviceOptions& options)
    : options_(options), rows_(0, known.covariance.cols()) {
  for (const Luminaire& luminaire : known.state.luminaires) {
    std::vector<ParameterId> flux{{ParameterKind::kLogFlux, luminaire.id}};
    if (!is_absolute) flux.push_back({ParameterKind::kLogMeterScale, ""});
    Add(known, {AdviceKind::kFlux, luminaire.id}, SumOf(known, flux));
    Eigen::MatrixXd position(3, known.covariance.cols());
    for (int axis = 0; axis < 3; ++axis)
      position.row(axis) =
          SumOf(known, {{ParameterKind::kLuminaire, luminaire.id, static_cast<LuminaireQuantity>(axis)}});
    Add(known, {AdviceKind::kPosition, luminaire.id}, position);
  }
}

void AskedQuantities::AddReading(const PriorKnowledge& known, const std::string& id,
                                 const Eigen::VectorXd& derivative) {
  if (derivative.size() > 0) Add(known, {AdviceKind::kReading, id}, derivative.transpose());
}

void AskedQuantities::Add(const PriorKnowledge& known, const AdviceQuantity& quantity,
                          const Eigen::MatrixXd& rows) {
  const bool is_asked = std::count(options_.kinds.begin(), options_.kinds.end(), quantity.kind) > 0 &&
                        (options_.owner.empty() || options_.owner == quantity.owner);
  if (!is_asked || rows.isZero()) return;
  bool is_determined = true;
  for (size_t p = 0; p < known.parameters.size(); ++p) {
    const bool concerns = !rows.col(static_cast<Eigen::Index>(p)).isZero();
    is_determined = is_determined && (known.is_determined[p] || !concerns);
  }
  quantities_.push_back(quantity);
  is_determined_.push_back(is_determined);
  row_counts_.push_back(rows.rows());
  rows_.conservativeResize(rows_.rows() + rows.rows(), Eigen::NoChange);
  rows_.bottomRows(rows.rows()) = rows;
}

std::vector<double> AskedQuantities::Sigmas(const Eigen::MatrixXd& root,
                                            const Eigen::MatrixXd& information) const {
  const Eigen::VectorXd variances = VariancesWith(root, rows_, information);
  std::vector<double> sigmas;
  Eigen::Index at = 0;
  for (const Eigen::Index count : row_counts_) {
    sigmas.push_back(std::sqrt(variances.segment(at, count).sum()));
    at += count;
  }
  return sigmas;
}

}  // namespace luxfit
