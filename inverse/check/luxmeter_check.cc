#include "inverse/check/luxmeter_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "calib/luminance/weighted_median.h"
#include "inverse/check/internal/factor_words.h"
#include "inverse/check/internal/shade.h"

namespace luxfit {
namespace {

double RelativeSigma(const CheckedReading& r) {
  return std::hypot(r.measured_sigma_lx, r.predicted_sigma_lx) / r.predicted_lx;
}

bool IsComparable(const CheckedReading& r) { return r.predicted_lx > 0 && RelativeSigma(r) > 0; }

constexpr double kNoneIsPredicted = std::numeric_limits<double>::infinity();

std::string Percent(double relative) { return fmt::format("{:.1f} %", 100 * std::abs(relative)); }

void FindCommonFactor(const std::vector<NamedReading>& readings, LuxmeterFindings& findings) {
  std::vector<std::pair<double, double>> ratios, shared;
  double weights = 0;
  for (const NamedReading& named : readings) {
    const CheckedReading& r = named.reading;
    if (!IsComparable(r)) continue;
    const double weight = 1 / std::pow(RelativeSigma(r), 2);
    ratios.emplace_back(r.measured_lx / r.predicted_lx, weight);
    shared.emplace_back(r.predicted_sigma_lx / r.predicted_lx, 1.0);
    weights += weight;
  }
  if (ratios.empty()) return;
  findings.common_factor = WeightedMedian(ratios);
  constexpr double kMedianOverMean = 1.2533;  // sqrt(pi / 2): ratio of their standard errors
  findings.common_sigma = std::hypot(kMedianOverMean / std::sqrt(weights), WeightedMedian(shared));
  constexpr size_t kFewest = 3;
  findings.has_common_factor =
      ratios.size() >= kFewest && std::abs(findings.common_factor - 1) > 1.96 * findings.common_sigma;
  if (!findings.has_common_factor) return;
  const bool more = findings.common_factor > 1;
  findings.common_meaning = "all readings are off alike: " + Percent(findings.common_factor - 1) +
                            (more ? " above" : " below") + " their predictions in the middle";
  findings.common_remedy =
      "the absolute scale is off, not the room: read the reading that sets the scale again, compare the "
      "meter with another, and give luxmeter.class; luminaires may have warmed up or aged between photos and "
      "readings";
}

struct Judged {
  size_t reading;
  double z, relative;
  bool disagrees;
};

std::vector<Judged> Judge(const std::vector<NamedReading>& readings, const LuxmeterFindings& findings) {
  const double factor = findings.has_common_factor ? findings.common_factor : 1;
  std::vector<Judged> judged;
  for (size_t i = 0; i < readings.size(); ++i) {
    CheckedReading r = readings[i].reading;
    r.predicted_lx *= factor;
    const double z = ZScore(r);
    const double relative =
        r.predicted_lx > 0 ? r.measured_lx / r.predicted_lx - 1 : (r.measured_lx > 0 ? kNoneIsPredicted : 0);
    judged.push_back({i, z, relative, std::abs(z) > findings.z_limit});
  }
  return judged;
}

struct Tally {
  int readings = 0, disagreeing = 0;
};

std::string Side(const Disagreement& d) { return Percent(d.relative) + (d.z > 0 ? " above" : " below"); }

void Explain(Disagreement& d) {
  if (d.of == Disagreement::Of::kState) {
    d.meaning = "most readings of state " + d.state + " disagree, up to " + Side(d) + " their predictions";
    d.remedy = "what was on in " + d.state +
               " is not what [states] says: a luminaire on that it does not name, one off, or another "
               "dimming; daylight would do it too";
    return;
  }
  const bool is_place = d.of == Disagreement::Of::kPlace;
  d.meaning =
      (is_place ? d.id + " disagrees in all its states" : d.id + " in state " + d.state + " disagrees") +
      ": " + Side(d) + (is_place ? " its prediction at most" : " its prediction");
  if (d.relative == kNoneIsPredicted) {
    d.meaning = d.id + " in state " + d.state + " disagrees: it measured light where none is predicted";
    d.remedy =
        "no luminaire that is on reaches its place, as the mesh and the table of readings have it: measure "
        "its place "
        "again, and see what hides it";
    return;
  }
  const std::optional<KnownFactor> factor = FindKnownFactor(1 + d.relative);
  if (factor && !is_place) {
    d.remedy = "it is off " + factor->words + ": read it again";
    d.shaded_from.clear();
  } else if (!d.shaded_from.empty()) {
    d.meaning += ", as in the shade of " + d.shaded_from;
    d.remedy = "something that the mesh does not have stands between " + d.shaded_from + " and " + d.id +
               ", or whoever read the meter did: add it to the mesh, or read it again";
  } else if (is_place) {
    d.remedy =
        "its place or the way the meter faced is not what the table says, or something stands near "
        "it that the mesh does not have: measure its place again";
  } else if (d.z < 0) {
    d.remedy =
        "the meter may have been shaded (by whoever read it), tilted, or read before the luminaire had "
        "warmed up: read it again";
  } else {
    d.remedy =
        "light that the session does not name (daylight, a screen, a luminaire) or another range of the "
        "meter: read it again, with a reading of all off";
  }
}

bool AreFarOff(const std::vector<CheckedReading>& readings) {
  constexpr double kLargePercent = 5, kTimesExplained = 2;
  return SummarizeLuxmeter(readings).mean_abs_error_percent >
         std::max(kLargePercent, kTimesExplained * ExplainedByTheMeterPercent(readings));
}

}  // namespace

LuxmeterSummary SummarizeLuxmeter(const std::vector<CheckedReading>& readings) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  if (readings.empty()) return {kUnknown, kUnknown, kUnknown, 0};
  LuxmeterSummary summary;
  double measured = 0;
  for (const CheckedReading& r : readings) {
    const double error = std::abs(r.predicted_lx - r.measured_lx);
    summary.mean_abs_error_lx += error;
    measured += r.measured_lx;
    if (r.measured_lx > 0) {
      summary.max_abs_error_percent = std::max(summary.max_abs_error_percent, 100 * error / r.measured_lx);
    }
  }
  summary.readings_checked = static_cast<int>(readings.size());
  if (measured > 0) summary.mean_abs_error_percent = 100 * summary.mean_abs_error_lx / measured;
  summary.mean_abs_error_lx /= static_cast<double>(readings.size());
  return summary;
}

