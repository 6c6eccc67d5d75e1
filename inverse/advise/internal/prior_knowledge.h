// Holds what a fit knows of the parameters of its room, for advice: each undetermined one is unknown by itself.
#ifndef LUXFIT_INVERSE_ADVISE_INTERNAL_PRIOR_KNOWLEDGE_H_
#define LUXFIT_INVERSE_ADVISE_INTERNAL_PRIOR_KNOWLEDGE_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/advise/advise.h"
#include "inverse/model/light_state.h"

namespace luxfit {

struct PriorKnowledge {
  LightState state;
  std::vector<Parameter> parameters;
  std::vector<bool> is_determined;  // by parameter
  Eigen::MatrixXd covariance;
  std::vector<ParameterId> ignored;
};
PriorKnowledge KnowledgeOf(const Room& room, const AdviceGiven& given);

// Returns whether a sigma is that of something known: clearly less than what is assumed of the unknown.
inline bool IsKnownSigma(double sigma) { return sigma < 0.3; }

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ADVISE_INTERNAL_PRIOR_KNOWLEDGE_H_
