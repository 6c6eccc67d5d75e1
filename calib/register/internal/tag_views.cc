#include "calib/register/internal/tag_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>

#include "calib/register/internal/bundle/pose_start.h"
#include "calib/register/internal/leave_out.h"

namespace luxfit {
namespace {

BundleView ToView(const ViewDetections& detections, const std::map<int, SurveyedTag>& survey,
                  std::map<int, std::vector<std::string>>& unknown, std::vector<RegistrationNote>& notes) {
  BundleView view;
  view.name = detections.view;
  view.camera = detections.camera;
  std::map<int, int> times_seen;
  for (const TagDetection& tag : detections.tags) ++times_seen[tag.id];
  for (const auto& [id, times] : times_seen) {
    if (times < 2) continue;
    notes.push_back({view.name, id, "tag_duplicated",
                     "Tag " + std::to_string(id) + " is seen " + std::to_string(times) + " times in view " +
                         view.name + "; it is left out there.",
                     "Hang each tag id once, or remove copies and mirrors from view."});
  }
  for (const TagDetection& detection : detections.tags) {
    const auto surveyed = survey.find(detection.id);
    if (surveyed == survey.end()) {
      std::vector<std::string>& seen_in = unknown[detection.id];
      if (seen_in.empty() || seen_in.back() != view.name) seen_in.push_back(view.name);
      continue;
    }
    if (times_seen[detection.id] > 1) continue;
    if (!(detection.corner_sigma_px > 0)) {
      throw std::invalid_argument("RegisterViews: view " + view.name + ": expected corner_sigma_px > 0");
    }
    view.tags.push_back({detection.id, surveyed->second.size_m, detection.side_px, detection.corner_sigma_px,
                         TagCornersInWorld(surveyed->second), detection.corners_px});
  }
  view.used.assign(view.tags.size(), false);
  return view;
}

std::vector<TagObservation> Without(const std::vector<TagObservation>& tags, const std::set<int>& left_out) {
  std::vector<TagObservation> kept;
  for (const TagObservation& tag : tags) {
    if (left_out.count(tag.id) == 0) kept.push_back(tag);
  }
  return kept;
}

// Returns the pose that each view's own tags give, with all of them counted.
std::vector<PoseStart> StartsOf(const BundleContext& context, const std::vector<BundleView>& views,
                                const PoseStartOptions& options) {
  std::vector<PoseStart> starts;
  starts.reserve(views.size());
  for (const BundleView& view : views)
    starts.push_back(EstimatePoseStart(context.CameraOf(view), view.tags, options));
  return starts;
}

// Returns the tags that more views contradict than confirm, by views in which at least two tags agree on a
// pose.
std::set<int> FindMovedTags(const std::vector<BundleView>& views, const std::vector<PoseStart>& starts) {
  std::map<int, int> balance;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const PoseStart& start = starts[v];
    if (start.status != PoseStartStatus::kOk ||
        std::count(start.agrees.begin(), start.agrees.end(), true) < 2)
      continue;
    for (std::size_t i = 0; i < start.agrees.size(); ++i)
      balance[views[v].tags[i].id] += start.agrees[i] ? 1 : -1;
  }
  std::set<int> moved;
  for (const auto& [id, votes] : balance) {
    if (votes < 0) moved.insert(id);
  }
  return moved;
}

// Returns the place of a tag by its size alone, seen from a view whose other tags give its pose.
Eigen::Vector3d PlaceSeen(const BundleContext& context, const BundleView& view, const PoseStart& start,
                          const TagObservation& tag, const PoseStartOptions& options) {
  TagObservation alone = tag;
  const Eigen::Vector3d center = TagCenter(tag);
  for (Eigen::Vector3d& corner : alone.corners_in_world) corner -= center;
  // The two poses of a plane that may be confused have almost the same centre.
  const PoseStart of_tag = EstimatePoseStart(context.CameraOf(view), {alone}, options);
  return start.cam_from_world.inverse() * of_tag.cam_from_world.translation();
}

struct Sighting {
  std::string view;
  Eigen::Vector3d center_in_world;
  double distance_m = 0;
};

// Returns the sightings of each tag that contradict its survey, from views that at least two other tags
// place.
std::map<int, std::vector<Sighting>> Contradictions(const BundleContext& context,
                                                    const std::vector<BundleView>& views,
                                                    const std::vector<PoseStart>& starts,
                                                    const PoseStartOptions& options) {
  std::map<int, std::vector<Sighting>> sightings;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const PoseStart& start = starts[v];
    if (start.status != PoseStartStatus::kOk ||
        std::count(start.agrees.begin(), start.agrees.end(), true) < 2)
      continue;
    for (std::size_t i = 0; i < start.agrees.size(); ++i) {
      if (start.agrees[i]) continue;
      const TagObservation& tag = views[v].tags[i];
      const Eigen::Vector3d place = PlaceSeen(context, views[v], start, tag, options);
      if (place.allFinite())
        sightings[tag.id].push_back({views[v].name, place, (start.cam_from_world * place).norm()});
    }
  }
  return sightings;
}

// Returns the views of the sightings that see the tag where the first one does.
std::vector<std::string> ViewsOfOnePlace(const std::vector<Sighting>& sightings) {
  std::vector<std::string> views{sightings.front().view};
  for (std::size_t i = 1; i < sightings.size(); ++i) {
    const double apart_m = (sightings[i].center_in_world - sightings.front().center_in_world).norm();
    constexpr double kPart = 0.05;  // error of a place from a tag's size, over the distance
    if (apart_m < kPart * (sightings[i].distance_m + sightings.front().distance_m))
      views.push_back(sightings[i].view);
  }
  return views;
}

