#include "apps/stages/fit_stop.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/text/seconds.h"

namespace luxfit {

FitStop::FitStop(double budget_s) : budget_s_(budget_s), start_s_(NowS()) {}

double FitStop::LeftS() const { return std::max(0.0, budget_s_ - (NowS() - start_s_)); }

std::string FitStop::ReasonOf(double budget_s) const {
  if (InterruptListener::WasInterrupted()) return "it was interrupted (Ctrl-C or SIGTERM)";
  return NowS() - start_s_ > budget_s ? fmt::format("its budget of {:.6g} s is spent", budget_s) : "";
}

}  // namespace luxfit
