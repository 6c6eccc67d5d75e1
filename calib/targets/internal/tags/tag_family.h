// Makes a tag family of libapriltag, owned, and draws the picture of each of its tags.
//
// The picture is `total_cells` x `total_cells` cells, row t down, column s right, 1 white and 0 black, as
// AprilTag's own images show it. The black square (whose corners are detected) spans cells [border_begin,
// border_end) both ways.
//
// Families are defined with a border one cell wide; border_bits widens it (Kalibr's AprilGrids have 2).
//
// Throws std::invalid_argument for an unknown family name, an id that the family does not have, and
// border_bits < 1.
#ifndef LUXFIT_CALIB_TARGETS_INTERNAL_TAGS_TAG_FAMILY_H_
#define LUXFIT_CALIB_TARGETS_INTERNAL_TAGS_TAG_FAMILY_H_

#include <apriltag/apriltag.h>

#include <Eigen/Core>
#include <memory>
#include <string>

namespace luxfit {

using TagFamilyPtr = std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)>;

TagFamilyPtr MakeTagFamily(const std::string& name);

struct TagPicture {
  Eigen::ArrayXXd cells;
  int border_begin = 0;
  int border_end = 0;
  int total_cells() const { return static_cast<int>(cells.rows()); }
};
TagPicture DrawTag(const apriltag_family_t& family, int id, int border_bits = 1);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_INTERNAL_TAGS_TAG_FAMILY_H_
