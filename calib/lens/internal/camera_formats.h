// The readers behind calib/lens/camera_file.h, one a format.
#ifndef LUXFIT_CALIB_LENS_INTERNAL_CAMERA_FORMATS_H_
#define LUXFIT_CALIB_LENS_INTERNAL_CAMERA_FORMATS_H_

#include <string>
#include <vector>

#include "calib/lens/camera_file.h"

namespace luxfit {

FiledCamera ReadOpenCvCamera(const std::string& path);
FiledCamera ReadMrcalCamera(const std::string& path);
std::vector<FiledCamera> ReadKalibrCamchain(const std::string& path);

// A width or height: a whole number of 1 to 1e6 pixels; throws "PLACE: expected ..." for any other.
int ImagePixels(double value, const std::string& place);

// Throws where focal lengths are not > 0, a number is not finite, or the size is not >= 1 x 1.
void CheckCamera(const Camera& camera, const std::string& place);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LENS_INTERNAL_CAMERA_FORMATS_H_
