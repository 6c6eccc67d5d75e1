// Runs `luxfit glare INPUT [PHOTO...]`: the glare that photos show (inverse/control/photo_glare.h).
//
// The line of sight is the lens's axis. Sigmas are those of the camera's scale: what the values change by where all
// luminances of the photo have its relative sigma more.
//
// Writes OUT/luminance/glare.csv and glare.json, whose keys docs/luminance.md describes. Returns the exit
// status: 1 where a photo is clipped or without an absolute scale. Throws std::runtime_error for bad input.
#ifndef LUXFIT_APPS_COMMANDS_RESULT_GLARE_COMMAND_H_
#define LUXFIT_APPS_COMMANDS_RESULT_GLARE_COMMAND_H_

#include <optional>
#include <string>
#include <vector>

#include "apps/commands/internal/measured_photos.h"

namespace luxfit {

struct GlareCommandOptions : MeasuredInput {
  std::vector<std::string> names;     // of photos, VIEW_STATE; empty: all
  std::optional<double> vertical_lx;  // at the lens of the one photo; empty: by the photo
  std::string threshold = "2000";     // cd/m2, or a multiple of the mean: 5x
};

int GlareCommand(const GlareCommandOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_RESULT_GLARE_COMMAND_H_
