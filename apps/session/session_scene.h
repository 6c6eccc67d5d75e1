// Reads the sections [scene], [tags] and [registration] of a session.
//
// Each function takes its section and the session's folder, and throws std::runtime_error("FILE:LINE: key:
// ...").
//
// Source: docs/session-format.md.
#ifndef LUXFIT_APPS_SESSION_SESSION_SCENE_H_
#define LUXFIT_APPS_SESSION_SESSION_SCENE_H_

#include <map>
#include <string>

#include "apps/session/session.h"
#include "apps/text/formats/toml_reader.h"

namespace luxfit {

// m, cm, mm, in, ft.
const std::map<std::string, double>& MetresPerUnit();

SessionScene ReadSceneSection(const TomlCursor& section, const std::string& folder);

SessionTags ReadTagsSection(const TomlCursor& section, const std::string& folder);

SessionRegistration ReadRegistrationSection(const TomlCursor& section, const std::string& folder);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_SESSION_SCENE_H_
