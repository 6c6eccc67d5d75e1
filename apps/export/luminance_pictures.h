// Writes photos as pictures of luminance: Radiance .hdr with the view, and OpenEXR, for evalglare, pcomb and others.
//
//   L = k Y,   R, G, B = L / 179 / (w . rgb) rgb,   w = (0.265, 0.670, 0.065)
//
// Y: relative luminance of a photo, rgb: its channels (calib/luminance/luminance.h), k: cd/m2 per Y. The colours
// are the camera's, their luminance is the photo's whatever the camera's luminance_weights. Where k is not known,
// R, G, B = Y / (w . rgb) rgb: relative, and the header says so. Distortion is taken out
// (calib/lens/picture_view.h). Saturated pixels hold what they show, which is the least that they can be.
//
// docs/exports.md describes the files. Throws std::runtime_error, naming the file, where a photo cannot be read or
// a picture not written.
#ifndef LUXFIT_APPS_EXPORT_LUMINANCE_PICTURES_H_
#define LUXFIT_APPS_EXPORT_LUMINANCE_PICTURES_H_

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/session/photo_corrections.h"
#include "apps/stages/stages.h"
#include "calib/lens/picture_view.h"

namespace luxfit {

struct LuminancePictureOptions {
  std::string folder;
  std::string command_line;                          // as typed, for the header
  std::vector<std::optional<double>> cdm2_per_unit;  // k of each camera
  PhotoCorrections corrections;                      // what an earlier run found; default: none
  std::shared_ptr<PhotoStore> decoded;  // photos that a stage before decoded; null, or no corrections
};

struct LuminancePicture {
  std::string stem;  // path without .hdr and .exr
  std::string view, state, camera;
  PictureView picture;
  bool is_absolute = false;  // cd/m2
  bool has_pose = false;
  double saturated_share = 0;  // of the photo's pixels, their neighbours included
};

// Returns the view as Radiance has it: "VIEW= -vtv -vp 1 2 1.6 -vd 1 0 0 -vu 0 0 1 -vh 60 -vv 40". Without a pose
// -vp, -vd and -vu are left out, which Radiance reads as the origin, looking along +y.
std::string RadianceView(const PictureView& picture, const std::optional<Eigen::Isometry3d>& cam_from_world);

// Writes FOLDER/VIEW_STATE.hdr and .exr of every photo. `registered` has the cameras; views may lack.
std::vector<LuminancePicture> WriteLuminancePictures(const LinearizedPhotos& photos,
                                                     const RegisteredSession& registered,
                                                     const LuminancePictureOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_EXPORT_LUMINANCE_PICTURES_H_
