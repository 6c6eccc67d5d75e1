#include "calib/photo_files/tone_mapped.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <vector>

#include "calib/photo_files/internal/exif.h"
#include "calib/photo_files/internal/file_ending.h"
#include "calib/photo_files/internal/heif_photo.h"

namespace luxfit {
namespace {

constexpr const char* kGainMap = "a map of gains for HDR displays beside it";

bool IsJpegName(const std::string& path) {
  const std::string ending = FileEnding(path);
  return ending == ".jpg" || ending == ".jpeg";
}

bool HasGainMap(const std::string& path) {
  if (!IsHeifName(path)) return ReadXmpPacket(path).find("ns.adobe.com/hdr-gain-map/") != std::string::npos;
  const std::vector<std::string> types = ReadHeifAuxiliaryTypes(path);
  return std::any_of(types.begin(), types.end(),
                     [](const std::string& type) { return type.find("hdrgainmap") != std::string::npos; });
}

std::vector<std::uint8_t> BytesOf(const Exiv2::ExifData& exif, const char* key) {
  const auto at = exif.findKey(Exiv2::ExifKey(key));
  if (at == exif.end()) return {};
  std::vector<std::uint8_t> bytes(at->size());
  if (!bytes.empty()) at->copy(bytes.data(), Exiv2::bigEndian);
  return bytes;
}

// Apple's notes are "Apple iOS", a version, "MM", and a directory of TIFF entries in big-endian order.
bool HasAppleHdrNotes(const std::vector<std::uint8_t>& notes) {
  constexpr size_t kDirectory = 14, kEntry = 12;
  constexpr std::uint16_t kHdrImageType = 0x000a, kHdrHeadroom = 0x0021, kHdrGain = 0x0030;
  const std::string opening = "Apple iOS";
  if (notes.size() < kDirectory + 2 || !std::equal(opening.begin(), opening.end(), notes.begin()))
    return false;
  const auto number = [&](size_t at) { return static_cast<std::uint16_t>(notes[at] << 8 | notes[at + 1]); };
  const size_t entries = number(kDirectory);
  for (size_t i = 0; i < entries && kDirectory + 2 + (i + 1) * kEntry <= notes.size(); ++i) {
    const size_t at = kDirectory + 2 + i * kEntry;
    const std::uint16_t tag = number(at);
    // A number of four bytes stands in the entry itself. 3: mapped; 4: the original beside a mapped one.
    if (tag == kHdrHeadroom || tag == kHdrGain || (tag == kHdrImageType && number(at + 10) == 3)) return true;
  }
  return false;
}

std::string SignInExif(const Exiv2::ExifData& exif) {
  if (TextOf(exif, "Exif.Image.Software").rfind("HDR+", 0) == 0) return "\"HDR+\" as its software";
  if (TextOf(exif, "Exif.Image.Make").rfind("Apple", 0) != 0) return "";
  const std::string rendered = TextOf(exif, "Exif.Photo.CustomRendered");
  if (rendered == "2" || rendered == "3" || rendered == "7") return "CustomRendered = HDR";
  return HasAppleHdrNotes(BytesOf(exif, "Exif.Photo.MakerNote")) ? "the maker's notes on HDR" : "";
}

}  // namespace

std::string SignOfToneMapping(const std::string& path) {
  if (!IsJpegName(path) && !IsHeifName(path)) return "";
  try {
    return HasGainMap(path) ? kGainMap : SignInExif(ReadExif(path));
  } catch (const std::exception&) {
    return "";  // a value has another type than the standard's
  }
}

std::string ToneMappingInWords(const std::string& sign) {
  return "local tone mapping (the camera brightened dark parts of the picture and darkened bright ones; the "
         "file has " +
         sign + ")";
}

std::string ToneMappedFiles::Names() const {
  return mapped < 2
             ? first
             : first + " and " + std::to_string(mapped - 1) + " more of " + std::to_string(of) + " files";
}

ToneMappedFiles FindToneMapped(const std::vector<std::string>& paths) {
  ToneMappedFiles found;
  found.of = paths.size();
  for (const std::string& path : paths) {
    const std::string sign = SignOfToneMapping(path);
    if (!sign.empty() && found.mapped++ == 0) found.first = path, found.sign = sign;
  }
  return found;
}

}  // namespace luxfit
