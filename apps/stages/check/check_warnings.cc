#include "apps/stages/check/check_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace luxfit {
namespace {

constexpr double kLargeError = 0.05;  // relative: the result is then not whole
constexpr size_t kNamedReadings = 5;

void WarnOfContradiction(const std::vector<NamedReading>& readings, Findings& findings) {
  std::vector<CheckedReading> checked;
  checked.reserve(readings.size());
  for (const NamedReading& named : readings) checked.push_back(named.reading);
  if (!ContradictTheFit(checked)) return;
  findings.AddUndetermined(
      {"readings_contradict",
       fmt::format(
           "the {} readings that check differ from their predictions by {:.1f} % in the mean, of which the "
           "meter's own error explains {:.1f} %: the numbers of this result are in doubt, beyond their "
           "sigmas",
           checked.size(), SummarizeLuxmeter(checked).mean_abs_error_percent,
           ExplainedByTheMeterPercent(checked)),
       "see which readings differ (luxfit check), and compare the mesh, [states] and the scale reading with "
       "the room"});
}

void WarnOfDisagreements(const std::vector<Disagreement>& disagreements, Findings& findings) {
  for (size_t i = 0; i < std::min(kNamedReadings, disagreements.size()); ++i) {
    const Disagreement& d = disagreements[i];
    const std::string message = fmt::format("{} (z = {:.1f})", d.meaning, d.z);
    if (d.shaded_from.empty()) {
      findings.warnings.push_back(
          {"reading_disagrees", message, d.remedy, std::abs(d.relative) > kLargeError});
    } else {
      findings.warnings.push_back({"reading_shaded", message, d.remedy});
    }
  }
  if (disagreements.size() <= kNamedReadings) return;
  const auto is_large = [](const Disagreement& d) {
    return d.shaded_from.empty() && std::abs(d.relative) > kLargeError;
  };
  findings.warnings.push_back(
      {"reading_disagrees",
       fmt::format("{} more disagree with their predictions", disagreements.size() - kNamedReadings),
       "luxfit check lists all of them",
       std::any_of(disagreements.begin() + static_cast<std::ptrdiff_t>(kNamedReadings), disagreements.end(),
                   is_large)});
}

}  // namespace

void WarnOfCheck(const std::vector<NamedReading>& readings, Findings& findings) {
  WarnOfContradiction(readings, findings);
  const LuxmeterFindings check = FindDisagreements(readings);
  if (check.has_common_factor) {
    findings.warnings.push_back({"readings_off_alike", check.common_meaning, check.common_remedy,
                                 std::abs(check.common_factor - 1) > kLargeError});
  }
  WarnOfDisagreements(check.disagreements, findings);
}

}  // namespace luxfit
