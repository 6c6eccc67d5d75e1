#include "calib/internal/tiff_compression.h"

#include <exception>
#include <exiv2/exiv2.hpp>

namespace luxfit {

bool IsLogLuvTiff(const std::string& path) {
  Exiv2::LogMsg::setLevel(Exiv2::LogMsg::mute);
  try {
    const auto image = Exiv2::ImageFactory::open(path);
    image->readMetadata();
    const auto at = image->exifData().findKey(Exiv2::ExifKey("Exif.Image.Compression"));
    if (at == image->exifData().end() || at->count() == 0) return false;
    const auto compression = at->toLong();
    return compression == 34676 || compression == 34677;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace luxfit
