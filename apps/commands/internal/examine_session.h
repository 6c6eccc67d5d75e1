// Finds what a session lacks without fitting it: mesh, calibration images, photos, tags, states, readings.
//
// Looks for the board in every calibration image, as `luxfit calibrate` does, and says how many show it.
// Looks at every photo once, for its size, depth and exposure, and at one photo of each view for tags. Where they can be
// used, the stages of `luxfit run` before the fit are run (scene, linearize, register, without COLMAP), and what they
// warn of or refuse is found in their words.
#ifndef LUXFIT_APPS_COMMANDS_INTERNAL_EXAMINE_SESSION_H_
#define LUXFIT_APPS_COMMANDS_INTERNAL_EXAMINE_SESSION_H_

#include <vector>

#include "apps/commands/doctor_command.h"
#include "apps/session/session.h"

namespace luxfit {

std::vector<DoctorFinding> ExamineSession(const Session& session);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_INTERNAL_EXAMINE_SESSION_H_