// Names tags that hang where the survey says and also in a second place.
void NameCopies(const BundleContext& context, const std::vector<BundleView>& views,
                const std::vector<PoseStart>& starts, const std::set<int>& moved,
                const PoseStartOptions& options, std::vector<RegistrationNote>& notes) {
  for (const auto& [id, sightings] : Contradictions(context, views, starts, options)) {
    if (moved.count(id) > 0) continue;
    const std::vector<std::string> in = ViewsOfOnePlace(sightings);
    if (in.size() < 2) continue;  // one bad detection is no second tag
    const Eigen::Vector3d& place = sightings.front().center_in_world;
    notes.push_back({"", id, "tag_duplicated",
                     fmt::format("Tag {} hangs in two places: where the survey says, and (in {}) at about "
                                 "({:.2f}, {:.2f}, {:.2f}); it is left out there.",
                                 id, fmt::join(in, ", "), place.x(), place.y(), place.z()),
                     "Hang each tag id once, or take the copy down."});
  }
}

RegistrationNote StartNote(const BundleView& view, const PoseStart& start) {
  if (start.status == PoseStartStatus::kAmbiguous) {
    return {
        view.name, -1, "pose_ambiguous",
        "View " + view.name +
            " sees its tags so frontally or so small that two poses fit them equally well; it is left out.",
        "Show the view another tag, on another surface, or take it closer and more obliquely."};
  }
  if (start.status == PoseStartStatus::kConflict) {
    return {view.name, -1, "view_disagrees",
            "No two tags of view " + view.name + " agree on a pose; it is left out.",
            "See whether a tag was moved or its survey is wrong, and whether the camera of the view is the "
            "right one."};
  }
  return {view.name, -1, "no_tags",
          "View " + view.name + " shows no surveyed tag that can be used; it is left out.",
          "Hang a tag where the view sees it, at least 40 pixels a side, or leave the view's photos out."};
}

}  // namespace

std::map<int, SurveyedTag> IndexSurvey(const std::vector<SurveyedTag>& survey) {
  std::map<int, SurveyedTag> by_id;
  for (const SurveyedTag& tag : survey) {
    if (!by_id.emplace(tag.id, tag).second) {
      throw std::invalid_argument("RegisterViews: survey: tag " + std::to_string(tag.id) + " appears twice");
    }
    if (!(tag.size_m > 0)) {
      throw std::invalid_argument("RegisterViews: survey: tag " + std::to_string(tag.id) +
                                  ": expected size_m > 0");
    }
  }
  return by_id;
}

std::vector<BundleView> ViewsOf(const BundleContext& context, const std::map<int, SurveyedTag>& survey,
                                const std::vector<ViewDetections>& detections,
                                std::vector<RegistrationNote>& notes) {
  std::vector<BundleView> views;
  std::map<int, std::vector<std::string>> unknown;
  for (const ViewDetections& view : detections) {
    if (view.camera < 0 || view.camera >= static_cast<int>(context.cameras.size())) {
      throw std::invalid_argument("RegisterViews: view " + view.view + ": camera: expected 0 to " +
                                  std::to_string(static_cast<int>(context.cameras.size()) - 1) + ", got " +
                                  std::to_string(view.camera));
    }
    views.push_back(ToView(view, survey, unknown, notes));
  }
  for (const auto& [id, seen_in] : unknown) {
    notes.push_back({"", id, "tag_unknown",
                     fmt::format("Tag {} is seen (in {}) but is not in the survey; it is left out.", id,
                                 fmt::join(seen_in, ", ")),
                     "Add it to the tag survey, or take it down."});
  }
  return views;
}

void StartViews(const BundleContext& context, std::vector<BundleView>& views,
                std::vector<RegistrationNote>& notes) {
  PoseStartOptions options;
  options.survey_sigma_m = context.options.survey_sigma_m;
  std::vector<PoseStart> starts = StartsOf(context, views, options);
  const std::set<int> moved = FindMovedTags(views, starts);
  for (const int id : moved) notes.push_back(TagDisagrees(id));
  NameCopies(context, views, starts, moved, options, notes);
  for (std::size_t v = 0; v < views.size(); ++v) {
    BundleView& view = views[v];
    const std::size_t before = view.tags.size();
    view.tags = Without(view.tags, moved);
    if (view.tags.size() < before) starts[v] = EstimatePoseStart(context.CameraOf(view), view.tags, options);
    view.used = starts[v].agrees;
    view.active = starts[v].status == PoseStartStatus::kOk;
    if (view.active) {
      view.SetCamFromWorld(starts[v].cam_from_world);
    } else {
      notes.push_back(StartNote(view, starts[v]));
    }
  }
}

void DropStartNotes(const std::string& view, std::vector<RegistrationNote>& notes) {
  notes.erase(std::remove_if(notes.begin(), notes.end(),
                             [&view](const RegistrationNote& note) {
                               return note.view == view &&
                                      (note.code == "no_tags" || note.code == "pose_ambiguous" ||
                                       note.code == "view_disagrees");
                             }),
              notes.end());
}

}  // namespace luxfit
