// Tells whether a raw photo brings a map of its lens's shading along, which developing it without would leave out.
//
// Phones write it into DNG files as an opcode GainMap of the lists that apply to the raw or the linear image. The
// project's raw reader (LibRaw) keeps the counts as the sensor had them.
// Source: Adobe, DNG specification 1.4, chapter 6 ("Opcode list processing", "GainMap").
#ifndef LUXFIT_CALIB_PHOTO_FILES_LENS_SHADING_H_
#define LUXFIT_CALIB_PHOTO_FILES_LENS_SHADING_H_

#include <string>

namespace luxfit {

// False for files without such a map, and for those that cannot be read.
bool HasLensShadingMap(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_PHOTO_FILES_LENS_SHADING_H_
