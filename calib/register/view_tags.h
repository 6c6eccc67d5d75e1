// Finds the tags of views, each from several photos of one pose.
//
// Several photos of one pose average noise and outvote a corner that one of them shows badly. The pixel grid's error
// is common to all of them: six are enough. Tags are best where light is even, so those of most light come first.
// A photo whose tags are those of another view (photos_of_views.h) is named, and its tags are in none. Source: own.
#ifndef LUXFIT_CALIB_REGISTER_VIEW_TAGS_H_
#define LUXFIT_CALIB_REGISTER_VIEW_TAGS_H_

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "calib/register/photos_of_views.h"
#include "calib/register/registration.h"
#include "calib/targets/tags.h"

namespace luxfit {

// Indices of photos, by view.
using PhotosOfViews = std::map<std::string, std::vector<std::size_t>>;

// Returns at most six photos of each view, those of most light first. `view`, `light` (any unit): one for each photo.
PhotosOfViews MostLitPhotos(const std::vector<std::string>& view, const std::vector<double>& light);

struct ViewTags {
  std::vector<ViewDetections> views;  // in the order of their names
  std::vector<PhotoOfOtherView>
      of_other_views;  // `photo` as PhotosOfViews has it, `as_if` an index into `views`
};

// Combines the tags of each view's photos. `camera`: one for each photo. `detect` returns the tags of a photo; any
// thread may call it.
ViewTags FindViewTags(const PhotosOfViews& photos, const std::vector<int>& camera,
                      const std::function<std::vector<TagDetection>(std::size_t photo)>& detect);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_VIEW_TAGS_H_
