// Reads a room that [scene] describes without a mesh: size, or outline and height, boxes and openings.
//
// Lengths of the file are in `unit`; those of the result in m. Throws std::runtime_error("FILE:LINE: key:
// ...") for what is missing or malformed, and for a room that cannot be (FindFault in forward/mesh/outline.h).
#ifndef LUXFIT_APPS_SESSION_INTERNAL_SESSION_OUTLINE_H_
#define LUXFIT_APPS_SESSION_INTERNAL_SESSION_OUTLINE_H_

#include <optional>

#include "apps/text/formats/toml_reader.h"
#include "forward/mesh/outline.h"

namespace luxfit {

// Returns nothing where the section names a mesh. It has exactly one of mesh, size and outline.
std::optional<RoomOutline> ReadOutline(const TomlCursor& section, double metres_per_unit);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_INTERNAL_SESSION_OUTLINE_H_
