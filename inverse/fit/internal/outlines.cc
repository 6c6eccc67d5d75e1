#include "inverse/fit/internal/outlines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "calib/luminance/median.h"
#include "inverse/model/internal/outline_block.h"
#include "inverse/model/internal/row_block.h"

namespace luxfit {
namespace {

constexpr double kExplainedSigmas = 3;

bool HasOutline(const KnownLuminaire& known) {
  const bool is_open = !known.shape_is_known && known.photometry != KnownPhotometry::kFile;
  return !known.is_held && (is_open || known.luminaire.shape != LuminaireShape::kPoint);
}

// Holds what the photos show of one luminaire: distances of its outline's points, and the views.
struct Seen {
  std::vector<double> distance_px;
  std::set<int> views;
};

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

std::vector<LuminaireOutline> ExplainedOutlines(const RoomObservations& given, const LightData& data,
                                                const LuminaireFit& fit, Findings& findings) {
  std::map<int, Seen> seen;
  Eigen::Index row = FirstReadingRow(data) + static_cast<Eigen::Index>(data.readings.size());
  for (const LuminaireOutline& outline : data.outlines) {
    Seen& of = seen[outline.luminaire];
    of.views.insert(outline.seen.view);
    for (size_t i = 0; i < outline.seen.rays.size(); ++i)
      of.distance_px.push_back(std::abs(fit.predicted[row++]));
  }
  std::set<int> explained;
  for (const auto& [luminaire, of] : seen) {
    const double median_px = Median(of.distance_px);
    const bool counts = median_px <= kExplainedSigmas * kOutlineSigmaPx;
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
