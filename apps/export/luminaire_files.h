// Writes OUT/luminaires/ID.ies and ID.ldt: fitted luminaires as lighting programs load them.
//
// Files are written for luminaires whose flux is in lm and whose flux, distribution and size the data
// determine. A flux at its bound is not determined. For other luminaires no file remains, not even one of an
// earlier run.
#ifndef LUXFIT_APPS_EXPORT_LUMINAIRE_FILES_H_
#define LUXFIT_APPS_EXPORT_LUMINAIRE_FILES_H_

#include "apps/stages/stages.h"

namespace luxfit {

// Returns the paths by luminaire, relative to OUT; empty names where none were written.
std::vector<LuminaireFiles> WriteLuminaireFiles(const Session& session, const RoomFit& fit,
                                                const RunContext& context);

}  // namespace luxfit

#endif  // LUXFIT_APPS_EXPORT_LUMINAIRE_FILES_H_
