// Makes the rows of the table of degradations; the comments name the file of each.
#ifndef LUXFIT_APPS_STAGES_DEGRADE_DEGRADATION_ROWS_H_
#define LUXFIT_APPS_STAGES_DEGRADE_DEGRADATION_ROWS_H_

#include "apps/stages/degrade/degradation.h"

namespace luxfit {

// degrade_photos.cc
Degradation PixelNoise();
Degradation ExposureErrors();
Degradation ViewsDropped();
Degradation StatesDropped();
// degrade_survey.cc
Degradation TagsMoved();
// degrade_mesh.cc
Degradation FacesRemoved();
// degrade_light.cc: simulated
Degradation LuminairesTogether();
Degradation AlbedoRaised();

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_DEGRADE_DEGRADATION_ROWS_H_
