#include "apps/export/exports.h"
#include "apps/export/luminance_pictures.h"

namespace luxfit {

ExportedFiles ExportLuminance(const FittedRoom& fitted, const std::string& folder, RunContext& context) {
  ExportedFiles exported;
  if (fitted.registered.cameras.empty()) {
    exported.is_whole = false;
    exported.notes.push_back("no luminance pictures: the run had no photos");
    return exported;
  }
  const LinearizedPhotos photos = LinearizePhotos(fitted.session, context);
  LuminancePictureOptions options;
  options.folder = folder;
  options.command_line = context.provenance.command_line;
  options.corrections = ReadPhotoCorrections(fitted.out);
  std::optional<double> cdm2_per_unit;
  if (fitted.camera_scale > 0) cdm2_per_unit = 1 / fitted.camera_scale;
  options.cdm2_per_unit.assign(photos.cameras.size(), cdm2_per_unit);
  if (!cdm2_per_unit)
    exported.notes.push_back(
        "luminance pictures are relative: a luxmeter reading with the role scale gives cd/m2");
  for (const LuminancePicture& picture : WriteLuminancePictures(photos, fitted.registered, options)) {
    exported.files.push_back(picture.stem + ".hdr");
    exported.files.push_back(picture.stem + ".exr");
    if (!picture.has_pose)
      exported.notes.push_back("no pose in " + picture.view + "_" + picture.state +
                               ".hdr: its view has none");
  }
  return exported;
}

}  // namespace luxfit
