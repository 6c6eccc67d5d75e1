// luxfit luxmap OUT PHOTO...: new photos of a fitted room as maps of illuminance, without another fit.
//
// Writes per photo maps/STEM.exr and .png (apps/export/lux_photos.h) and maps/STEM_elements.csv, and over all of
// them photos.csv (dimming of each luminaire, light not explained) and places.csv (the luxmeter's places:
// seen, or predicted by the dimming); luxmap.json holds both. Columns: docs/commands.md.
//
// Returns the exit status: 1 where a photo's dimming, or its pose, is not determined. Throws
// std::runtime_error for bad input: a fit without the camera's scale, a photo of another size, not linear, or
// saturated over most of what it shows.
#ifndef LUXFIT_APPS_COMMANDS_LUXMAP_COMMAND_H_
#define LUXFIT_APPS_COMMANDS_LUXMAP_COMMAND_H_

#include <string>
#include <vector>

namespace luxfit {

struct LuxmapCommandOptions {
  std::string out;                  // of the run
  std::vector<std::string> photos;  // or one table .csv: file,camera,view[,exposure_s,time,aperture,iso]
  std::string view;                 // the photos' pose is that of this view of the run
  bool pose_from_tags = false;      // or found anew by the room's tags
  std::string camera;               // id; empty: the only one
  double exposure_s = 0;            // 0: of the photo's metadata
  std::string state;                // what should be on; empty: not said
  std::string session, folder;      // folder empty: OUT/luxmap
  std::string command_line;
  bool json = false;
};

int LuxmapCommand(const LuxmapCommandOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_LUXMAP_COMMAND_H_
