#include "inverse/advise/internal/prior_knowledge.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "inverse/model/internal/intervals/known_parameters.h"

namespace luxfit {
namespace {

// In the parameter's own unit: m, or a logarithm's.
double UnknownSigma(const ParameterId& id) { return id.kind == ParameterKind::kAlbedo ? 0.3 : 1; }

// Returns the fit's covariance with the scale between relative fluxes and lumens, which is the meter's.
FitUncertainty WithScale(FitUncertainty fit) {
  const Eigen::Index count = fit.covariance.rows();
  fit.parameters.push_back({ParameterKind::kLogMeterScale, ""});
  fit.is_determined.push_back(false);
  fit.covariance.conservativeResize(count + 1, count + 1);
  fit.covariance.row(count).setZero();
  fit.covariance.col(count).setZero();
  return fit;
}

void ForgetUndetermined(const std::vector<ParameterId>& parameters, const std::vector<bool>& is_determined,
                        Eigen::MatrixXd& covariance) {
  for (size_t p = 0; p < parameters.size(); ++p) {
    if (is_determined[p]) continue;
    const auto at = static_cast<Eigen::Index>(p);
    covariance.row(at).setZero();
    covariance.col(at).setZero();
    covariance(at, at) = UnknownSigma(parameters[p]) * UnknownSigma(parameters[p]);
  }
}

}  // namespace

PriorKnowledge KnowledgeOf(const Room& room, const AdviceGiven& given) {
  const auto count = static_cast<Eigen::Index>(given.fit.parameters.size());
  if (room.sparse) throw std::invalid_argument("Advise: expected a room whose transport has derivatives");
  if (count == 0 || given.fit.covariance.rows() != count || given.fit.covariance.cols() != count)
    throw std::invalid_argument("Advise: expected a covariance of as many rows as parameters");
  FitUncertainty fit = given.is_absolute ? given.fit : WithScale(given.fit);
  ForgetUndetermined(fit.parameters, fit.is_determined, fit.covariance);
  PriorKnowledge known;
  known.state = AllFree(room, given.luminaires, given.albedo);
  known.state.camera_scale = given.camera_scale;
  known.state.camera_scale_free = known.state.meter_scale_free = true;
  KnownParameters found = FindKnown(FreeParameters(room, known.state), fit);
  known.parameters = std::move(found.parameters);
  known.covariance = std::move(found.covariance);
  known.ignored = std::move(found.left_out);
  const std::vector<ParameterId> undetermined = fit.Undetermined();
  for (const Parameter& p : known.parameters)
    known.is_determined.push_back(std::count(undetermined.begin(), undetermined.end(), p.id()) == 0);
  return known;
}

}  // namespace luxfit
