// Reads the list [[camera]] of a session.
//
// Throws std::runtime_error("FILE:LINE: camera[i].key: ...") for malformed values, ids that two cameras
// share, and values of the format that this version does not support.
//
// Source: docs/session-format.md.
#ifndef LUXFIT_APPS_SESSION_INTERNAL_SESSION_CAMERA_H_
#define LUXFIT_APPS_SESSION_INTERNAL_SESSION_CAMERA_H_

#include <string>
#include <vector>

#include "apps/session/session.h"
#include "apps/text/formats/toml_reader.h"

namespace luxfit {

// Describes the values that `intrinsics` may have, for messages.
std::string ExpectedIntrinsics();

std::vector<SessionCamera> ReadCameras(const TomlCursor& list, const std::string& folder);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_INTERNAL_SESSION_CAMERA_H_
