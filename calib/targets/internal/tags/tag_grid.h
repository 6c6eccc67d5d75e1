// Tells which detected tags belong at known places of a plane, and where the others must be.
//
// Pixels are predicted from the nearest seen tags alone, so the lens need not be known: over a few tags any
// lens is close to a homography.
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_TAGS_TAG_GRID_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_TAGS_TAG_GRID_H_

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "calib/photo_files/image.h"
#include "calib/targets/internal/tags/tag_cells.h"

namespace luxfit {

// Holds one tag of the grid. Corners everywhere: top-left, top-right, bottom-right, bottom-left of the tag as
// its family draws it.
struct GridTag {
  std::array<Eigen::Vector2d, 4> corners_m;        // on the board
  std::array<int, 4> corner_index = {0, 0, 0, 0};  // by board corner, where a tag's corners are such
};
using TagGrid = std::vector<GridTag>;  // by number: id - first id

struct SeenTag {
  int number = 0;
  std::array<Eigen::Vector2d, 4> corners_px;
  std::array<double, 4> sigma_px = {0, 0, 0, 0};  // 0: not measured, but the detector's
};

// Maps a tag's own square, (0, 0) to (1, 1), to pixels; nothing where its corners are no quadrilateral.
using TagFrame = std::optional<Eigen::Matrix3d>;
std::vector<TagFrame> FramesOf(const std::vector<SeenTag>& tags);

// Returns the largest set of tags in which each lies where a near one predicts it. `frames` are those of
// `found`.
std::vector<SeenTag> AgreeingTags(const TagGrid& grid, const std::vector<SeenTag>& found,
                                  const std::vector<TagFrame>& frames);

// Returns the map from board to pixels about a place, from the corners of the nearest seen tags.
std::optional<Eigen::Matrix3d> PixelFromBoardNear(const TagGrid& grid, const std::vector<SeenTag>& seen,
                                                  const Eigen::Vector2d& place_m);

// Returns a tag with measured corners, or nothing where they could not be measured.
using MeasureTag = std::function<std::optional<SeenTag>(const SeenTag&)>;

// Returns `seen` and every other tag of the grid whose cells the photo shows at the predicted place,
// measured.
std::vector<SeenTag> WithPredictedTags(const ImagePlane& grey, const TagGrid& grid,
                                       const std::vector<TagCells>& cells, std::vector<SeenTag> seen,
                                       const MeasureTag& measure);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_TAGS_TAG_GRID_H_
