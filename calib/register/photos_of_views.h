// Finds photos that show another view than given, by the tags in them.
//
//   a tag of a photo fits a view: two or more of the view's other photos show its four corners within 3 px
//
// Photos of one view share one pose, so their tags lie at the same pixels. A photo shows another view where none of its tags
// fits its own, whose other photos agree on a tag, and more than half of its tags fit the other. Photos without tags, and
// views of fewer than three photos with tags, tell nothing. Source: own.
#ifndef LUXFIT_CALIB_REGISTER_PHOTOS_OF_VIEWS_H_
#define LUXFIT_CALIB_REGISTER_PHOTOS_OF_VIEWS_H_

#include <cstddef>
#include <vector>

#include "calib/targets/tags.h"

namespace luxfit {

struct PhotoTags {
  int view = 0;  // as given
  std::vector<TagDetection> tags;
};

struct PhotoOfOtherView {
  std::size_t photo = 0;  // index into the photos
  int as_if = 0;          // view that it shows
  int tags = 0;           // that fit that view
};

std::vector<PhotoOfOtherView> FindPhotosOfOtherViews(const std::vector<PhotoTags>& photos);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_PHOTOS_OF_VIEWS_H_
