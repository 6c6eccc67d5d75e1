// Where tags hang that nobody surveyed, from their size and the photos alone.
//
// From tag to view to tag: a view is placed by the tags that are, a tag by the views that are (both poses
// that one square allows, the one that all its views agree on). Where features are given, tags are
// triangulated in their frame instead if that places more of them: features connect views that share no tag.
// The frame is that of one tag, the one that most views can tell the pose of: origin at its centre, x along
// its normal, z along its up. Scale is the tags' size.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_TAG_MAPPING_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_TAG_MAPPING_H_

#include <map>
#include <string>
#include <vector>

#include "calib/register/feature_model.h"
#include "calib/register/internal/bundle_adjustment.h"

namespace luxfit {

struct TagMap {
  std::vector<SurveyedTag> tags;
  int frame_tag = -1;                                       // -1: no tag could be placed
  std::map<std::string, Eigen::Isometry3d> cam_from_world;  // of the views that the tags place, by name
};

TagMap MapTags(const BundleContext& context, const std::vector<ViewDetections>& detections,
               const FeatureModel& features);

// Takes the tags that are not in the map out of the detections, and names them.
std::vector<ViewDetections> OnlyPlaced(const TagMap& map, const std::vector<ViewDetections>& detections,
                                       std::vector<RegistrationNote>& notes);

// The square nearest to four corners in the house's order, of the size of their mean side.
SurveyedTag TagOfCorners(int id, const std::array<Eigen::Vector3d, 4>& corners);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_TAG_MAPPING_H_
