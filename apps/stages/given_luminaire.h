// What a session says of one luminaire, its photometric file read.
//
// What neither says keeps a default that means nothing: flux 0, size 0, position at the origin, straight
// down.
//
// Throws std::runtime_error("FILE:LINE: ...") where the photometric file cannot be read.
#ifndef LUXFIT_APPS_STAGES_GIVEN_LUMINAIRE_H_
#define LUXFIT_APPS_STAGES_GIVEN_LUMINAIRE_H_

#include <optional>

#include "apps/session/session.h"
#include "forward/luminaire/photometry_file.h"

namespace luxfit {

struct GivenLuminaire {
  Luminaire luminaire;                 // shape, size and flux: the session's, else the file's
  std::optional<PhotometryFile> file;  // where one was named
};
GivenLuminaire ReadGivenLuminaire(const SessionLuminaire& given);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_GIVEN_LUMINAIRE_H_
