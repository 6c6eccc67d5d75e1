// Reads one camera file format each, for calib/lens/camera_file.h.
//
// Throws std::runtime_error("FILE[:LINE]: key: expected ..., got ...") for malformed files.
#ifndef LUXFIT_CALIB_LENS_INTERNAL_CAMERA_FORMATS_H_
#define LUXFIT_CALIB_LENS_INTERNAL_CAMERA_FORMATS_H_

#include <string>
#include <vector>

#include "calib/lens/camera_file.h"

namespace luxfit {

FiledCamera ReadOpenCvCamera(const std::string& path);
FiledCamera ReadMrcalCamera(const std::string& path);
std::vector<FiledCamera> ReadKalibrCamchain(const std::string& path);

// Returns the family that a file names by its distortion model; kOpenCv where no family has that name.
LensModel LensOfDistortion(const std::string& distortion_model);

// Returns a width or height: a whole number of 1 to 1e6 pixels. Throws std::runtime_error("PLACE: expected
// ...") for any other number.
int ImagePixels(double value, const std::string& place);

// Throws std::runtime_error where a focal length is not > 0, a number is not finite, or the size is not
// >= 1 x 1.
void CheckCamera(const Camera& camera, const std::string& place);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LENS_INTERNAL_CAMERA_FORMATS_H_
