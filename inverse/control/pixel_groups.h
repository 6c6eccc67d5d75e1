// Groups pixels of a mask: those that touch, and those whose directions come within an angle of each other.
//
// Touching is by the four neighbours. The distance of two groups is that of their nearest pixels on the border.
#ifndef LUXFIT_INVERSE_CONTROL_PIXEL_GROUPS_H_
#define LUXFIT_INVERSE_CONTROL_PIXEL_GROUPS_H_

#include <Eigen/Core>

#include "calib/photo_files/image.h"
#include "inverse/observe/observe.h"

namespace luxfit {

// Returns the group of each pixel, from 0; -1 outside of the mask. `directions`: unit, row by row.
struct PixelGroups {
  Eigen::Array<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> group;
  int count = 0;
};
PixelGroups GroupPixels(const PixelMask& mask, const PixelDirections& directions, double angle_rad);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CONTROL_PIXEL_GROUPS_H_
