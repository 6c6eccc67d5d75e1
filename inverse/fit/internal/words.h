// Records in words what a fit decided and what it could not decide (inverse/fit/fit_room.h).
//
// Each function appends to `findings`: Record... adds choices, and warnings where stated; Warn... adds
// warnings.
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_WORDS_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_WORDS_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "inverse/choose/internal/contradiction.h"
#include "inverse/choose/internal/detail/choose_bodies.h"
#include "inverse/choose/internal/detail/choose_colour.h"
#include "inverse/choose/internal/detail/colour_detail.h"
#include "inverse/choose/internal/detail/needless_parameters.h"
#include "inverse/choose/internal/luminaire_types.h"
#include "inverse/choose/internal/several_starts.h"
#include "inverse/fit/fit_room.h"
#include "inverse/fit/internal/judge/odd_luminaires.h"
#include "inverse/model/internal/search/first_guess.h"

namespace luxfit {

// Records where the fit of each luminaire that photos may show started.
void RecordFirstGuess(const RoomObservations& given, const FirstGuess& guess,
                      const std::vector<SeenPlace>& seen, Findings& findings);
// Records which start was kept and how many agree. Warns ("starts_disagree") of another place as good.
// `is_settled`: photos tell the place, or no other explains the light.
void RecordStarts(const RoomObservations& given, const StartComparison& comparison, bool is_settled,
                  Findings& findings);
void RecordChoice(const RoomObservations& given, const LuminaireChoice& choice, Findings& findings);
// `start`: the aim that is held where it is not estimated.
void RecordAim(const RoomObservations& given, const AimChoice& choice, const Eigen::Vector3d& start,
               Findings& findings);
// Records parameters that the whole fit does not tell from their simplest value.
void RecordNeedless(const RoomObservations& given, const std::vector<NeedlessParameter>& needless,
                    Findings& findings);
void RecordRefinement(const RoomObservations& given, const Refinement& step, Findings& findings);
void RecordDirectShare(const DirectShare& share, Findings& findings);
void RecordOutcome(const RoomObservations& given, const RoomFit& result, Findings& findings);
// Records whether light is exchanged in three channels.
void RecordTransportColour(const ColourChoice& choice, Findings& findings);
// Records when the luminaires' bodies hide what is behind them.
void RecordPlaces(const RoomObservations& given, const PlacesChoice& choice, Findings& findings);

// Records which luminaires are of one type.
void RecordTypes(const TypedState& typed, Findings& findings);
void WarnOfDeviatingFluxes(const LightState& state, const std::vector<LuminaireType>& types,
                           Findings& findings);
// Warns of luminaires that are unlike their fellows. What was asked for is then undetermined.
void WarnOfOddLuminaires(const LightState& state, const std::vector<OddLuminaire>& odd, Findings& findings);
void WarnOfOversizedLuminaires(const LightState& state, const std::vector<OversizedLuminaire>& oversized,
                               Findings& findings);

void RecordBodies(const BodyChoice& choice, Findings& findings);
void RecordColours(const RoomObservations& given, const Room& room, const ColourDetail& colours,
                   Findings& findings);

// Warns that luminaires which are always on together may have exchanged names: their light does not tell
// them apart. Luminaires that nobody named need no such warning.
void WarnOfInterchangeable(const RoomObservations& given, const std::vector<int>& group, Findings& findings);
void WarnOfContradiction(const RoomObservations& given, const Contradiction& found, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_WORDS_H_
