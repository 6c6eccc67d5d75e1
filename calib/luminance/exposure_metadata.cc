#include "calib/luminance/exposure.h"

#include <cmath>
#include <exception>
#include <initializer_list>

#include "calib/photo_files/internal/exif.h"

namespace luxfit {
namespace {

std::optional<double> Positive(double value) {
  if (std::isfinite(value) && value > 0) return value;
  return std::nullopt;
}

// Returns the value of a tag; empty where the file has none.
std::optional<double> ValueOf(const Exiv2::ExifData& exif, const char* key) {
  const auto at = exif.findKey(Exiv2::ExifKey(key));
  if (at == exif.end() || at->count() == 0) return std::nullopt;
  const double value = static_cast<double>(at->toFloat());
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

// Divides a rational in double precision: toFloat() is single precision, and 1/60 is needed exactly.
std::optional<double> RationalOf(const Exiv2::ExifData& exif, const char* key) {
  const auto at = exif.findKey(Exiv2::ExifKey(key));
  if (at == exif.end() || at->count() == 0) return std::nullopt;
  const Exiv2::Rational rational = at->toRational();
  if (rational.second == 0) return std::nullopt;
  return Positive(static_cast<double>(rational.first) / rational.second);
}

// Returns the value of the first tag that gives one: cameras write the EXIF part, RAW writers the main one.
std::optional<double> FirstRational(const Exiv2::ExifData& exif, std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    if (const auto value = RationalOf(exif, key)) return value;
  }
  return std::nullopt;
}

std::optional<double> ExposureTime(const Exiv2::ExifData& exif) {
  if (const auto time = FirstRational(exif, {"Exif.Photo.ExposureTime", "Exif.Image.ExposureTime"}))
    return time;
  const auto apex = ValueOf(exif, "Exif.Photo.ShutterSpeedValue");
  return apex ? Positive(std::exp2(-*apex)) : std::nullopt;
}

std::optional<double> FNumber(const Exiv2::ExifData& exif) {
  if (const auto number = FirstRational(exif, {"Exif.Photo.FNumber", "Exif.Image.FNumber"})) return number;
  const auto apex = ValueOf(exif, "Exif.Photo.ApertureValue");
  return apex ? Positive(std::exp2(*apex / 2)) : std::nullopt;
}

// The standard's 16 bits hold 65535 where the value is larger, and stands in a tag of 32 bits; makers' own tags hold it
// too, and Exiv2 knows these.
std::optional<double> Iso(const Exiv2::ExifData& exif) {
  constexpr double kTooLarge = 65535;
  const auto at = Exiv2::isoSpeed(exif);
  const auto iso =
      at == exif.end() || at->count() == 0 ? std::nullopt : Positive(static_cast<double>(at->toFloat()));
  if (!iso || *iso < kTooLarge) return iso;
  for (const char* key : {"Exif.Photo.RecommendedExposureIndex", "Exif.Photo.StandardOutputSensitivity",
                          "Exif.Photo.ISOSpeed"}) {
    if (const auto value = ValueOf(exif, key); value && *value > 0) return value;
  }
  return std::nullopt;
}

}  // namespace

ExposureMetadata ReadExposureMetadata(const std::string& path) {
  const Exiv2::ExifData exif = ReadExif(path);
  try {
    return {ExposureTime(exif), FNumber(exif), Iso(exif)};
  } catch (const std::exception&) {
    return {};  // the value has another type than the standard's
  }
}

}  // namespace luxfit
