// Reads from a photo's file whether the camera mapped tones locally: then the same light counts for more in the dark parts of a
// picture than in bright ones, and no curve leads back to light.
//
// JPEG, HEIC and HEIF say so by one of
// - a map of gains for HDR displays beside the picture: an auxiliary picture of HEIC (Apple), XMP of JPEG (Ultra HDR);
// - EXIF CustomRendered 2, 3 or 7, or the maker's notes on HDR, of Apple;
// - a Software of "HDR+" (Google).
// Other phones map tones and say nothing; three views of a room show it (inverse/observe/camera/tone_mapping.h). Reading throws nothing.
//
// Sources: ExifTool's tables of EXIF and Apple tags (CustomRendered; HDRImageType, HDRHeadroom, HDRGain); Google, "Ultra HDR image
// format 1.0"; ISO 21496-1.
#ifndef LUXFIT_CALIB_PHOTO_FILES_TONE_MAPPED_H_
#define LUXFIT_CALIB_PHOTO_FILES_TONE_MAPPED_H_

#include <cstddef>
#include <string>
#include <vector>

namespace luxfit {

// Returns what says so, in words ("a map of gains for HDR displays"); empty: nothing does.
std::string SignOfToneMapping(const std::string& path);

// Says it in words: "local tone mapping (the camera ...; the file has SIGN)".
std::string ToneMappingInWords(const std::string& sign);

constexpr const char* kToneMappingRemedy = "photograph RAW (DNG, ProRAW) with automatic HDR off";

struct ToneMappedFiles {
  std::string first, sign;         // the first file that says so, and by what
  std::size_t mapped = 0, of = 0;  // number of files that say so, and of all

  std::string Names() const;  // "FIRST and 3 more of 49 files"
};
ToneMappedFiles FindToneMapped(const std::vector<std::string>& paths);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_PHOTO_FILES_TONE_MAPPED_H_
