// OUT/luminaires/ID.ies and ID.ldt: fitted luminaires as lighting programs load them.
//
// Written for luminaires whose flux is in lm and whose flux, distribution and size the data determine
// (a flux at its bound is not); of the others nothing is left there, not even of an earlier run.
#ifndef LUXFIT_APPS_EXPORT_LUMINAIRE_FILES_H_
#define LUXFIT_APPS_EXPORT_LUMINAIRE_FILES_H_

#include "apps/stages/stages.h"

namespace luxfit {

// By luminaire, relative to OUT; empty names where none were written.
std::vector<LuminaireFiles> WriteLuminaireFiles(const Session& session, const RoomFit& fit,
                                                const RunContext& context);

}  // namespace luxfit

#endif  // LUXFIT_APPS_EXPORT_LUMINAIRE_FILES_H_
