// Reads the EXIF, XMP and ICC parts of a file through Exiv2, from any thread.
#ifndef LUXFIT_CALIB_PHOTO_FILES_INTERNAL_EXIF_H_
#define LUXFIT_CALIB_PHOTO_FILES_INTERNAL_EXIF_H_

#include <cstdint>
#include <exiv2/exiv2.hpp>
#include <string>
#include <vector>

namespace luxfit {

// Returns the EXIF data; empty where the file carries none or cannot be read. Writes nothing on the terminal.
Exiv2::ExifData ReadExif(const std::string& path);

// Returns the value of a key ("Exif.Image.Make") without blanks at its end; empty where there is none.
std::string TextOf(const Exiv2::ExifData& exif, const char* key);

// Returns the XMP packet of a JPEG; empty where it carries none, or is another kind of file.
std::string ReadXmpPacket(const std::string& path);

// Returns the ICC profile; empty where the file carries none.
std::vector<std::uint8_t> ReadIccProfile(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_PHOTO_FILES_INTERNAL_EXIF_H_
