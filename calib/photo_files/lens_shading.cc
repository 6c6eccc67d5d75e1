#include "calib/photo_files/lens_shading.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "calib/photo_files/internal/exif.h"

namespace luxfit {
namespace {

constexpr std::uint16_t kOpcodeList2 = 51009, kOpcodeList3 = 51022;  // of the linear raw image, and after it
constexpr std::uint32_t kGainMapOpcode = 9;

std::vector<unsigned char> BytesOf(const Exiv2::Exifdatum& value) {
  std::vector<unsigned char> bytes(static_cast<std::size_t>(value.size()));
  if (!bytes.empty()) value.copy(bytes.data(), Exiv2::bigEndian);
  return bytes;
}

// Opcodes are big-endian whatever the file is: count, then each its id, version, flags, and the size of what follows.
bool HoldsGainMap(const std::vector<unsigned char>& list) {
  const auto number = [&list](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | list[at + i];
    return value;
  };
  constexpr std::size_t kHead = 16;
  std::size_t at = 4;
  while (at + kHead <= list.size()) {
    if (number(at) == kGainMapOpcode) return true;
    at += kHead + number(at + 12);
  }
  return false;
}

}  // namespace

bool HasLensShadingMap(const std::string& path) {
  const Exiv2::ExifData exif = ReadExif(path);
  for (const Exiv2::Exifdatum& value : exif) {
    if ((value.tag() == kOpcodeList2 || value.tag() == kOpcodeList3) && HoldsGainMap(BytesOf(value)))
      return true;
  }
  return false;
}

}  // namespace luxfit
