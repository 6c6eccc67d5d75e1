#include "calib/register/internal/focal_check.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "calib/lens/internal/rotation_vector.h"
#include "calib/register/internal/bundle/pose_start.h"
#include "calib/register/internal/view_sample.h"

namespace luxfit {
namespace {

constexpr double kStep = 1e-3;  // in scale: steps of poses are far above the solver's tolerance
constexpr int kMostSteps = 12;  // steps of 4 %, within a tag's tolerance of a twentieth of its side
constexpr int kFewestTags = 4;  // fewer are no evidence against a lens

std::vector<Camera> WithScale(std::vector<Camera> cameras, int camera, double scale) {
  Camera& its = cameras[static_cast<std::size_t>(camera)];
  its = WithFocalScale(its, scale);
  return cameras;
}

// Returns the adjustment without features: views that see tags determine focal lengths, and cost little.
BundleAdjustment TagsOf(BundleAdjustment adjustment) {
  adjustment.points.clear();
  for (BundleView& view : adjustment.views) {
    view.points.clear();
    view.active = view.active && view.TagsUsed() > 0;
  }
  return adjustment;
}

BundleAdjustment SolvedAt(const BundleContext& context, BundleAdjustment adjustment, int camera,
                          double scale) {
  const std::vector<Camera> cameras = WithScale(context.cameras, camera, scale);
  SolveBundle({cameras, context.options}, adjustment);
  return adjustment;
}

std::map<std::string, Eigen::Matrix<double, 6, 1>> PoseDerivatives(const BundleAdjustment& below,
                                                                   const BundleAdjustment& above) {
  std::map<std::string, Eigen::Matrix<double, 6, 1>> derivatives;
  for (std::size_t v = 0; v < below.views.size(); ++v) {
    if (!below.views[v].active) continue;
    const Eigen::Isometry3d low = below.views[v].CamFromWorld().inverse(),
                            high = above.views[v].CamFromWorld().inverse();
    Eigen::Matrix<double, 6, 1> moved;
    moved << RotationVectorOf(high.linear() * low.linear().transpose()),
        high.translation() - low.translation();
    derivatives[below.views[v].name] = moved / (2 * kStep);
  }
  return derivatives;
}

// Brackets the place where the slope of a cost with one minimum changes its sign. Takes Newton's step until
// the minimum is enclosed, the secant from then on. (Far from the minimum a robust cost is nearly linear, and
// Newton's steps overshoot.)
struct Bracket {
  std::optional<std::pair<double, double>> below, above;  // place and slope

  double Next(double at, double slope, double curvature) {
    (slope < 0 ? below : above) = std::make_pair(at, slope);
    if (below && above)
      return below->first + (above->first - below->first) * below->second / (below->second - above->second);
    constexpr double kMostStep = 0.05;
    return at + std::clamp(-slope / curvature, -kMostStep, kMostStep);
  }
};

int CountAgreeing(const Camera& camera, const std::vector<BundleView>& views,
                  const PoseStartOptions& options) {
  int agreeing = 0;
  for (const BundleView& view : views) {
    const PoseStart start = EstimatePoseStart(camera, view.tags, options);
    agreeing += static_cast<int>(std::count(start.agrees.begin(), start.agrees.end(), true));
  }
  return agreeing;
}

}  // namespace

bool FocalScale::IsOff() const {
  constexpr double kSigmas = 4, kLeast = 1e-3;
  return std::abs(scale - 1) > std::max(kSigmas * sigma, kLeast);
}

std::optional<FocalScale> EstimateFocalScale(const BundleContext& context, const BundleAdjustment& solved,
                                             int camera) {
  int tags = 0;
  for (const BundleView& view : solved.views) {
    if (view.active && view.camera == camera) tags += view.TagsUsed();
  }
  if (tags < kFewestTags) return std::nullopt;
  FocalScale focal;
  BundleAdjustment at = TagsOf(solved);
  Bracket bracket;
  constexpr int kRounds = 15;
  for (int round = 0; round < kRounds; ++round) {
    at = SolvedAt(context, at, camera, focal.scale);
    const BundleAdjustment below = SolvedAt(context, at, camera, focal.scale - kStep),
                           above = SolvedAt(context, at, camera, focal.scale + kStep);
    if (!at.converged || !below.converged || !above.converged) return std::nullopt;
    const double slope = (above.cost - below.cost) / (2 * kStep),
                 curvature = (above.cost - 2 * at.cost + below.cost) / (kStep * kStep);
    if (!(curvature > 0)) return std::nullopt;
    focal.sigma = std::sqrt(at.reduced_chi2 / curvature);
    focal.pose_derivatives = PoseDerivatives(below, above);
    const double next = bracket.Next(focal.scale, slope, curvature);
    if (std::abs(next - focal.scale) < focal.sigma / 4) return focal;
    focal.scale = next;
  }
  return std::nullopt;
}

double FindFocalScale(const BundleContext& context, const std::vector<BundleView>& views, int camera) {
  std::vector<BundleView> its;
  std::copy_if(views.begin(), views.end(), std::back_inserter(its),
               [camera](const BundleView& view) { return view.camera == camera; });
  its = SampleOf(its);
  int tags = 0;
  for (const BundleView& view : its) tags += static_cast<int>(view.tags.size());
  if (tags < kFewestTags) return 1;
  PoseStartOptions options;
  options.survey_sigma_m = context.options.survey_sigma_m;
  const Camera& as_given = context.cameras[static_cast<std::size_t>(camera)];
  const int agreeing_as_given = CountAgreeing(as_given, its, options);
  if (10 * agreeing_as_given >= 9 * tags) return 1;
  int most = 0;
  double log_sum = 0, found = 0;
  for (int step = -kMostSteps; step <= kMostSteps; ++step) {
    const double log_scale = step * std::log(1.04);
    const int agreeing = CountAgreeing(WithFocalScale(as_given, std::exp(log_scale)), its, options);
    if (agreeing < most) continue;
    if (agreeing > most) log_sum = found = 0;
    most = agreeing;
    log_sum += log_scale;
    ++found;
  }
  const bool is_better = 10 * (most - agreeing_as_given) >= tags && 10 * most >= 8 * tags;
  return is_better ? std::exp(log_sum / found) : 1;
}

}  // namespace luxfit
