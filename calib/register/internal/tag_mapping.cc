#include "calib/register/internal/tag_mapping.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "calib/register/internal/bundle/pose_start.h"
#include "calib/register/internal/feature_alignment.h"
#include "calib/register/internal/feature_views.h"
#include "calib/register/internal/tag_views.h"

namespace luxfit {
namespace {

SurveyedTag TagAtOrigin(int id, double size_m) {
  return {id, size_m, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ()};
}

// Returns views with every tag at the origin of its own frame.
std::vector<BundleView> UnplacedViews(const BundleContext& context,
                                      const std::vector<ViewDetections>& detections) {
  std::map<int, SurveyedTag> survey;
  for (const ViewDetections& view : detections) {
    for (const TagDetection& tag : view.tags)
      survey[tag.id] = TagAtOrigin(tag.id, context.options.tag_size_m);
  }
  std::vector<RegistrationNote> said_later;
  return ViewsOf(context, survey, detections, said_later);
}

// Returns options for starts. Chains of poses are off by millimetres before they are adjusted together; the
// corners of one tag are not.
PoseStartOptions StartOptions(std::size_t tags) {
  PoseStartOptions options;
  options.survey_sigma_m = tags > 1 ? 0.005 : 0;
  return options;
}

class Mapping {
 public:
  Mapping(const BundleContext& context, std::vector<BundleView> views)
      : context_(context), views_(std::move(views)), posed_(views_.size()) {}

  TagMap Run() {
    TagMap map;
    map.frame_tag = FrameTag();
    if (map.frame_tag < 0) return map;
    placed_[map.frame_tag] = TagAtOrigin(map.frame_tag, context_.options.tag_size_m);
    while (PlaceViews() || PlaceTags()) {
      Adjust();
      Revise();
    }
    for (const auto& [id, tag] : placed_) map.tags.push_back(tag);
    for (std::size_t v = 0; v < views_.size(); ++v) {
      if (posed_[v]) map.cam_from_world[views_[v].name] = *posed_[v];
    }
    return map;
  }

 private:
  // Returns the tag whose pose most views determine by it alone; ties go to the lower id.
  int FrameTag() const {
    std::map<int, int> told;
    for (const BundleView& view : views_) {
      for (const TagObservation& tag : view.tags) {
        if (EstimatePoseStart(context_.CameraOf(view), {tag}, StartOptions(1)).status == PoseStartStatus::kOk)
          ++told[tag.id];
      }
    }
    const auto most = std::max_element(told.begin(), told.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == told.end() ? -1 : most->first;
  }

  std::vector<TagObservation> Placed(const BundleView& view) const {
    std::vector<TagObservation> tags;
    for (TagObservation tag : view.tags) {
      const auto at = placed_.find(tag.id);
      if (at == placed_.end()) continue;
      tag.corners_in_world = TagCornersInWorld(at->second);
      tags.push_back(tag);
    }
    return tags;
  }

  bool PlaceViews() {
    bool any = false;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      if (posed_[v]) continue;
      const std::vector<TagObservation> placed = Placed(views_[v]);
      const PoseStart start =
          EstimatePoseStart(context_.CameraOf(views_[v]), placed, StartOptions(placed.size()));
      if (start.status != PoseStartStatus::kOk) continue;
      posed_[v] = start.cam_from_world;
      any = true;
    }
    return any;
  }

  // Returns how badly a placed tag fits the views that see it, each capped so that no bad detection decides
  // alone.
  double Cost(const SurveyedTag& tag) const {
    double cost = 0;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      if (!posed_[v]) continue;
      for (TagObservation seen : views_[v].tags) {
        if (seen.id != tag.id) continue;
        seen.corners_in_world = TagCornersInWorld(tag);
        const double sigma_px = seen.sigma_px + 0.003 * seen.side_px;  // the views' own poses are rough
        const double error = TagRmsPx(context_.CameraOf(views_[v]), *posed_[v], seen) / sigma_px;
        cost += std::min(100.0, 4 * error * error);
      }
    }
    return cost;
  }

  // Returns the best place of an unplaced tag, if it is distinct from the second best.
  std::optional<SurveyedTag> Place(int id) const {
    std::vector<std::pair<double, SurveyedTag>> places;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      if (!posed_[v]) continue;
      for (const TagObservation& seen : views_[v].tags) {
        if (seen.id != id) continue;
        for (const PoseCandidate& pose :
             PoseCandidates(context_.CameraOf(views_[v]), {seen}, StartOptions(1))) {
          std::array<Eigen::Vector3d, 4> corners;
          for (std::size_t i = 0; i < 4; ++i)
            corners[i] = posed_[v]->inverse() * (pose.cam_from_world * seen.corners_in_world[i]);
          SurveyedTag tag = TagOfCorners(id, corners);
          tag.size_m = context_.options.tag_size_m;
          places.emplace_back(Cost(tag), tag);
        }
      }
    }
    if (places.empty()) return std::nullopt;
    std::sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    constexpr double kSameNormal = 0.99;  // cosine: 8 degrees, less than the two poses of a square lie apart
    constexpr double kTold = 9;           // chi2
    for (const auto& [cost, tag] : places) {
      const bool is_same = tag.normal_in_world.dot(places.front().second.normal_in_world) > kSameNormal;
      if (!is_same && cost - places.front().first < kTold) return std::nullopt;
    }
    return places.front().second;
  }

