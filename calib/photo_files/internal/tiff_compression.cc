#include "calib/photo_files/internal/tiff_compression.h"

#include "calib/photo_files/internal/exif.h"

namespace luxfit {

bool IsLogLuvTiff(const std::string& path) {
  const Exiv2::ExifData exif = ReadExif(path);
  const auto at = exif.findKey(Exiv2::ExifKey("Exif.Image.Compression"));
  if (at == exif.end() || at->count() == 0) return false;
  const auto compression = at->toRational().first;  // toLong() until Exiv2 0.27 only
  return compression == 34676 || compression == 34677;
}

}  // namespace luxfit
