// Measures the corners of an AprilGrid's tags in the full photo.
//
// A corner where a black square touches the tag's is a saddle (saddle.h). A plain corner has no such
// symmetry: gradients of its two edges alone pull inwards by 0.2 px. There the picture of the whole tag is
// fitted (tags.h). The photo tells the two apart: black or white diagonally outside the corner.
//
// That fit needs linear counts: a display curve (sRGB) moves edges towards the black by some tenths of a
// pixel. Among a few exponents the one that fits the tags best is chosen, so photos of either kind serve.
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_GRID_CORNERS_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_GRID_CORNERS_H_

#include <optional>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/targets/board.h"
#include "calib/targets/internal/tags/tag_grid.h"
#include "calib/targets/tags.h"

namespace luxfit {

class GridCornerMeasurer {
 public:
  // The plane must outlive the measurer.
  GridCornerMeasurer(const ImagePlane& grey, const Board& board, int border_bits);

  // Returns a measurer tuned to the lens and encoding of these tags, which this one measured. Returns this
  // one where no corner is plain: saddles need neither.
  GridCornerMeasurer Tuned(const TagGrid& grid, const std::vector<SeenTag>& tags) const;

  // Returns the tag with measured corners; corners that could not be measured keep their place and the sigma
  // 0. Returns nothing where no corner could be measured.
  std::optional<SeenTag> Measure(const SeenTag& tag) const;

 private:
  std::optional<bool> IsSaddle(const Eigen::Matrix3d& pixel_from_tag, std::size_t corner) const;
  std::array<bool, 4> PlainCorners(const Eigen::Matrix3d& pixel_from_tag) const;
  void MeasureSaddle(const Eigen::Matrix3d& pixel_from_tag, std::size_t corner, SeenTag& tag) const;
  void MeasurePlain(const std::array<bool, 4>& is_plain, SeenTag& tag) const;
  std::optional<TagDetection> FitTag(const SeenTag& tag, double exponent, double floor_px,
                                     int max_pixels) const;
  double BestExponent(const std::vector<SeenTag>& tags) const;

  const ImagePlane& grey_;
  double spacing_ = 0;  // tag sizes
  double border_ = 0;   // width of the black border, tag sizes
  int first_id_ = 0;
  RefineTagCornersOptions refine_;
  Camera lens_;          // describes how lines bend; not a calibration
  double exponent_ = 1;  // linear = counts^exponent
};

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_BOARDS_GRID_CORNERS_H_
