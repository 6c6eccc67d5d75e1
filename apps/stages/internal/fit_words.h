// What a fit decided and could not decide, in words: `choices` and `warnings` of result.json.
#ifndef LUXFIT_APPS_STAGES_INTERNAL_FIT_WORDS_H_
#define LUXFIT_APPS_STAGES_INTERNAL_FIT_WORDS_H_

#include <Eigen/Core>
#include <vector>

#include "apps/stages/stages.h"
#include "inverse/choose/colour_detail.h"
#include "inverse/choose/contradiction.h"
#include "inverse/choose/scene_detail.h"
#include "inverse/choose/several_starts.h"
#include "inverse/model/first_guess.h"

namespace luxfit {

// Where the fit of each luminaire that photos may show started from.
void RecordFirstGuess(const Session& session, const FirstGuess& guess, const std::vector<SeenPlace>& seen,
                      RunContext& context);
// Which start was kept, how many agree; warns ("starts_disagree") of another place that is as good.
void RecordStarts(const Session& session, const StartComparison& comparison, RunContext& context);
void RecordChoice(const Session& session, const LuminaireChoice& choice, RunContext& context);
// `start`: the aim it is held at where it is not estimated.
void RecordAim(const Session& session, const AimChoice& choice, const Eigen::Vector3d& start,
               RunContext& context);
void RecordRefinement(const Session& session, const Refinement& step, RunContext& context);
void RecordDirectShare(const DirectShare& share, RunContext& context);
void RecordOutcome(const Session& session, const LuminaireFit& fit, RunContext& context);
// Reflections, patches and elements; warns ("elements_too_coarse") where their size says more than the
// model's other errors.
void RecordDetail(const SceneDetail& detail, RunContext& context);
void RecordColours(const Session& session, const Room& room, const ColourDetail& colours,
                   RunContext& context);

// Which of several that are always on together is which, their light does not say. Luminaires that nobody
// named have no other name to be mistaken for.
void WarnOfInterchangeable(const Session& session, const std::vector<int>& group, RunContext& context);
void WarnOfContradiction(const Session& session, const Contradiction& found, RunContext& context);
// Of observations that the best fit does not explain: luminaires fitted beside them may be anywhere.
void WarnOfMisfit(const Room& room, const SessionFit& result, RunContext& context);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_INTERNAL_FIT_WORDS_H_
