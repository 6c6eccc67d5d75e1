#include "calib/register/internal/leave_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

namespace luxfit {
namespace {

constexpr std::ptrdiff_t kEnoughPoints = 20;  // as many outvote a tag
constexpr std::ptrdiff_t kFewestPoints = 6;   // as many hold a view that has no tags

std::ptrdiff_t CountUsed(const std::vector<PointObservation>& points) {
  return std::count_if(points.begin(), points.end(), [](const PointObservation& seen) { return seen.used; });
}

// Returns the worst tag that disagrees in every one of its views (at least two, or one where others outvote
// it); -1 where there is none.
int WorstTag(const BundleContext& context, const BundleAdjustment& adjustment) {
  struct Record {
    double least_sigmas = std::numeric_limits<double>::infinity();
    bool outvoted = true;  // every view of it has two more tags, or points
  };
  std::map<int, Record> records;
  for (const BundleView& view : adjustment.views) {
    if (!view.active) continue;
    const auto used = view.TagsUsed();
    for (std::size_t i = 0; i < view.tags.size(); ++i) {
      if (!view.used[i]) continue;
      Record& record = records[view.tags[i].id];
      record.least_sigmas =
          std::min(record.least_sigmas, BundleRmsSigmas(BundleTagErrors(context, adjustment, view, i)));
      record.outvoted = record.outvoted && (used >= 3 || CountUsed(view.points) >= kEnoughPoints);
    }
  }
  int worst = -1;
  double worst_sigmas = context.options.max_view_rms_sigmas * adjustment.scale;
  for (const auto& [id, record] : records) {
    double sigmas = record.least_sigmas;
    // A displacement that the survey's own sigma cannot explain counts as much as a bad corner.
    if (context.options.survey_sigma_m > 0 && adjustment.fixed_tag < 0) {
      sigmas =
          std::max(sigmas, adjustment.tags.at(id).displacement_m.norm() / context.options.survey_sigma_m);
    }
    if (record.outvoted && sigmas > worst_sigmas) {
      worst = id;
      worst_sigmas = sigmas;
    }
  }
  return worst;
}

BundleView* WorstView(const BundleContext& context, BundleAdjustment& adjustment) {
  BundleView* worst = nullptr;
  double worst_sigmas = context.options.max_view_rms_sigmas * adjustment.scale;
  for (BundleView& view : adjustment.views) {
    if (!view.active) continue;
    const double sigmas = BundleRmsSigmas(BundleViewErrors(context, adjustment, view));
    if (sigmas > worst_sigmas) {
      worst = &view;
      worst_sigmas = sigmas;
    }
  }
  return worst;
}

// Returns whether corners of tags that agree by themselves are rejected where the points have placed the view, more than those
// of one tag that was moved. Features of repeated things (desks in a row) agree with one another in a wrong place.
bool ContradictsItsTags(const BundleContext& context, const BundleAdjustment& adjustment,
                        const BundleView& view) {
  if (!view.by_tags) return false;
  constexpr int kCornersOfOneTag = 4;
  int rejected = 0;
  for (std::size_t i = 0; i < view.tags.size(); ++i) {
    if (!view.by_tags->used[i]) continue;
    for (const BundleCornerError& error : BundleTagErrors(context, adjustment, view, i))
      rejected += error.sigmas <= kBundleRejectedSigmas * adjustment.scale ? 0 : 1;
  }
  return rejected > kCornersOfOneTag;
}

// Returns a view with most of its points, or more than one of its tags, rejected: the features place it elsewhere than its
// tags and the other views do.
BundleView* AstrayView(const BundleContext& context, BundleAdjustment& adjustment) {
  for (BundleView& view : adjustment.views) {
    if (!view.active || view.points.empty()) continue;
    if (ContradictsItsTags(context, adjustment, view)) return &view;
    const std::ptrdiff_t used = CountUsed(view.points);
    const bool has_tags = view.TagsUsed() > 0;
    if (used > 0 && 2 * used < static_cast<std::ptrdiff_t>(view.points.size())) return &view;
    if (!has_tags && used < kFewestPoints) return &view;
  }
  return nullptr;
}

// Leaves out the view's points; its tags keep the view if it has any.
void LeaveOutPoints(BundleView& view, std::vector<RegistrationNote>& notes) {
  view.points.clear();
  if (view.by_tags) {
    view.used = view.by_tags->used;
    view.pose = view.by_tags->pose;
  }
  view.active = view.TagsUsed() > 0;
  notes.push_back({view.name, -1, "features_disagree",
                   "Most feature points of view " + view.name + " contradict its tags and the other views; " +
                       (view.active ? "its tags alone place it." : "it is left out."),
                   "See whether the view shows the same room, unchanged; hang a tag where it sees one."});
}

// Uses only the observations of points that are within `sigmas`; returns whether that changed any.
bool SelectObservations(const BundleContext& context, BundleAdjustment& adjustment, double sigmas) {
  bool any = false;
  for (BundleView& view : adjustment.views) {
    if (!view.active) continue;
    for (PointObservation& seen : view.points) {
      const bool fits = PointErrorPx(context, adjustment, view, seen) <= sigmas * adjustment.point_sigma_px;
      any = any || fits != seen.used;
      seen.used = fits;
    }
  }
  return any;
}

// Solves with points. Corners and points each weigh by their own residuals, which needs a solution first.
void SolveWithPoints(const BundleContext& context, BundleAdjustment& adjustment) {
  if (adjustment.points.empty()) {
    SolveBundle(context, adjustment);
    return;
  }
  RescaleBundle(context, adjustment);
  SelectObservations(context, adjustment, kBundleRejectedSigmas);
  SolveBundle(context, adjustment);
  constexpr int kMostRounds = 5;
  for (int round = 0; round < kMostRounds && adjustment.converged; ++round) {
    const double sigma_px = adjustment.point_sigma_px, scale = adjustment.corner_weight_scale;
    adjustment.corner_weight_scale = std::sqrt(adjustment.reduced_chi2);
    const bool changed = SelectObservations(context, adjustment, kBundleRejectedSigmas);
    SolveBundle(context, adjustment);
    constexpr double kSame = 0.02;  // relative, of sigmas
    if (!changed && std::abs(adjustment.point_sigma_px / sigma_px - 1) < kSame &&
        std::abs(adjustment.corner_weight_scale / scale - 1) < kSame)
      return;
  }
}

void LeaveOutTag(int id, BundleAdjustment& adjustment, std::vector<RegistrationNote>& notes) {
  for (BundleView& view : adjustment.views) {
    for (std::size_t i = 0; i < view.tags.size(); ++i) {
      if (view.tags[i].id != id) continue;
      view.used[i] = false;
      if (view.by_tags) view.by_tags->used[i] = false;
    }
  }
  notes.push_back(TagDisagrees(id));
}

}  // namespace

RegistrationNote TagDisagrees(int id) {
  return {"", id, "tag_disagrees",
          "Tag " + std::to_string(id) +
              " disagrees with the other tags in every view that can tell; it is left out.",
          "Measure its place, size and up direction again, or see whether it was moved."};
}

void SolveLeavingOut(const BundleContext& context, BundleAdjustment& adjustment,
                     std::vector<RegistrationNote>& notes) {
  while (true) {
    SolveWithPoints(context, adjustment);
    if (!adjustment.converged) return;
    const int tag = WorstTag(context, adjustment);
    if (tag >= 0) {
      LeaveOutTag(tag, adjustment, notes);
      continue;
    }
    if (BundleView* const astray = AstrayView(context, adjustment)) {
      LeaveOutPoints(*astray, notes);
      continue;
    }
    BundleView* const view = WorstView(context, adjustment);
    if (view == nullptr) return;
    notes.push_back(
        {view->name, -1, "view_disagrees",
         fmt::format("The corners of view {} disagree by {:.2g} sigma (rms); it is left out.", view->name,
                     BundleRmsSigmas(BundleViewErrors(context, adjustment, *view))),
         "See whether the camera moved between photos of this view, and whether it is the right camera."});
    view->active = false;
  }
}

}  // namespace luxfit
