#include "apps/stages/register/choose_registration.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "apps/session/session_scene.h"
#include "apps/stages/register/colmap_run.h"
#include "apps/stages/register/lay_on_mesh.h"
#include "apps/stages/register/view_features.h"
#include "apps/text/process.h"
#include "inverse/observe/scene_surface.h"

namespace luxfit {
namespace {

// Evidence that agrees moves a pose by less than its sigma.
constexpr double kMaxDisagreementSigmas = 2;
constexpr double kMaxSigmaOfWorst =
    2;  // sigma of a view that only features place, over the worst that tags place

// Holds what is known of the session's views, and registers them by each method.
class RegistrationJob {
 public:
  RegistrationJob(const Session& session, const LinearizedPhotos& photos, const std::vector<Camera>& cameras,
                  const ViewPhotos& views, std::vector<ViewDetections> detections, RunContext& context)
      : session_(session),
        photos_(photos),
        cameras_(cameras),
        views_(views),
        context_(context),
        detections_(std::move(detections)) {
    if (HasTags()) ExpectTags();
  }

  bool HasTags() const { return luxfit::HasTags(session_); }
  bool HasModel() const { return !session_.registration.colmap_model.empty(); }

  bool HasStart() const { return !session_.registration.start_positions_m.empty(); }

  Registration ByTags() const {
    return InScene(RegisterViews(cameras_, session_.tags.survey, detections_, Options()));
  }

  // Registers by features alone, laid onto the mesh.
  Registration ByFeatures() const { return RegisterOnMesh(session_, cameras_, detections_, Features({})); }

  // `tags` is the registration by tags alone, from which COLMAP starts.
  Registration ByBoth(const Registration& tags) const {
    return InScene(RegisterViews(cameras_, session_.tags.survey, detections_, Features(tags), Options()));
  }

  size_t ViewCount() const { return detections_.size(); }

  void Choose(const std::string& chosen, const std::vector<std::string>& among,
              const std::string& because) const {
    context_.choices.push_back({"registration", chosen, among, because});
  }

  void Warn(const std::string& code, const std::string& message, const std::string& remedy) const {
    context_.warnings.push_back({code, message, remedy});
  }

 private:
  RegisterViewsOptions Options() const {
    RegisterViewsOptions options;
    if (session_.tags.survey.empty()) {
      options.tag_size_m = session_.tags.size_m;
    } else if (session_.scene) {
      options.surface = SurfaceOf(SceneOf(*session_.scene));
    }
    return options;
  }

  // Tags without a survey have a frame of their own; the mesh has the scene's.
  Registration InScene(const Registration& registration) const {
    if (!session_.tags.survey.empty() || !registration.IsUsable()) return registration;
    if (HasStart()) return LaidOnMesh(session_, registration);
    Warn("frame_of_tags",
         "Without a tag map the poses are in the frame of the tags (" + registration.frame +
             "), not of the scene.",
         "Give [registration] start = { v00 = [x, y, z], ... }: roughly where three cameras or more stood.");
    return registration;
  }

  void ExpectTags() const {
    size_t tags = 0;
    for (const ViewDetections& view : detections_) tags += view.tags.size();
    if (tags > 0) return;
    throw std::runtime_error(
        fmt::format("{}: tags: expected tags of family \"{}\" in the photos, found no tag in any view; "
                    "check tags.family and that tags are at least 16 px wide, sharp and unsaturated",
                    session_.path, session_.tags.family));
  }

  FeatureModel Features(const Registration& tags) const {
    if (HasModel()) return ReadFeatures(session_, photos_, cameras_, views_);
    FeatureModel features = RunFeatures(photos_, cameras_, views_, detections_, tags, context_);
    if (features.views.empty())
      Warn("colmap_no_model", "COLMAP found too few matches between the photos for a model.",
           "Take photos that overlap by two thirds, or hang more tags; OUT/stages/colmap/colmap.log has "
           "COLMAP's "
           "own words.");
    return features;
  }

