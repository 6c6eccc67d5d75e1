#include "inverse/fit/internal/judge/early_stop.h"

#include <fmt/format.h>

namespace luxfit {

std::function<void(bool is_part)> CheckpointOf(const std::function<std::string()>& stop_reason,
                                               std::atomic<int>& rounds) {
  return [stop_reason, &rounds](bool is_part) {
    if (!is_part) ++rounds;
    const std::string reason = stop_reason ? stop_reason() : "";
    if (!reason.empty()) throw FitStopped(reason);
  };
}

void WarnOfStop(const EarlyStop& stop, Findings& findings) {
  findings.AddUndetermined(
      {"fit_stopped",
       fmt::format(
           "the fit was stopped in its step {}: {}; the numbers are those of the best state until then",
           stop.step, stop.reason),
       "run it again with a larger --budget, or photograph luminaires alone or in smaller groups: fewer "
       "unknowns that are on together take less time"});
}

}  // namespace luxfit
