#include "calib/register/internal/feature_views.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "calib/register/internal/feature_alignment.h"
#include "calib/register/internal/tag_views.h"

namespace luxfit {
namespace {

RegistrationNote Unaligned(const FeatureModel& features) {
  return {"", -1, "features_unaligned",
          "The reconstruction from features (" + std::to_string(features.views.size()) + " views, " +
              std::to_string(features.tracks.size()) +
              " points) does not fit the surveyed tags under any similarity; it is left out.",
          "Let two of its views show a common surveyed tag, and see whether it shows this room with this "
          "camera."};
}

RegistrationNote Disagrees(const BundleView& view) {
  return {
      view.name, -1, "features_disagree",
      "The features put view " + view.name + " where its tags contradict it; its tags alone place it.",
      "See whether the features matched repeated things (tiles, windows), or whether the tags were moved."};
}

// Takes the poses of the model's views in world; returns false for views that keep the pose of their tags.
std::vector<bool> TakePoses(const BundleContext& context, const FeatureModel& in_world,
                            const std::vector<std::size_t>& view_of, BundleAdjustment& adjustment,
                            std::vector<RegistrationNote>& notes) {
  std::vector<bool> taken(in_world.views.size(), true);
  for (std::size_t v = 0; v < in_world.views.size(); ++v) {
    BundleView& view = adjustment.views[view_of[v]];
    const Eigen::Isometry3d& cam_from_world = in_world.views[v].cam_from_model;
    const std::vector<bool> agrees = AgreeingTags(context, view, cam_from_world);
    const auto agreeing = std::count(agrees.begin(), agrees.end(), true);
    const auto by_tags = view.TagsUsed();
    if (view.active && by_tags >= 2 && 2 * agreeing < by_tags) {
      notes.push_back(Disagrees(view));
      taken[v] = false;
      continue;
    }
    DropStartNotes(view.name, notes);
    if (view.active && by_tags >= 2) view.by_tags = {view.used, view.pose};
    view.active = true;
    view.used = agrees;
    view.SetCamFromWorld(cam_from_world);
  }
  return taken;
}

// Returns whether the pixel is a tag corner that was given to COLMAP as a feature: the tag measures it
// already.
bool IsCornerOfTag(const BundleView& view, const Eigen::Vector2d& pixel) {
  constexpr double kSamePx = 0.02;  // pixels are rounded to floats on the way
  return std::any_of(view.tags.begin(), view.tags.end(), [&pixel](const TagObservation& tag) {
    return std::any_of(tag.corners_px.begin(), tag.corners_px.end(),
                       [&pixel](const Eigen::Vector2d& corner_px) {
                         return (corner_px - pixel).squaredNorm() < kSamePx * kSamePx;
                       });
  });
}

}  // namespace

std::vector<std::size_t> MatchViews(const std::vector<BundleView>& views, FeatureModel& features) {
  std::map<std::string, std::size_t> index;
  for (std::size_t i = 0; i < views.size(); ++i) index[views[i].name] = i;
  std::vector<std::size_t> view_of;
  std::vector<int> kept(features.views.size(), -1);
  std::vector<FeatureView> kept_views;
  for (std::size_t v = 0; v < features.views.size(); ++v) {
    const auto found = index.find(features.views[v].view);
    if (found == index.end()) continue;
    kept[v] = static_cast<int>(kept_views.size());
    kept_views.push_back(features.views[v]);
    view_of.push_back(found->second);
  }
  features.views = std::move(kept_views);
  for (FeatureTrack& track : features.tracks) {
    std::vector<FeatureObservation> seen;
    for (const FeatureObservation& observation : track.seen) {
      const int view = kept[static_cast<std::size_t>(observation.view)];
      if (view >= 0) seen.push_back({view, observation.pixel});
    }
    track.seen = std::move(seen);
  }
  return view_of;
}

void JoinFeatures(const BundleContext& context, FeatureModel features, BundleAdjustment& adjustment,
                  std::vector<RegistrationNote>& notes) {
  const std::vector<std::size_t> view_of = MatchViews(adjustment.views, features);
  const bool on_surface = std::any_of(features.tracks.begin(), features.tracks.end(),
                                      [](const FeatureTrack& track) { return track.surface.has_value(); });
  if (!on_surface) {
    const std::optional<FeatureAlignment> alignment =
        AlignToTags(context, adjustment.views, features, view_of);
    if (!alignment) {
      notes.push_back(Unaligned(features));
      return;
    }
    features = Moved(features, alignment->world_from_model);
  }
  const std::vector<bool> taken = TakePoses(context, features, view_of, adjustment, notes);
  for (const FeatureTrack& track : features.tracks) {
    const auto point = static_cast<int>(adjustment.points.size());
    adjustment.points.push_back({track.p_in_model, track.surface});
    for (const FeatureObservation& seen : track.seen) {
      const auto v = static_cast<std::size_t>(seen.view);
      BundleView& view = adjustment.views[view_of[v]];
      if (taken[v] && !IsCornerOfTag(view, seen.pixel)) view.points.push_back({point, seen.pixel, true});
    }
  }
}

}  // namespace luxfit
