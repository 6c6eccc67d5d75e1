#include "calib/photo_files/internal/exif.h"

#include <exception>

#include "calib/photo_files/internal/heif_photo.h"

namespace luxfit {

namespace {

// The parser of XMP packets must be set up before threads meet it; a broken tag is no reason to write on the user's terminal.
void SetUp() {
  static const bool is_set_up = [] {
    Exiv2::LogMsg::setLevel(Exiv2::LogMsg::mute);
    return Exiv2::XmpParser::initialize();
  }();
  static_cast<void>(is_set_up);
}

}  // namespace

std::string TextOf(const Exiv2::ExifData& exif, const char* key) {
  const auto at = exif.findKey(Exiv2::ExifKey(key));
  if (at == exif.end()) return "";
  const std::string text = at->toString();
  const size_t end = text.find_last_not_of(std::string(" \0", 2));
  return end == std::string::npos ? "" : text.substr(0, end + 1);
}

Exiv2::ExifData ReadExif(const std::string& path) {
  SetUp();
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

std::string ReadXmpPacket(const std::string& path) {
  SetUp();
  try {
    const auto image = Exiv2::ImageFactory::open(path);
    if (image->mimeType() != "image/jpeg") return "";
    image->readMetadata();
    return image->xmpPacket();
  } catch (const std::exception&) {
    return "";
  }
}

std::vector<std::uint8_t> ReadIccProfile(const std::string& path) {
  SetUp();
  try {
    const auto image = Exiv2::ImageFactory::open(path);
    image->readMetadata();
    if (!image->iccProfileDefined()) return {};
#if EXIV2_TEST_VERSION(0, 28, 0)
    const Exiv2::DataBuf& profile = image->iccProfile();
    return {profile.cbegin(), profile.cend()};
#else
    const Exiv2::DataBuf& profile = *image->iccProfile();
    return {profile.pData_, profile.pData_ + profile.size_};
#endif
  } catch (const std::exception&) {
    return {};
  }
}

}  // namespace luxfit
