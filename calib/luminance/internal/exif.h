// Reads the EXIF part of a file through Exiv2, from any thread.
#ifndef LUXFIT_CALIB_LUMINANCE_INTERNAL_EXIF_H_
#define LUXFIT_CALIB_LUMINANCE_INTERNAL_EXIF_H_

#include <exiv2/exiv2.hpp>
#include <string>

namespace luxfit {

// Returns the EXIF data; empty where the file carries none or cannot be read. Writes nothing on the terminal.
Exiv2::ExifData ReadExif(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_INTERNAL_EXIF_H_
