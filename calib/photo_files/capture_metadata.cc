#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>

#include "calib/photo_files/capture.h"
#include "calib/photo_files/internal/exif.h"

namespace luxfit {
namespace {

// Reads "2024:01:31 12:34:56". Cameras whose clock is not set write zeros or blanks: these are no time.
std::optional<double> SecondsFrom(const std::string& text) {
  std::tm time = {};
  if (std::sscanf(text.c_str(), "%d:%d:%d %d:%d:%d", &time.tm_year, &time.tm_mon, &time.tm_mday,
                  &time.tm_hour, &time.tm_min, &time.tm_sec) != 6 ||
      time.tm_year < 1970 || time.tm_mon < 1)
    return std::nullopt;
  time.tm_year -= 1900;
  time.tm_mon -= 1;
  return static_cast<double>(timegm(&time));
}

std::optional<double> TakenAt(const Exiv2::ExifData& exif) {
  for (const char* key :
       {"Exif.Photo.DateTimeOriginal", "Exif.Photo.DateTimeDigitized", "Exif.Image.DateTime"}) {
    const auto seconds = SecondsFrom(TextOf(exif, key));
    if (!seconds) continue;
    // The digits after the decimal point: "25" is a quarter of a second.
    const std::string fraction = "0." + TextOf(exif, "Exif.Photo.SubSecTimeOriginal");
    double sub_s = 0;
    return std::sscanf(fraction.c_str(), "%lf", &sub_s) == 1 && std::isfinite(sub_s) ? *seconds + sub_s
                                                                                     : *seconds;
  }
  return std::nullopt;
}

std::string CameraOf(const Exiv2::ExifData& exif) {
  std::string camera;
  for (const char* key : {"Exif.Image.Make", "Exif.Image.Model", "Exif.Photo.BodySerialNumber"}) {
    const std::string part = TextOf(exif, key);
    if (!part.empty()) camera += (camera.empty() ? "" : " ") + part;
  }
  return camera;
}

}  // namespace

CaptureMetadata ReadCaptureMetadata(const std::string& path) {
  const Exiv2::ExifData exif = ReadExif(path);
  try {
    return {CameraOf(exif), TakenAt(exif)};
  } catch (const std::exception&) {
    return {};  // the value has another type than the standard's
  }
}

}  // namespace luxfit
