// Runs `luxfit spot INPUT SPOT...`: the luminance of circles of photos, as a spot meter reads it.
//
//   L = k Y,   (sigma_L / L)^2 = (sigma_Y / Y)^2 + u_response^2 + (sigma_k / k)^2
//
// Y, sigma_Y, u_response: calib/luminance/luminance_spot.h; k: apps/commands/internal/measured_photos.h. An error that
// is not known is left out, and the result says so.
//
// Writes OUT/luminance/spots.csv and spots.json, whose keys docs/luminance.md describes. Returns the exit
// status: 1 where a spot has no luminance: saturated in every exposure, too dark, or without an absolute scale.
// Throws std::runtime_error for bad input.
#ifndef LUXFIT_APPS_COMMANDS_RESULT_SPOT_COMMAND_H_
#define LUXFIT_APPS_COMMANDS_RESULT_SPOT_COMMAND_H_

#include <string>
#include <vector>

#include "apps/commands/internal/measured_photos.h"

namespace luxfit {

struct SpotCommandOptions : MeasuredInput {
  std::vector<std::string> spots;  // PHOTO:X,Y; or one table .csv: photo,x_px,y_px[,radius_px]
  double radius_px = 5;
};

int SpotCommand(const SpotCommandOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_RESULT_SPOT_COMMAND_H_