double ExplainedByTheMeterPercent(const std::vector<CheckedReading>& readings) {
  double sigma = 0, measured = 0;
  for (const CheckedReading& r : readings) {
    sigma += r.measured_sigma_lx;
    measured += r.measured_lx;
  }
  constexpr double kMeanOverSigma = 0.7979;  // sqrt(2 / pi), of |N(0, 1)|
  return measured > 0 ? 100 * kMeanOverSigma * sigma / measured : std::numeric_limits<double>::quiet_NaN();
}

bool ContradictTheFit(const std::vector<CheckedReading>& readings) {
  constexpr size_t kFewestToBlameOne = 3;  // of two, nobody knows which is wrong
  if (!AreFarOff(readings)) return false;
  if (readings.size() < kFewestToBlameOne) return true;
  for (size_t i = 0; i < readings.size(); ++i) {
    std::vector<CheckedReading> others = readings;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    if (!AreFarOff(others)) return false;
  }
  return true;
}

double ZScore(const CheckedReading& reading) {
  const double sigma = std::hypot(reading.measured_sigma_lx, reading.predicted_sigma_lx);
  return sigma > 0 ? (reading.measured_lx - reading.predicted_lx) / sigma : 0;
}

double NormalQuantile(double probability) {
  if (!(probability > 0 && probability < 1))
    throw std::invalid_argument("NormalQuantile: expected a probability in (0, 1)");
  return boost::math::quantile(boost::math::normal(), probability);
}

LuxmeterFindings FindDisagreements(const std::vector<NamedReading>& readings) {
  LuxmeterFindings findings;
  if (readings.empty()) return findings;
  findings.z_limit = -NormalQuantile(0.025 / static_cast<double>(readings.size()));
  FindCommonFactor(readings, findings);
  const std::vector<Judged> judged = Judge(readings, findings);
  const std::vector<std::string> shading =
      ShadingLuminaires(readings, findings.has_common_factor ? findings.common_factor : 1, findings.z_limit);
  std::map<std::string, Tally> places, states;
  for (const Judged& j : judged) {
    for (Tally* tally : {&places[readings[j.reading].id], &states[readings[j.reading].state]}) {
      ++tally->readings;
      tally->disagreeing += j.disagrees ? 1 : 0;
    }
  }
  std::map<std::pair<std::string, std::string>, Disagreement> found;
  for (const Judged& j : judged) {
    if (!j.disagrees) continue;
    const NamedReading& named = readings[j.reading];
    const Tally &place = places[named.id], &state = states[named.state];
    Disagreement d{Disagreement::Of::kReading, named.id, named.state, j.z, j.relative, "", "", ""};
    constexpr int kFewestOfState = 3;
    if (states.size() > 1 && state.readings >= kFewestOfState && 2 * state.disagreeing > state.readings) {
      d.of = Disagreement::Of::kState, d.id.clear();
    } else if (place.readings > 1 && place.disagreeing == place.readings) {
      d.of = Disagreement::Of::kPlace, d.state.clear();
    } else {
      d.shaded_from = shading[j.reading];
    }
    const auto [at, is_new] = found.try_emplace({d.id, d.state}, d);
    if (!is_new && std::abs(d.z) > std::abs(at->second.z)) at->second = d;
  }
  for (auto& [key, d] : found) {
    Explain(d);
    findings.disagreements.push_back(std::move(d));
  }
  std::stable_sort(
      findings.disagreements.begin(), findings.disagreements.end(),
      [](const Disagreement& a, const Disagreement& b) { return std::abs(a.z) > std::abs(b.z); });
  return findings;
}

}  // namespace luxfit
