// Looks at a photo for what tells its view and what was on: tags, edges, and the pattern of its light.
//
//   light = g(green counts / full scale)     g: the sRGB curve's inverse for 8-bit files, else linear
//   edges = c / sqrt(c^2 + 0.4^2), of unit length;   c = Laplacian of ln light
//
// A plane's pixel is the mean over a square of the photo's pixels. It is NaN where one of these is clipped. Edges of
// things stay where they are when other luminaires light them; smooth shades have no curvature.
//
// Throws std::runtime_error, naming the file, where the photo cannot be read.
#ifndef LUXFIT_APPS_SESSION_PHOTOS_PHOTO_LOOK_H_
#define LUXFIT_APPS_SESSION_PHOTOS_PHOTO_LOOK_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calib/luminance/exposure.h"
#include "calib/photo_files/capture.h"
#include "calib/photo_files/image.h"
#include "calib/targets/tags.h"

namespace luxfit {

struct PhotoLook {
  std::string file;  // relative to the folder of the photos
  ExposureMetadata exposure;
  CaptureMetadata capture;
  int width_px = 0, height_px = 0;
  int bits_per_channel = 16;
  std::vector<TagDetection> tags;
  ImagePlane light;      // up to 480 pixels wide
  ImagePlane pattern;    // up to 80 pixels wide
  Eigen::ArrayXf edges;  // of a picture up to 160 pixels wide

  // Returns exposure_s * iso / f_number^2 with those that are stated; empty without exposure_s.
  std::optional<double> RelativeExposure() const;
};

// Looks at the light alone: neither at tags nor at edges. `folder` of the photos, `file` relative to it.
PhotoLook LookAtLight(const std::string& folder, const std::string& file);

// `family` of the tags.
PhotoLook LookAtPhoto(const std::string& folder, const std::string& file, const std::string& family);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_PHOTOS_PHOTO_LOOK_H_
