// Takes explanations of a session's mistakes as corrections of it: `luxfit run --apply`.
//
//   mesh_as_if       the mesh is moved
//   photos_as_if     photos that were exchanged change their states
//   states_as_if     [states] is read as the photos have it
//   readings_as_if   the table of readings is read as the fitted light has it
//
// An explanation is taken where no other explains the data equally, and where it says what is right. Each part of a session is
// corrected once, readings only by a light that nothing else leaves in doubt. What was taken is said as a choice with its evidence, and as the warning session_corrected.
#ifndef LUXFIT_APPS_STAGES_CHECK_APPLIED_EXPLANATIONS_H_
#define LUXFIT_APPS_STAGES_CHECK_APPLIED_EXPLANATIONS_H_

#include <vector>

#include "apps/session/session_corrections.h"
#include "apps/stages/prepared_session.h"

namespace luxfit {

struct AppliedExplanations {
  SessionCorrections corrections;
  Findings findings;
};

// Return whether something was taken, so that the session is to be prepared again. `prepared`, `room`, `fit`: of the session
// with the corrections so far.
bool TakeFromPhotos(const PreparedSession& prepared, AppliedExplanations& applied);
bool TakeFromReadings(const PreparedSession& prepared, const Session& fitted, const RoomFit& fit,
                      AppliedExplanations& applied);

// Adds the corrections to the inputs of the stages that depend on them.
SessionInputs WithCorrections(SessionInputs inputs, const SessionCorrections& corrections);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_CHECK_APPLIED_EXPLANATIONS_H_
