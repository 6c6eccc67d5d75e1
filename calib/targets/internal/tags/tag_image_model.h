// Returns the picture of a tag averaged over small boxes, with derivatives.
//
//   Mean(s, t, w_s, w_t) = 1 / (w_s w_t) * integral of the picture over the box centred at (s, t), in cells
//
// The mean comes from the picture's double integral F, which is bilinear inside cells and so exact for boxes
// along the cells. The picture's outermost cells extend for kMargin cells beyond it.
//
// Source: Crow (1984), "Summed-area tables for texture mapping".
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_TAGS_TAG_IMAGE_MODEL_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_TAGS_TAG_IMAGE_MODEL_H_

#include <Eigen/Core>

#include "calib/targets/internal/tags/tag_family.h"

namespace luxfit {

class TagImageModel {
 public:
  struct Sample {
    double mean = 0;
    double d_s = 0, d_t = 0;  // per cell
    double d_width_s = 0, d_width_t = 0;
  };

  explicit TagImageModel(const TagPicture& picture);
  Sample Mean(double s, double t, double width_s, double width_t) const;

 private:
  static constexpr int kMargin = 3;  // cells
  struct Integral {
    double value = 0, d_s = 0, d_t = 0;
  };
  Integral IntegralTo(double s, double t) const;

  int size_ = 0;              // cells with margins
  Eigen::ArrayXXd integral_;  // size_ + 1 squared, at cell borders; (row t, column s)
};

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_TAGS_TAG_IMAGE_MODEL_H_
