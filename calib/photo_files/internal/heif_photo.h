// Reads HEIC and HEIF, as phones write them, through libheif.
//
// Counts are the file's own, as of a JPEG: they have a tone curve. Files of more than 8 bits are scaled to 0..255 and keep
// their fractions, so that they meet the rules for 8-bit photos. The file's turns and mirrors are left out, as those of
// EXIF are: pixels stand as the sensor has them. Of several pictures in a file, the primary one is read.
//
// Throws std::runtime_error, naming the file, where libheif cannot decode it.
// Source: ISO/IEC 23008-12 (HEIF); libheif 1.15.
#ifndef LUXFIT_CALIB_PHOTO_FILES_INTERNAL_HEIF_PHOTO_H_
#define LUXFIT_CALIB_PHOTO_FILES_INTERNAL_HEIF_PHOTO_H_

#include <cstdint>
#include <string>
#include <vector>

#include "calib/photo_files/image.h"

namespace luxfit {

// Returns whether the extension is .heic, .heif or .hif.
bool IsHeifName(const std::string& path);

Photo ReadHeifPhoto(const std::string& path);

// Returns the bytes of the EXIF part, from its TIFF header on; empty where the file has none or cannot be read.
std::vector<std::uint8_t> ReadHeifExifBytes(const std::string& path);

// Returns the types of the pictures that belong to the primary one ("urn:..."), but for thumbnails; none where the file
// cannot be read.
std::vector<std::string> ReadHeifAuxiliaryTypes(const std::string& path);

struct HeifProfile {
  std::vector<std::uint8_t> icc;  // empty: none
  int transfer = 2;  // transfer characteristics of the coding points (ISO/IEC 23091-2); 2: not stated
};
HeifProfile ReadHeifProfile(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_PHOTO_FILES_INTERNAL_HEIF_PHOTO_H_
