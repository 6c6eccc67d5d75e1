// Describes the room of a report as a page draws it: cells with the light of each luminaire, luminaires,
// cameras, tags.
//
// Cells are those of apps/report/display_cells.h, at most 50 000. `total` holds the illuminance of every
// cell in lx, luminaire by luminaire, as 32-bit floats. `direct` holds the direct share of it, in steps of
// 1/65535.
#ifndef LUXFIT_APPS_REPORT_REPORT_ROOM_H_
#define LUXFIT_APPS_REPORT_REPORT_ROOM_H_

#include <nlohmann/json_fwd.hpp>

#include "apps/export/fitted_room.h"
#include "inverse/model/fit_uncertainty.h"

namespace luxfit {

nlohmann::json ReportRoomJson(const FittedRoom& fitted);

// Describes the luminaires: their geometry, and their luminous intensity (cd) over gamma in the planes
// C0-C180 and C90-C270 (gamma < 0: C180, C270). `given` is the curve of the photometric file with the flux
// that it states.
nlohmann::json ReportLuminairesJson(const FittedRoom& fitted, const FitUncertainty& fit);

// Describes the registered views: centre and the directions of the four corners of the image, in world.
nlohmann::json ReportCamerasJson(const FittedRoom& fitted);
nlohmann::json ReportTagsJson(const FittedRoom& fitted);

}  // namespace luxfit

#endif  // LUXFIT_APPS_REPORT_REPORT_ROOM_H_
