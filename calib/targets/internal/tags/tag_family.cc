#include "calib/targets/internal/tags/tag_family.h"

#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h10.h>
#include <apriltag/tag36h11.h>
#include <apriltag/tagStandard41h12.h>

#include <stdexcept>

namespace luxfit {

TagFamilyPtr MakeTagFamily(const std::string& name) {
  if (name == "tag36h11") return {tag36h11_create(), tag36h11_destroy};
  if (name == "tag36h10") return {tag36h10_create(), tag36h10_destroy};
  if (name == "tag25h9") return {tag25h9_create(), tag25h9_destroy};
  if (name == "tag16h5") return {tag16h5_create(), tag16h5_destroy};
  if (name == "tagStandard41h12") return {tagStandard41h12_create(), tagStandard41h12_destroy};
  throw std::invalid_argument(
      "tag family: expected tag36h11, tag36h10, tag25h9, tag16h5 or tagStandard41h12, got \"" + name + "\"");
}

TagPicture DrawTag(const apriltag_family_t& family, int id, int border_bits) {
  if (id < 0 || id >= static_cast<int>(family.ncodes)) {
    throw std::invalid_argument("tag id: expected 0 to " + std::to_string(family.ncodes - 1) + " of " +
                                family.name + ", got " + std::to_string(id));
  }
  if (border_bits < 1) throw std::invalid_argument("DrawTag: border_bits: expected >= 1");
  TagPicture picture;
  const int more = border_bits - 1;
  const int total = family.total_width + 2 * more, square = family.width_at_border + 2 * more;
  picture.border_begin = (total - square) / 2;
  picture.border_end = picture.border_begin + square;
  // Outside the square is white, the square's border black; "reversed" families exchange the two.
  const double outside = family.reversed_border ? 0 : 1;
  picture.cells = Eigen::ArrayXXd::Constant(total, total, outside);
  picture.cells.block(picture.border_begin, picture.border_begin, square, square) = 1 - outside;
  const uint64_t code = family.codes[id];
  for (uint32_t bit = 0; bit < family.nbits; ++bit) {
    const int row = static_cast<int>(family.bit_y[bit]) + picture.border_begin + more;
    const int col = static_cast<int>(family.bit_x[bit]) + picture.border_begin + more;
    picture.cells(row, col) = static_cast<double>((code >> (family.nbits - bit - 1)) & 1u);
  }
  return picture;
}

}  // namespace luxfit
