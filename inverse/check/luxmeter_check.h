// Luxmeter readings against predictions.
//
//   mean_abs_error_percent = 100 * mean |predicted - measured| / mean measured      over the readings that
//   only check z = (measured - predicted) / sqrt(sigma_measured^2 + sigma_predicted^2)
//
// lx throughout.
// Source: docs/session-format.md, "summary" (the figure that published comparisons give).
#ifndef LUXFIT_INVERSE_CHECK_LUXMETER_CHECK_H_
#define LUXFIT_INVERSE_CHECK_LUXMETER_CHECK_H_

#include <vector>

namespace luxfit {

struct CheckedReading {
  double measured_lx = 0;
  double predicted_lx = 0;
  double measured_sigma_lx = 0;
  double predicted_sigma_lx = 0;
};

struct LuxmeterSummary {
  double mean_abs_error_lx = 0;
  double mean_abs_error_percent = 0;
  double max_abs_error_percent = 0;  // of one reading, of its own value
  int readings_checked = 0;
};

LuxmeterSummary SummarizeLuxmeter(const std::vector<CheckedReading>& readings);

// 0 where both sigmas are 0.
double ZScore(const CheckedReading& reading);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHECK_LUXMETER_CHECK_H_
