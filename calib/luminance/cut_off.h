// Finds the count below full scale at which photos were cut off, as raw converters with another white level do.
//
//   z: the largest count of a pixel's channels,   n(z): pixels that have it,   top = max z
//   plateau: n(top) >= 20,   n(top) > 10 median n of the 16 next lower z that occur,   top below 0.97 of full scale
//   cut off at top: three photos or more share it, with a plateau each, at exposures that differ by a tenth or more
//
// Light gives another count at another exposure. One exposure alone tells nothing: an evenly bright luminaire has a plateau,
// too. Counts may have steps of any size, so that the z that occur are compared. Channels that were cut off at counts of
// their own are told by the largest.
// Source: own.
#ifndef LUXFIT_CALIB_LUMINANCE_CUT_OFF_H_
#define LUXFIT_CALIB_LUMINANCE_CUT_OFF_H_

#include <optional>
#include <string>
#include <vector>

#include "calib/photo_files/image.h"

namespace luxfit {

struct TopCount {
  double counts = 0;
  bool is_plateau = false;  // below the level at which pixels count as saturated anyway
};

// Returns nothing for a photo without integer counts: RAW, which states its white level, and floats.
std::optional<TopCount> TopCountOf(const Photo& photo);
// Likewise, without decoding RAW. Throws as ReadPhoto.
std::optional<TopCount> ReadTopCount(const std::string& path);

struct ExposedTop {
  TopCount top;
  double exposure_s = 0;  // relative
};

// Returns the counts at which photos of one camera were cut off, ascending.
std::vector<double> FindCutOffs(const std::vector<ExposedTop>& photos);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_CUT_OFF_H_
