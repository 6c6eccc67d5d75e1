// Reads the sections [scene], [tags] and [registration] of a session, and makes the room that [scene] says.
//
// Each function takes its section and the session's folder, and throws std::runtime_error("FILE:LINE: key:
// ...").
//
// Source: docs/session-format.md.
#ifndef LUXFIT_APPS_SESSION_SESSION_SCENE_H_
#define LUXFIT_APPS_SESSION_SESSION_SCENE_H_

#include <string>

#include "apps/session/session.h"
#include "apps/text/formats/toml_reader.h"
#include "forward/room/scene.h"

namespace luxfit {

// Returns the metres of a unit: m, cm, mm, in or ft. Throws std::runtime_error("KEY: expected one of ...") for other names.
double MetresPerUnit(const std::string& unit, const std::string& key);

SessionScene ReadSceneSection(const TomlCursor& section, const std::string& folder);

// Returns the room: its mesh, read, or its outline, made; with what photos showed of its furniture. m, world frame.
Scene SceneOf(const SessionScene& scene);

// Names the room for people: the path of its mesh, or what its outline consists of.
std::string RoomText(const SessionScene& scene);

// Returns the scene of a mesh file, or that of a session file (.toml), whose [scene] has its own unit.
Scene SceneOfFile(const std::string& path, double metres_per_unit);

SessionTags ReadTagsSection(const TomlCursor& section, const std::string& folder);

SessionRegistration ReadRegistrationSection(const TomlCursor& section, const std::string& folder);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_SESSION_SCENE_H_
