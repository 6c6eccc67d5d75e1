#include "inverse/fit/internal/outlines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "calib/luminance/median.h"
#include "inverse/model/internal/blocks/outline_block.h"
#include "inverse/model/internal/blocks/row_block.h"
#include "inverse/observe/internal/angle.h"

namespace luxfit {
namespace {

constexpr double kExplainedSigmas = 3;

bool HasOutline(const KnownLuminaire& known) {
  const bool is_open = !known.shape_is_known && known.photometry != KnownPhotometry::kFile;
  return !known.is_held && (is_open || known.luminaire.shape != LuminaireShape::kPoint);
}

// Holds how large a luminaire looks: medians of pixels and of metres, from its place to its outline.
struct SeenRadius {
  double px = 0, m = 0;
};

SeenRadius RadiusOf(const Luminaire& luminaire, const std::vector<LuminaireOutline>& outlines, int index) {
  std::vector<double> px, m;
  for (const LuminaireOutline& outline : outlines) {
    if (outline.luminaire != index) continue;
    const Eigen::Vector3d to = luminaire.position - outline.seen.eye;
    for (const OutlineRay& ray : outline.seen.rays) {
      const double angle = AngleBetween(to, ray.direction);
      px.push_back(angle * ray.px_per_rad);
      m.push_back(angle * to.norm());
    }
  }
  if (px.empty()) return {};
  return {Median(std::move(px)), Median(std::move(m))};
}

// Returns the area that an outline encloses in the luminaire's plane, m2; 0 where it is seen edge-on, or from its plane.
double AreaInPlane(const Luminaire& luminaire, const SeenOutline& seen) {
  constexpr double kEdgeOn = 0.02;
  const LuminaireAxes axes = AxesOf(luminaire);
  const Eigen::Vector3d to = luminaire.position - seen.eye;
  std::vector<Eigen::Vector2d> rim;
  rim.reserve(seen.rays.size());
  for (const OutlineRay& ray : seen.rays) {
    const double cosine = ray.direction.dot(luminaire.aim), distance = to.dot(luminaire.aim) / cosine;
    if (std::abs(cosine) < kEdgeOn || distance <= 0) return 0;
    const Eigen::Vector3d hit = distance * ray.direction - to;
    rim.emplace_back(hit.dot(axes.along), hit.dot(axes.across));
  }
  double twice = 0;
  for (size_t i = 0; i < rim.size(); ++i) {
    const Eigen::Vector2d &a = rim[i], &b = rim[(i + 1) % rim.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return std::abs(twice) / 2;
}

// Holds what the photos show of one luminaire: distances of its outline's points, and the views.
struct Seen {
  std::vector<double> distance_px;
  std::set<int> views;
  bool is_far_smaller = false;  // than the fit's

  double MedianPx() const { return Median(distance_px); }
  bool IsExplained() const { return MedianPx() <= kExplainedSigmas * kOutlineSigmaPx && !is_far_smaller; }
};

std::map<int, Seen> SeenBy(const LightData& data, const LuminaireFit& fit) {
  std::map<int, Seen> seen;
  Eigen::Index row = FirstReadingRow(data) + static_cast<Eigen::Index>(data.readings.size());
  for (const LuminaireOutline& outline : data.outlines) {
    Seen& of = seen[outline.luminaire];
    of.views.insert(outline.seen.view);
    for (size_t i = 0; i < outline.seen.rays.size(); ++i)
      of.distance_px.push_back(std::abs(fit.predicted[row++]));
  }
  for (auto& [k, of] : seen) {
    const Luminaire& luminaire = fit.state.luminaires[static_cast<size_t>(k)];
    const double shown_m2 = ShownAreaM2(luminaire, data.outlines, k);
    of.is_far_smaller = shown_m2 > 0 && OpeningAreaM2(luminaire) > kMostTimesShown * shown_m2;
  }
  return seen;
}

// Gives a disc or a rectangle the size that photos show, where its own is far larger.
void ShrinkToShown(const std::vector<LuminaireOutline>& outlines, int index, Luminaire& luminaire,
                   Findings& findings) {
  const double own_m2 = OpeningAreaM2(luminaire), shown_m2 = ShownAreaM2(luminaire, outlines, index);
  if (shown_m2 <= 0 || own_m2 <= kMostTimesShown * shown_m2) return;
  luminaire.size_m *= std::sqrt(shown_m2 / own_m2);
  findings.choices.push_back(
      {"size of " + luminaire.id,
       "as photos show",
       {"as its light tells", "as photos show"},
       fmt::format("its light told {:.2g} m2, {:.0f} times the {:.2g} m2 that photos show", own_m2,
                   own_m2 / shown_m2, shown_m2)});
}

}  // namespace

std::vector<LuminaireOutline> OutlinesOf(const RoomObservations& given, const std::vector<bool>& found,
                                         const LightState& state) {
  std::vector<LuminaireOutline> outlines;
  for (LuminaireOutline& outline : MatchOutlines(given.outlines, state.luminaires, given.dimming)) {
    const auto k = static_cast<size_t>(outline.luminaire);
    if (found[k] && HasOutline(given.luminaires[k])) outlines.push_back(std::move(outline));
  }
  return outlines;
}

std::vector<LuminaireOutline> TellingOutlines(const std::vector<LuminaireOutline>& outlines,
                                              const LightState& state) {
  constexpr double kEnough = 0.9;
  std::vector<double> tells;
  std::map<int, double> of_luminaire;
  for (const LuminaireOutline& outline : outlines) {
    const Eigen::Vector3d& place = state.luminaires[static_cast<size_t>(outline.luminaire)].position;
    double sum = 0;
    for (const OutlineRay& ray : outline.seen.rays) sum += ray.px_per_rad * ray.px_per_rad;
    tells.push_back(sum / (place - outline.seen.eye).squaredNorm());
    of_luminaire[outline.luminaire] += tells.back();
  }
  std::vector<size_t> order(outlines.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return tells[a] > tells[b]; });
  std::map<int, double> taken;
  std::vector<size_t> kept;
  for (const size_t i : order) {
    double& so_far = taken[outlines[i].luminaire];
    if (so_far < kEnough * of_luminaire[outlines[i].luminaire]) kept.push_back(i);
    so_far += tells[i];
  }
  std::sort(kept.begin(), kept.end());
  std::vector<LuminaireOutline> telling;
  telling.reserve(kept.size());
  for (const size_t i : kept) telling.push_back(outlines[i]);
  return telling;
}

double OpeningAreaM2(const Luminaire& luminaire) {
  if (luminaire.shape == LuminaireShape::kRectangle) return luminaire.size_m.prod();
  return luminaire.shape == LuminaireShape::kDisc ? M_PI / 4 * std::pow(luminaire.size_m[0], 2) : 0;
}

double ShownAreaM2(const Luminaire& luminaire, const std::vector<LuminaireOutline>& outlines, int index) {
  if (OpeningAreaM2(luminaire) == 0) return 0;
  std::map<int, double> of_view;  // several outlines where something stands before it
  for (const LuminaireOutline& outline : outlines)
    if (outline.luminaire == index) of_view[outline.seen.view] += AreaInPlane(luminaire, outline.seen);
  std::vector<double> areas_m2;
  for (const auto& [view, area_m2] : of_view)
    if (area_m2 > 0) areas_m2.push_back(area_m2);
  return areas_m2.empty() ? 0 : Median(std::move(areas_m2));
}

LightState WithSeenSizes(const std::vector<OpenChoice>& open, const std::vector<LuminaireOutline>& outlines,
                         LightState state, Findings& findings) {
  for (size_t k = 0; k < open.size(); ++k) {
    Luminaire& luminaire = state.luminaires[k];
    if (!open[k].shape || !IsFirstOfType(state, static_cast<int>(k))) continue;
    ShrinkToShown(outlines, static_cast<int>(k), luminaire, findings);
    // An isotropic point has no aim, which a disc needs.
    if (luminaire.shape != LuminaireShape::kPoint || luminaire.distribution == Distribution::kIsotropic)
      continue;
    const SeenRadius radius = RadiusOf(luminaire, outlines, static_cast<int>(k));
    if (radius.px <= kExplainedSigmas * kOutlineSigmaPx) continue;
    luminaire.shape = LuminaireShape::kDisc;
    luminaire.size_m.setConstant(2 * radius.m);
    state.free[k].size = true;
    findings.choices.push_back(
        {"shape of " + luminaire.id,
         "disc",
         {"point", "disc"},
         fmt::format("its light tells no size, but photos show a radius of {:.0f} px; a "
                     "point's is up to {:g} px",
                     radius.px, kExplainedSigmas * kOutlineSigmaPx)});
  }
  return WithLikeTypes(std::move(state));
}

std::optional<LightState> WithRectangles(const std::vector<OpenChoice>& open, const LightData& data,
                                         const LuminaireFit& fit) {
  LightState state = fit.state;
  bool has_any = false;
  for (const auto& [k, of] : SeenBy(data, fit)) {
    const auto index = static_cast<size_t>(k);
    Luminaire& luminaire = state.luminaires[index];
    if (!open[index].shape || !IsFirstOfType(state, k) || luminaire.shape != LuminaireShape::kDisc ||
        of.IsExplained())
      continue;
    luminaire.shape = LuminaireShape::kRectangle;
    luminaire.size_m.setConstant(luminaire.size_m[0] * std::sqrt(M_PI) / 2);
    state.free[index].size = true;
    has_any = true;
  }
  if (!has_any) return {};
  return WithLikeTypes(std::move(state));
}

LightState WithExplainedRectangles(const LightData& data, const LuminaireFit& fit,
                                   const LuminaireFit& squared, Findings& findings) {
  LightState state = squared.state;
  const std::map<int, Seen> as_disc = SeenBy(data, fit);
  for (const auto& [k, of] : SeenBy(data, squared)) {
    const auto index = static_cast<size_t>(k);
    if (!IsFirstOfType(state, k) || fit.state.luminaires[index].shape == state.luminaires[index].shape)
      continue;
    if (!of.IsExplained()) {
      state.luminaires[index] = fit.state.luminaires[index];
      state.free[index] = fit.state.free[index];
      continue;
    }
    findings.choices.push_back({"shape of " + state.luminaires[index].id,
                                "rectangle",
                                {"disc", "rectangle"},
                                fmt::format("photos show it {:.1f} px in the median from the outline of a "
                                            "rectangle, {:.1f} px from a disc's; its light hardly tells",
                                            of.MedianPx(), as_disc.at(k).MedianPx())});
  }
  return WithLikeTypes(std::move(state));
}

std::vector<LuminaireOutline> ExplainedOutlines(const RoomObservations& given, const LightData& data,
                                                const LuminaireFit& fit, Findings& findings) {
  const std::map<int, Seen> seen = SeenBy(data, fit);
  std::set<int> explained;
  for (const auto& [luminaire, of] : seen) {
    const double median_px = of.MedianPx();
    const bool counts = of.IsExplained();
    if (counts) explained.insert(luminaire);
    findings.choices.push_back(
        {"outline of " + given.luminaires[static_cast<size_t>(luminaire)].luminaire.id,
         counts ? "used" : "not used",
         {"used", "not used"},
         fmt::format("seen from {} views; {:.1f} px in the median from the model's, {:g} px are allowed",
                     of.views.size(), median_px, kExplainedSigmas * kOutlineSigmaPx)});
  }
  std::vector<LuminaireOutline> kept;
  for (const LuminaireOutline& outline : data.outlines)
    if (explained.count(outline.luminaire) > 0) kept.push_back(outline);
  return kept;
}

}  // namespace luxfit
