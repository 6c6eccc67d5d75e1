// Tells how the pixels of a TIFF are compressed.
//
// Source: TIFF 6.0, tag 259; LogLuv: SGI compression schemes 34676 and 34677 (libtiff).
#ifndef LUXFIT_CALIB_PHOTO_FILES_INTERNAL_TIFF_COMPRESSION_H_
#define LUXFIT_CALIB_PHOTO_FILES_INTERNAL_TIFF_COMPRESSION_H_

#include <string>

namespace luxfit {

// Returns whether the file is a LogLuv TIFF; false for files that are no TIFF. LogLuv rounds chromaticity and
// luminance. Programs that write floats so (OpenCV by default) are wrong by factors: 0.5 comes back as 16.1.
bool IsLogLuvTiff(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_PHOTO_FILES_INTERNAL_TIFF_COMPRESSION_H_
