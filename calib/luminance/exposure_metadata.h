// What a photo says of its own exposure: EXIF.
//
// Times and f-numbers are nominal: 1/60 s is 1/64 s in most cameras, f/5.6 is f/5.657. The steps of a
// camera's dial are powers of two and their thirds; the labels are rounded, by up to 7 %. Values that a file
// leaves out, or gives as zero or nonsense, are empty. Nothing throws: a file without EXIF, or unreadable,
// gives none.
//
//   relative exposure = exposure_s * (iso / 100) / f_number^2      counts per luminance, up to one constant
//
// Source: EXIF 2.32 (CIPA DC-008), ExposureTime, FNumber, PhotographicSensitivity, and the APEX values
// ShutterSpeedValue and ApertureValue where those are missing; ISO 12232.
#ifndef LUXFIT_CALIB_LUMINANCE_EXPOSURE_METADATA_H_
#define LUXFIT_CALIB_LUMINANCE_EXPOSURE_METADATA_H_

#include <optional>
#include <string>

namespace luxfit {

struct ExposureMetadata {
  std::optional<double> exposure_s;
  std::optional<double> f_number;
  std::optional<double> iso;
};

ExposureMetadata ReadExposureMetadata(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_EXPOSURE_METADATA_H_
