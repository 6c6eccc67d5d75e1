// Runs `luxfit luxmap OUT PHOTO...`: turns new photos of a fitted room into maps of illuminance, without
// another fit.
//
// Writes maps/STEM.exr and .png (apps/export/lux_photos.h) and maps/STEM_elements.csv for each photo. Over
// all photos it writes photos.csv (dimming of each luminaire, unexplained light) and places.csv (the
// luxmeter's places: seen, or predicted by the dimming); luxmap.json holds both. docs/commands.md describes
// the columns.
//
// Returns the exit status: 1 where a photo's dimming, or its pose, is not determined. Throws
// std::runtime_error for bad input: a fit without the camera's scale, or a photo that has another size, is
// not linear, or is saturated over most of what it shows.
#ifndef LUXFIT_APPS_COMMANDS_RESULT_LUXMAP_COMMAND_H_
#define LUXFIT_APPS_COMMANDS_RESULT_LUXMAP_COMMAND_H_

#include <string>
#include <vector>

namespace luxfit {

struct LuxmapCommandOptions {
  std::string out;                  // folder of the run
  std::vector<std::string> photos;  // or one table .csv: file,camera,view[,exposure_s,time,aperture,iso]
  std::string view;                 // the photos' pose is that of this view of the run
  bool pose_from_tags = false;      // or it is found by the room's tags
  std::string camera;               // id; empty: the only one
  double exposure_s = 0;            // 0: from the photo's metadata
  std::string state;                // state that should be on; empty: not given
  std::string session, folder;      // folder empty: OUT/luxmap
  std::string command_line;
  bool json = false;
};

int LuxmapCommand(const LuxmapCommandOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_RESULT_LUXMAP_COMMAND_H_
