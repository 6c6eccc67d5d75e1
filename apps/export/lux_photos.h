// Makes maps of illuminance from photos of registered views, and their files, for export and luxmap.
#ifndef LUXFIT_APPS_EXPORT_LUX_PHOTOS_H_
#define LUXFIT_APPS_EXPORT_LUX_PHOTOS_H_

#include <string>
#include <vector>

#include "apps/export/fit_uncertainty.h"
#include "apps/export/fitted_room.h"
#include "apps/session/photo_corrections.h"
#include "inverse/control/lux_map.h"

namespace luxfit {

// Holds what a camera sees from one place.
struct PhotoView {
  PixelMap dense;   // every pixel that sees one surface
  PixelMap strict;  // pixels that represent the middle of an element, as a fit takes them
};
PhotoView ViewOf(const FittedRoom& fitted, int camera, const PixelDirections& directions,
                 const Eigen::Isometry3d& cam_from_world);

// Returns a stem for the files of each photo, VIEW_STATE; no two are alike.
std::vector<std::string> PhotoStems(const LinearizedPhotos& photos);

// Writes STEM.exr (illuminance_lx, sigma_lx, gap; docs/exports.md) and STEM.png (false colours with their
// scale). Returns the paths.
std::vector<std::string> WriteLuxMap(const LuxMap& lux, const std::string& path_stem,
                                     const std::string& what);

}  // namespace luxfit

#endif  // LUXFIT_APPS_EXPORT_LUX_PHOTOS_H_
