// Reads the photos of a session: the table that [photos] names.
//
//   file,camera,view,state,exposure_s[,aperture,iso]
//
// Rows of one view, state and camera are an exposure bracket and differ in exposure. A view has one camera.
// Exposure time, aperture (f-number) and ISO may be empty where the photo's own metadata state them.
//
// Throws std::runtime_error("FILE:LINE: column: ...") for a missing photo, an unknown camera or state, an
// exposure that is not > 0 s, and a photo given twice.
//
// Source: docs/session-format.md, [photos].
#ifndef LUXFIT_APPS_SESSION_INTERNAL_SESSION_PHOTOS_H_
#define LUXFIT_APPS_SESSION_INTERNAL_SESSION_PHOTOS_H_

#include <string>
#include <vector>

#include "apps/session/session.h"
#include "apps/text/formats/csv_table.h"
#include "apps/text/formats/toml_reader.h"

namespace luxfit {

CsvTable ReadPhotoTable(const TomlCursor& section, const std::string& folder);

// `folder` is that of the session; photos are named relative to it.
std::vector<SessionPhoto> PhotosOf(const CsvTable& table, const std::string& folder,
                                   const std::vector<SessionCamera>& cameras,
                                   const std::vector<SessionState>& states);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_INTERNAL_SESSION_PHOTOS_H_
