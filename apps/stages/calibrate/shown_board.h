// Checks that calibration images show the board that they should, before anything is calibrated from them.
#ifndef LUXFIT_APPS_STAGES_CALIBRATE_SHOWN_BOARD_H_
#define LUXFIT_APPS_STAGES_CALIBRATE_SHOWN_BOARD_H_

#include "apps/session/session.h"
#include "apps/stages/calibrate/calibration_images.h"

namespace luxfit {

// Looks at images without the board, twelve at most, where these are more than those with it. Throws std::runtime_error
// where most of them show another board: it names that board, as the user would give it.
void ExpectBoardShown(const Session& session, const CalibrationGroup& group);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_CALIBRATE_SHOWN_BOARD_H_
