// Reads photos as the sensor counted them: DNG, CR2, NEF, ARW and the other formats that LibRaw decodes.
//
//   counts_c(p) = sum_q k(|q - p|) (raw(q) - black(q)) / sum_q k(|q - p|)      over sites q of colour c
//
// k is the tent of 3 x 3 sites: bilinear interpolation on a Bayer mosaic; counts of a site's own colour stay
// as they are. X-Trans, whose sites of one colour lie farther apart, takes 5 x 5. The file's black levels are
// subtracted per colour and per place in the mosaic. A linear DNG (ProRAW, DNG converters) has three colours a
// pixel already: counts_c(p) = raw_c(p) - black_c, where raw is what the file's LinearizationTable makes of its
// numbers; its gain tables for display (ProfileGainTableMap) and tone curves are left out. There is no white balance, no colour matrix, no
// brightening, no rotation, and no cropping beyond the file's visible area.
//
// full_scale_counts and saturation_counts are the file's white level (the maker's limit of linearity where
// lower) less the largest black level. Counts below black stay negative, so that noise about zero averages to
// zero.
//
// Throws std::runtime_error, naming the file, where LibRaw cannot decode it, or where it holds neither a mosaic nor a linear DNG's
// three colours.
// Source: LibRaw 0.20, unpack(), without its own processing; DNG 1.6, LinearRaw.
#ifndef LUXFIT_CALIB_PHOTO_FILES_INTERNAL_RAW_PHOTO_H_
#define LUXFIT_CALIB_PHOTO_FILES_INTERNAL_RAW_PHOTO_H_

#include <string>

#include "calib/photo_files/image.h"

namespace luxfit {

// Returns whether the extension is that of a RAW format.
bool IsRawName(const std::string& path);

Photo ReadRawPhoto(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_PHOTO_FILES_INTERNAL_RAW_PHOTO_H_
