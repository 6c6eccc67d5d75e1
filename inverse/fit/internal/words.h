// Records in words what a fit decided and could not decide (inverse/fit/findings.h).
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_WORDS_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_WORDS_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "inverse/choose/colour_detail.h"
#include "inverse/choose/contradiction.h"
#include "inverse/choose/scene_detail.h"
#include "inverse/choose/several_starts.h"
#include "inverse/fit/fit_room.h"
#include "inverse/model/first_guess.h"

namespace luxfit {

// Where the fit of each luminaire that photos may show started from.
void RecordFirstGuess(const RoomObservations& given, const FirstGuess& guess,
                      const std::vector<SeenPlace>& seen, Findings& findings);
// Which start was kept, how many agree; warns ("starts_disagree") of another place that is as good.
void RecordStarts(const RoomObservations& given, const StartComparison& comparison, Findings& findings);
void RecordChoice(const RoomObservations& given, const LuminaireChoice& choice, Findings& findings);
// `start`: the aim it is held at where it is not estimated.
void RecordAim(const RoomObservations& given, const AimChoice& choice, const Eigen::Vector3d& start,
               Findings& findings);
void RecordRefinement(const RoomObservations& given, const Refinement& step, Findings& findings);
void RecordDirectShare(const DirectShare& share, Findings& findings);
void RecordOutcome(const RoomObservations& given, const LuminaireFit& fit, Findings& findings);
// Reflections, patches and elements; warns ("elements_too_coarse") where their size says more than the
// model's other errors.
void RecordDetail(const SceneDetail& detail, Findings& findings);
void RecordColours(const RoomObservations& given, const Room& room, const ColourDetail& colours,
                   Findings& findings);

// Which of several that are always on together is which, their light does not say. Luminaires that nobody
// named have no other name to be mistaken for.
void WarnOfInterchangeable(const RoomObservations& given, const std::vector<int>& group, Findings& findings);
void WarnOfContradiction(const RoomObservations& given, const Contradiction& found, Findings& findings);
// Of observations that the best fit does not explain: luminaires fitted beside them may be anywhere.
void WarnOfMisfit(const Room& room, const RoomFit& result, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_WORDS_H_
