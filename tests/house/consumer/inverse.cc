// A summary of readings, and a fit to nothing, which is no fit.
#include <cmath>
#include <cstdio>

#include "inverse/check/luxmeter_check.h"
#include "inverse/model/fit_luminaires.h"

int main() {
  const luxfit::LuxmeterSummary summary = luxfit::SummarizeLuxmeter({{100, 101, 0, 0}, {300, 303, 0, 0}});
  const luxfit::Room room = luxfit::MakeRoom(luxfit::Scene{});
  const luxfit::LuminaireFit fit = luxfit::FitLuminaires(room, {}, {});
  std::printf("inverse: %.2f %%, %s\n", summary.mean_abs_error_percent, fit.message.c_str());
  return std::abs(summary.mean_abs_error_percent - 1) < 1e-9 && fit.status == luxfit::FitStatus::kNoData ? 0
                                                                                                         : 1;
}
