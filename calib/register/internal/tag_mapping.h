// Finds the places of unsurveyed tags from their size and the photos alone.
//
// The map grows from tag to view to tag: placed tags place a view, placed views place a tag. One square
// allows two poses; the one that all views of the tag agree on is taken. Where features are given, tags are
// triangulated in their frame instead if that places more of them: features connect views that share no tag.
//
// The frame is that of one tag, whose pose most views determine: origin at its centre, x along its normal, z
// along its up. Scale is the tags' size.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_TAG_MAPPING_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_TAG_MAPPING_H_

#include <map>
#include <string>
#include <vector>

#include "calib/register/feature_model.h"
#include "calib/register/internal/bundle/bundle_adjustment.h"

namespace luxfit {

struct TagMap {
  std::vector<SurveyedTag> tags;
  int frame_tag = -1;                                       // -1: no tag could be placed
  std::map<std::string, Eigen::Isometry3d> cam_from_world;  // views that the tags place, by name
};

// Returns the map of the tags; `frame_tag` -1 where no tag could be placed.
TagMap MapTags(const BundleContext& context, const std::vector<ViewDetections>& detections,
               const FeatureModel& features);

// Removes from the detections the tags that are not in the map, and names them.
std::vector<ViewDetections> OnlyPlaced(const TagMap& map, const std::vector<ViewDetections>& detections,
                                       std::vector<RegistrationNote>& notes);

// Returns the square nearest to four corners in the project's order, of the size of their mean side.
SurveyedTag TagOfCorners(int id, const std::array<Eigen::Vector3d, 4>& corners);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_TAG_MAPPING_H_
