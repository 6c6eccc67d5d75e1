// Reads what a session gives of one luminaire, and its photometric file.
//
// A value that neither gives keeps a default without meaning: flux 0, size 0, position at the origin,
// straight down.
//
// Throws std::runtime_error("FILE:LINE: ...") where the photometric file cannot be read.
#ifndef LUXFIT_APPS_STAGES_GIVEN_LUMINAIRE_H_
#define LUXFIT_APPS_STAGES_GIVEN_LUMINAIRE_H_

#include <optional>

#include "apps/session/session.h"
#include "forward/luminaire/photometry_file.h"

namespace luxfit {

struct GivenLuminaire {
  Luminaire luminaire;  // shape, size and flux are the session's, else the file's
  // Where the session names one. Its light_notes are those on what the session does not give itself.
  std::optional<PhotometryFile> file;
};
GivenLuminaire ReadGivenLuminaire(const SessionLuminaire& given);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_GIVEN_LUMINAIRE_H_
