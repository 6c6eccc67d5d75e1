// Chooses the pixels of a photo that determine where a tag is.
//
// They lie about the edges between its cells; some others determine its shading. A large tag gives a random
// share of them, the same in every run: a lattice would miss edges that run along its rows.
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_TAGS_TAG_PIXELS_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_TAGS_TAG_PIXELS_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "calib/photo_files/image.h"
#include "calib/targets/internal/tags/tag_family.h"

namespace luxfit {

// Returns (u, v) of at most about `max_pixels` finite pixels of the tag's picture, row by row. Corners are in
// TagDetection's order and may be off by a pixel.
std::vector<Eigen::Array2i> ChooseTagPixels(const ImagePlane& grey, const TagPicture& picture,
                                            const std::array<Eigen::Vector2d, 4>& corners_px, int max_pixels);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_TAGS_TAG_PIXELS_H_
