// Finds what photos contradict of what is said of them, and corrects them by what they say.
//
//   1. photos that show another state, are exchanged or encoded, are left out  inverse/observe/as_if/photos_as_if.h
//   2. a mistake in the table of states is found                               inverse/observe/as_if/states_as_if.h
//   3. exposures, vignetting and response are corrected by the states as they were: by a wrong table, right photos would be
//      blamed. States that still do not add up stand by themselves, and the correction is repeated
#ifndef LUXFIT_INVERSE_OBSERVE_AS_IF_INTERNAL_EXPLAINED_OBSERVATIONS_H_
#define LUXFIT_INVERSE_OBSERVE_AS_IF_INTERNAL_EXPLAINED_OBSERVATIONS_H_

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "inverse/observe/as_if/photos_as_if.h"
#include "inverse/observe/as_if/states_as_if.h"
#include "inverse/observe/observe.h"

namespace luxfit {

struct ExplainedObservations {
  std::vector<PhotoAsIf> photos_as_if;
  std::vector<StateExplanation> states_as_if;
  std::vector<Observation> observations;  // corrected, without the photos that are named
};

// Returns the observations corrected by the dimming of the states. The last call's counts.
using CorrectObservations = std::function<std::vector<Observation>(
    const std::vector<Eigen::VectorXd>& dimming, const std::vector<Observation>&)>;

// `observations`: of all photos, in one unit. `counted`: those whose counts are said to be proportional to light.
ExplainedObservations ExplainObservations(const Patches& patches, std::vector<Observation> observations,
                                          const StateTable& states, const CorrectObservations& correct,
                                          const CountedShares& counted = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_AS_IF_INTERNAL_EXPLAINED_OBSERVATIONS_H_
