#include "calib/luminance/internal/exif.h"

#include <exception>

#include "calib/luminance/internal/heif_photo.h"

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
    if (IsHeifName(path)) {
      // Exiv2 reads this container in some builds only.
      const std::vector<std::uint8_t> bytes = ReadHeifExifBytes(path);
      Exiv2::ExifData exif;
      if (!bytes.empty()) Exiv2::ExifParser::decode(exif, bytes.data(), static_cast<uint32_t>(bytes.size()));
      return exif;
    }
    const auto image = Exiv2::ImageFactory::open(path);
    image->readMetadata();
    return image->exifData();
  } catch (const std::exception&) {
    // The file has a format without EXIF (EXR, HDR, PFM), or is broken: it states nothing.
    return {};
  }
}

}  // namespace luxfit
