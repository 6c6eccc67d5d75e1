// Finds the place of a reconstruction from features in the frame of the tag survey.
//
//   min over world_from_model of sum rho(|Project(cam_from_model * model_from_world * corner) - corner_px|^2
//                                        / sigma^2)
// by Gauss-Newton with Huber weights. The corners of every surveyed tag that two of its views show are
// triangulated in the model's frame. One tag or a pair of them proposes a similarity (Umeyama), and so does a
// pair of views whose poses the tags gave. The proposal under which most detections agree is fitted to all
// that agree.
//
// Returns nothing where fewer than two detections agree, or fewer than half of those in the model's views.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_FEATURE_ALIGNMENT_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_FEATURE_ALIGNMENT_H_

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calib/register/feature_model.h"
#include "calib/register/internal/bundle/bundle_adjustment.h"

namespace luxfit {

struct FeatureAlignment {
  Similarity world_from_model;
  int detections = 0;  // detections of surveyed tags in the model's views
  int agreeing = 0;
};

// Returns the alignment. `views` are all views of the adjustment, active where the tags gave a pose;
// `view_of` maps a view of the model to its index there.
std::optional<FeatureAlignment> AlignToTags(const BundleContext& context,
                                            const std::vector<BundleView>& views,
                                            const FeatureModel& features,
                                            const std::vector<std::size_t>& view_of);

// Marks the view's tags that agree with a pose that is not theirs, within 6 sigma and a seventh of their
// side.
std::vector<bool> AgreeingTags(const BundleContext& context, const BundleView& view,
                               const Eigen::Isometry3d& cam_from_world);

// Holds the corners of a tag in the model's frame, where two views with parallax show it and agree.
struct TriangulatedTag {
  const TagObservation* tag = nullptr;  // one observation of it: id, size, survey
  Eigen::Matrix<double, 3, 4> corners_in_model;
};
std::vector<TriangulatedTag> TriangulateTags(const BundleContext& context,
                                             const std::vector<BundleView>& views,
                                             const FeatureModel& features,
                                             const std::vector<std::size_t>& view_of);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_FEATURE_ALIGNMENT_H_
