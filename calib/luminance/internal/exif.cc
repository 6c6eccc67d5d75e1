#include "calib/luminance/internal/exif.h"

#include <exception>

namespace luxfit {

Exiv2::ExifData ReadExif(const std::string& path) {
  // The parser of XMP packets, which files carry beside EXIF, must be set up before threads meet it; a broken
  // tag is no reason to write on the user's terminal.
  static const bool is_set_up = [] {
    Exiv2::LogMsg::setLevel(Exiv2::LogMsg::mute);
    return Exiv2::XmpParser::initialize();
  }();
  static_cast<void>(is_set_up);
  try {
    const auto image = Exiv2::ImageFactory::open(path);
    image->readMetadata();
    return image->exifData();
  } catch (const std::exception&) {
    // The file has a format without EXIF (EXR, HDR, PFM), or is broken: it states nothing.
    return {};
  }
}

}  // namespace luxfit