  const Session& session_;
  const LinearizedPhotos& photos_;
  const std::vector<Camera>& cameras_;
  const ViewPhotos& views_;
  RunContext& context_;
  std::vector<ViewDetections> detections_;
};

// Returns how far features move the camera centres that the tags gave, in sigmas of the tags: rms per axis
// over the views that both have. The value is about 1 or less where the two agree.
double FeaturesAgainstTags(const Registration& tags, const Registration& both) {
  double sum = 0, count = 0;
  for (const RegisteredView& by_tags : tags.views) {
    for (const RegisteredView& by_both : both.views) {
      if (by_both.view != by_tags.view) continue;
      const Eigen::Vector3d moved_m =
          by_both.cam_from_world.inverse().translation() - by_tags.cam_from_world.inverse().translation();
      sum += moved_m.dot(by_tags.covariance.bottomRightCorner<3, 3>().ldlt().solve(moved_m));
      count += 3;
    }
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

bool HasView(const Registration& registration, const std::string& view) {
  return std::any_of(registration.views.begin(), registration.views.end(),
                     [&view](const RegisteredView& other) { return other.view == view; });
}

// Leaves out, and names, the views that features alone place, and much worse than tags place any view. Such
// views have few matches, seen from far away, and mislead.
void LeaveOutPoorlyPlaced(const Registration& tags, Registration& both) {
  double worst_by_tags_m = 0;
  for (const RegisteredView& view : tags.views)
    worst_by_tags_m = std::max(worst_by_tags_m, view.position_sigma_m.norm());
  std::vector<bool> is_kept;
  is_kept.reserve(both.views.size());
  for (const RegisteredView& view : both.views) {
    is_kept.push_back(HasView(tags, view.view) ||
                      view.position_sigma_m.norm() <= kMaxSigmaOfWorst * worst_by_tags_m);
    if (is_kept.back()) continue;
    both.notes.push_back(
        {view.view, -1, "pose_uncertain",
         fmt::format("Features leave the place of view {} uncertain by {:.0f} mm; it is left out.", view.view,
                     1000 * view.position_sigma_m.norm()),
         "Show the view more tags, or take photos that overlap more with it."});
  }
  KeepViews(is_kept, both);
}

Registration Auto(const RegistrationJob& job) {
  const std::vector<std::string> among{"tags", "both"};
  Registration tags = job.ByTags();
  if (tags.views.size() == job.ViewCount()) {
    job.Choose("tags", among, "tags register every view: nothing more is needed");
    return tags;
  }
  const std::string left_out =
      fmt::format("tags register {} of {} views", tags.views.size(), job.ViewCount());
  if (!job.HasModel() && !IsInstalled("colmap")) {
    job.Choose("tags", among, left_out + ", and COLMAP is not installed");
    job.Warn("colmap_missing", "COLMAP is not installed: views that the tags leave out stay out.",
             "Install the package colmap, or give [registration] colmap = the folder of a model.");
    return tags;
  }
  Registration both;
  try {
    both = job.ByBoth(tags);
  } catch (const ColmapFailed& error) {
    job.Choose("tags", among, left_out + ", and COLMAP failed");
    job.Warn("colmap_failed", error.what(), "See COLMAP's log; method = \"tags\" does without it.");
    return tags;
  }
  const double disagreement_sigmas = FeaturesAgainstTags(tags, both);
  if (!(disagreement_sigmas <= kMaxDisagreementSigmas)) {
    const std::string message =
        fmt::format("features move the cameras that the tags gave by {:.1f} of the tags' sigmas (rms)",
                    disagreement_sigmas);
    job.Choose("tags", among, left_out + "; " + message);
    job.Warn("features_disagree", "COLMAP's " + message + "; views that the tags leave out stay out.",
             "Hang a tag where these views see it; features of shadows, reflections and bare walls mislead.");
    return tags;
  }
  LeaveOutPoorlyPlaced(tags, both);
  if (both.views.size() > tags.views.size()) {
    job.Choose("both", among, fmt::format("{}, with features {}", left_out, both.views.size()));
    return both;
  }
  job.Choose("tags", among, left_out + ", features no more that are well placed");
  return tags;
}

}  // namespace

Registration ChooseRegistration(const Session& session, const LinearizedPhotos& photos,
                                const std::vector<Camera>& cameras, const ViewPhotos& views,
                                std::vector<ViewDetections> detections, RunContext& context) {
  const RegistrationJob job(session, photos, cameras, views, std::move(detections), context);
  const std::string& method = session.registration.method;
  const bool by_features_alone = method == "colmap" && job.HasStart();
  if (!job.HasTags() && (method == "tags" || method == "both"))
    throw std::runtime_error(session.path +
                             ": tags.map: expected a tag map or the tags' size for registration by " +
                             method + ", got neither; add [tags] with map = \"tags.json\"");
  if (!job.HasTags() || by_features_alone) {
    job.Choose(
        "colmap", {"colmap"},
        by_features_alone ? "asked for by registration.method" : "there are neither tag map nor tag size");
    return job.ByFeatures();
  }
  if (method == "auto") return Auto(job);
  job.Choose(method, {method}, "asked for by registration.method");
  const Registration tags = job.ByTags();
  return method == "tags" ? tags : job.ByBoth(tags);
}

}  // namespace luxfit
