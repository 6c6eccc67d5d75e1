// Reads the section [calibration] of a session: how cameras without intrinsics are calibrated.
//
// Throws std::runtime_error("FILE:LINE: calibration.key: ...").
//
// Source: docs/session-format.md.
#ifndef LUXFIT_APPS_SESSION_INTERNAL_SESSION_CALIBRATION_H_
#define LUXFIT_APPS_SESSION_INTERNAL_SESSION_CALIBRATION_H_

#include "apps/session/session.h"
#include "apps/text/formats/toml_reader.h"

namespace luxfit {

SessionCalibration ReadCalibrationSection(const TomlCursor& section);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_INTERNAL_SESSION_CALIBRATION_H_