  bool PlaceTags() {
    std::set<int> unplaced;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      if (!posed_[v]) continue;
      for (const TagObservation& tag : views_[v].tags) {
        if (placed_.count(tag.id) == 0) unplaced.insert(tag.id);
      }
    }
    bool any = false;
    for (const int id : unplaced) {
      if (const std::optional<SurveyedTag> tag = Place(id)) {
        placed_[id] = *tag;
        any = true;
      }
    }
    return any;
  }

  // Adjusts all that is placed so far together before more is added, since chains of poses bend.
  void Adjust() {
    BundleAdjustment adjustment;
    adjustment.fixed_tag = placed_.begin()->first;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      BundleView view = views_[v];
      view.tags = Placed(view);
      view.active = posed_[v].has_value();
      view.used.assign(view.tags.size(), view.active);
      if (view.active) view.SetCamFromWorld(*posed_[v]);
      adjustment.views.push_back(view);
    }
    SolveBundle(context_, adjustment);
    if (!adjustment.converged) return;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      const BundleView& view = adjustment.views[v];
      if (!view.active) continue;
      posed_[v] = view.CamFromWorld();
      for (const TagObservation& tag : view.tags) {
        const double size_m = placed_[tag.id].size_m;
        placed_[tag.id] = TagOfCorners(tag.id, AdjustedCorners(adjustment, tag));
        placed_[tag.id].size_m = size_m;
      }
    }
  }

  // Revises places: more views may show that a tag was taken in its other pose, or a view in its.
  void Revise() {
    for (auto& [id, tag] : placed_) {
      const std::optional<SurveyedTag> again = Place(id);
      constexpr double kBetter = 9;  // chi2
      if (again && Cost(*again) < Cost(tag) - kBetter) tag = *again;
    }
    for (std::size_t v = 0; v < views_.size(); ++v) {
      const std::vector<TagObservation> placed = Placed(views_[v]);
      if (!posed_[v] || placed.size() < 2) continue;
      const PoseStart start =
          EstimatePoseStart(context_.CameraOf(views_[v]), placed, StartOptions(placed.size()));
      if (start.status == PoseStartStatus::kOk) posed_[v] = start.cam_from_world;
    }
  }

  const BundleContext& context_;
  std::vector<BundleView> views_;
  std::vector<std::optional<Eigen::Isometry3d>> posed_;
  std::map<int, SurveyedTag> placed_;
};

// Returns tags triangulated between the views of a reconstruction, scaled by their size.
TagMap MapByFeatures(const BundleContext& context, const std::vector<BundleView>& views,
                     FeatureModel features) {
  const std::vector<std::size_t> view_of = MatchViews(views, features);
  TagMap map;
  double sides = 0;
  for (const TriangulatedTag& tag : TriangulateTags(context, views, features, view_of)) {
    std::array<Eigen::Vector3d, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = tag.corners_in_model.col(static_cast<Eigen::Index>(i));
    map.tags.push_back(TagOfCorners(tag.tag->id, corners));
    sides += map.tags.back().size_m;
  }
  if (map.tags.empty()) return map;
  map.frame_tag = map.tags.front().id;
  const SurveyedTag frame = map.tags.front();
  const double scale = context.options.tag_size_m * static_cast<double>(map.tags.size()) / sides;
  Eigen::Matrix3d frame_from_model;
  frame_from_model << frame.normal_in_world.transpose(),
      frame.up_in_world.cross(frame.normal_in_world).transpose(), frame.up_in_world.transpose();
  for (SurveyedTag& tag : map.tags) {
    tag.center_in_world = scale * (frame_from_model * (tag.center_in_world - frame.center_in_world));
    tag.normal_in_world = frame_from_model * tag.normal_in_world;
    tag.up_in_world = frame_from_model * tag.up_in_world;
    tag.size_m = context.options.tag_size_m;
  }
  return map;
}

}  // namespace

SurveyedTag TagOfCorners(int id, const std::array<Eigen::Vector3d, 4>& corners) {
  SurveyedTag tag;
  tag.id = id;
  tag.center_in_world = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
  const Eigen::Vector3d right = corners[1] + corners[2] - corners[0] - corners[3],
                        up = corners[0] + corners[1] - corners[2] - corners[3];
  tag.size_m = (right.norm() + up.norm()) / 4;
  tag.normal_in_world = right.cross(up).normalized();
  // The remaining skew is shared between right and up.
  tag.up_in_world = (up.normalized() + tag.normal_in_world.cross(right.normalized())).normalized();
  return tag;
}

TagMap MapTags(const BundleContext& context, const std::vector<ViewDetections>& detections,
               const FeatureModel& features) {
  const std::vector<BundleView> views = UnplacedViews(context, detections);
  TagMap by_tags = Mapping(context, views).Run();
  if (features.views.empty()) return by_tags;
  TagMap by_features = MapByFeatures(context, views, features);
  return by_features.tags.size() > by_tags.tags.size() ? by_features : by_tags;
}

std::vector<ViewDetections> OnlyPlaced(const TagMap& map, const std::vector<ViewDetections>& detections,
                                       std::vector<RegistrationNote>& notes) {
  std::set<int> placed, unplaced;
  for (const SurveyedTag& tag : map.tags) placed.insert(tag.id);
  std::vector<ViewDetections> kept = detections;
  for (ViewDetections& view : kept) {
    for (const TagDetection& tag : view.tags) {
      if (placed.count(tag.id) == 0) unplaced.insert(tag.id);
    }
    view.tags.erase(std::remove_if(view.tags.begin(), view.tags.end(),
                                   [&placed](const TagDetection& tag) { return placed.count(tag.id) == 0; }),
                    view.tags.end());
  }
  for (const int id : unplaced) {
    notes.push_back({"", id, "tag_unplaced",
                     "Tag " + std::to_string(id) +
                         " cannot be placed: no view that other tags place tells its pose; it is left out.",
                     "Take views that show it together with another tag, closer and more obliquely."});
  }
  return kept;
}

}  // namespace luxfit
