// Exports a fitted room as files of other programs. Each function writes into a folder of its own, and
// returns what it wrote and what it left out.
//
//   luminaires   .ies and .ldt of the luminaires that the fit determined
//   patches      patches and elements with light and reflectance: .vtp, .ply
//   radiance     the room as a scene of Radiance, with the luxmeter's points and how to run it
//   luxmaps      an illuminance of every pixel of every photo: .exr, false colours as .png
//   luminance    the luminance of every photo: Radiance .hdr with its view, .exr
//   csv          everything tabular, units in the headers
//   cameras      cameras and poses: OpenCV, mrcal, COLMAP, Kalibr
//
// docs/exports.md describes the files with their columns, properties and channels. Where the fit has no
// absolute scale, names end in _relative in place of their unit, and exports that need a scale (luxmaps) are
// not written.
//
// Throws std::runtime_error naming a file that cannot be written or read.
#ifndef LUXFIT_APPS_EXPORT_EXPORTS_H_
#define LUXFIT_APPS_EXPORT_EXPORTS_H_

#include <string>
#include <vector>

#include "apps/export/fitted_room.h"
#include "apps/stages/stages.h"

namespace luxfit {

struct ExportedFiles {
  std::vector<std::string> files;  // absolute paths
  std::vector<std::string> notes;  // what was left out and why
  bool is_whole = true;            // false: the data do not determine what was asked for
};

ExportedFiles ExportLuminaires(const FittedRoom& fitted, const std::string& folder);
ExportedFiles ExportPatches(const FittedRoom& fitted, const std::string& folder);
ExportedFiles ExportRadiance(const FittedRoom& fitted, const std::string& folder);
ExportedFiles ExportLuxMaps(const FittedRoom& fitted, const std::string& folder, RunContext& context);
ExportedFiles ExportLuminance(const FittedRoom& fitted, const std::string& folder, RunContext& context);
ExportedFiles ExportTables(const FittedRoom& fitted, const std::string& folder);
ExportedFiles ExportCameras(const FittedRoom& fitted, const std::string& folder);

}  // namespace luxfit

#endif  // LUXFIT_APPS_EXPORT_EXPORTS_H_
