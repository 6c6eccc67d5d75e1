// Reads from a photo's EXIF which camera took it, and when.
//
// Values that a file leaves out are empty. Reading throws nothing: a file without EXIF, or an unreadable one, gives no
// values. Times are the camera's own clock, without its time zone: only differences mean something.
//
// Source: EXIF 2.32 (CIPA DC-008), Make, Model, BodySerialNumber, DateTimeOriginal, SubSecTimeOriginal.
#ifndef LUXFIT_CALIB_PHOTO_FILES_CAPTURE_H_
#define LUXFIT_CALIB_PHOTO_FILES_CAPTURE_H_

#include <optional>
#include <string>

namespace luxfit {

struct CaptureMetadata {
  std::string camera;             // maker, model and serial number, as far as they are stated
  std::optional<double> taken_s;  // since 1970 began by the camera's clock
};

// Returns what the file states.
CaptureMetadata ReadCaptureMetadata(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_PHOTO_FILES_CAPTURE_H_
