#include "inverse/observe/as_if/internal/explained_observations.h"

#include <optional>
#include <utility>

#include "inverse/observe/as_if/internal/srgb_observations.h"
#include "inverse/observe/evidence.h"

namespace luxfit {

ExplainedObservations ExplainObservations(const Patches& patches, std::vector<Observation> observations,
                                          const StateTable& states, const CorrectObservations& correct,
                                          const CountedShares& counted) {
  ExplainedObservations explained;
  explained.photos_as_if = FindPhotosAsIf(patches, observations, counted);
  observations = WithoutPhotos(observations, explained.photos_as_if);
  const bool has_table = !states.luminaires.empty();
  if (has_table) {
    const std::vector<Observation> decoded =
        counted.empty() ? std::vector<Observation>() : DecodedSrgb(observations, counted);
    explained.states_as_if = FindStatesAsIf(patches, observations, states, decoded);
  }
  explained.observations = correct(DimmingSeen(states, explained.states_as_if), observations);
  if (!has_table || !explained.states_as_if.empty()) return explained;
  std::optional<StateExplanation> alone = StatesByThemselves(patches, explained.observations, states);
  if (!alone) return explained;
  explained.states_as_if.push_back(*std::move(alone));
  explained.observations = correct(DimmingSeen(states, explained.states_as_if), observations);
  return explained;
}

}  // namespace luxfit
