// Reads how well an earlier fit knows what it found (inverse/model/fit_uncertainty.h) from OUT/stages/fit.json.
//
// Throws std::runtime_error naming the file where it is missing or of another kind.
#ifndef LUXFIT_APPS_EXPORT_FIT_UNCERTAINTY_H_
#define LUXFIT_APPS_EXPORT_FIT_UNCERTAINTY_H_

#include <string>

#include "apps/export/fitted_room.h"
#include "inverse/control/lux_map.h"
#include "inverse/model/fit_uncertainty.h"

namespace luxfit {

// Reads the uncertainty of the run that wrote into this folder.
FitUncertainty ReadFitUncertainty(const std::string& out);

// Returns the room's reflectances. Those that result.json leaves out are not known.
FittedSurfaces SurfacesOf(const FittedRoom& fitted);

}  // namespace luxfit

#endif  // LUXFIT_APPS_EXPORT_FIT_UNCERTAINTY_H_
