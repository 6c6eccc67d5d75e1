// Reads photos taken after a run as photos of its session: camera, pose, exposure.
//
// Rows of a table that share view and time are an exposure bracket. ISO and aperture are relative to those of
// the session's first photo of the camera, as in the run. A response that the run estimated is read from
// OUT/response_CAMERA.csv.
//
// Throws std::runtime_error("FILE:LINE: column: ..."), or with the name of the flag.
#ifndef LUXFIT_APPS_COMMANDS_INTERNAL_NEW_PHOTOS_H_
#define LUXFIT_APPS_COMMANDS_INTERNAL_NEW_PHOTOS_H_

#include <string>
#include <vector>

#include "apps/commands/result/luxmap_command.h"
#include "apps/export/fitted_room.h"

namespace luxfit {

struct NewPhoto {
  LinearizedPhoto photo;
  std::string time;  // as given; empty: not given
  Eigen::Isometry3d cam_from_world = Eigen::Isometry3d::Identity();
};
struct NewPhotos {
  LinearizedPhotos linearized;  // with the session's first photo of each camera
  std::vector<NewPhoto> photos;
};
// `context` receives warnings. Photos whose pose the tags do not determine are left out with a warning.
NewPhotos ReadNewPhotos(const FittedRoom& fitted, const LuxmapCommandOptions& options, RunContext& context);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_INTERNAL_NEW_PHOTOS_H_
