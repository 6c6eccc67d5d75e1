// Finds by file names which images were taken together: the sets of a rig.
//
//   names    images of equal file name in the folders of two cameras: left/a.jpg and right/a.jpg
//   numbers  images whose names hold the same number: left01.jpg and right01.jpg, cam0/0007.png and
//            cam1/0007.png. The number is the last run of digits in the name before its extension.
//   order    the first images of all cameras, the second ones, ...
//   none     every image stands for itself
//   auto     names, else numbers, where they tell every image of a camera apart and at least three pair up; else none
//
// Source: docs/session-format.md, "Calibration".
#ifndef LUXFIT_APPS_STAGES_INTERNAL_CALIBRATION_SETS_H_
#define LUXFIT_APPS_STAGES_INTERNAL_CALIBRATION_SETS_H_

#include <string>
#include <vector>

namespace luxfit {

struct ImageSets {
  bool is_rig = false;                 // some images share a set
  std::vector<std::vector<int>> sets;  // by camera and image; images of equal number were taken together
  std::string rule = "none";           // the one that was followed: names, numbers, order or none
};

// `files` are by camera. `rule` is one of the above.
ImageSets PairImages(const std::vector<std::vector<std::string>>& files, const std::string& rule);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_INTERNAL_CALIBRATION_SETS_H_
