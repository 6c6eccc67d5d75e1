#include "inverse/check/luxmeter_check.h"

#include <algorithm>
#include <cmath>

namespace luxfit {

LuxmeterSummary SummarizeLuxmeter(const std::vector<CheckedReading>& readings) {
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
  if (readings.empty()) return summary;
  if (measured > 0) summary.mean_abs_error_percent = 100 * summary.mean_abs_error_lx / measured;
  summary.mean_abs_error_lx /= static_cast<double>(readings.size());
  return summary;
}

double ZScore(const CheckedReading& reading) {
  const double sigma = std::hypot(reading.measured_sigma_lx, reading.predicted_sigma_lx);
  return sigma > 0 ? (reading.measured_lx - reading.predicted_lx) / sigma : 0;
}

}  // namespace luxfit
