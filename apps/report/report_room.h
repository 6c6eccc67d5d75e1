// The room of a report as a page draws it: cells with the light of each luminaire, luminaires, cameras, tags.
//
// Cells are those of forward/views/display_cells.h, at most 50 000. `total` holds lx of every cell, luminaire by
// luminaire, as 32-bit floats; `direct` the share of it that comes straight, in steps of 1/65535.
#ifndef LUXFIT_APPS_REPORT_REPORT_ROOM_H_
#define LUXFIT_APPS_REPORT_REPORT_ROOM_H_

#include <nlohmann/json_fwd.hpp>

#include "apps/export/fitted_room.h"

namespace luxfit {

constexpr int kMaxDisplayCells = 50'000;

nlohmann::json ReportRoomJson(const FittedRoom& fitted, int max_cells = kMaxDisplayCells);

// Where the luminaires hang, how they shine: geometry, and luminous intensity over gamma in the planes
// C0-C180 and C90-C270 (gamma < 0: C180, C270), cd; `given`: of the photometric file as it states its flux.
nlohmann::json ReportLuminairesJson(const FittedRoom& fitted);

// Registered views: centre and the directions of the four corners of the image, in world.
nlohmann::json ReportCamerasJson(const FittedRoom& fitted);
nlohmann::json ReportTagsJson(const FittedRoom& fitted);

}  // namespace luxfit

#endif  // LUXFIT_APPS_REPORT_REPORT_ROOM_H_
