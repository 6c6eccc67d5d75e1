// Says when a fit has to end with what it has: its budget is spent, or Ctrl-C or SIGTERM came.
#ifndef LUXFIT_APPS_STAGES_FIT_STOP_H_
#define LUXFIT_APPS_STAGES_FIT_STOP_H_

#include <functional>
#include <string>

#include "apps/text/interrupt.h"

namespace luxfit {

class FitStop {
 public:
  // The time runs from here.
  explicit FitStop(double budget_s);

  double LeftS() const;
  // Returns why the fit has to end; empty while it may go on. Any thread may call it.
  std::string Reason() const { return ReasonOf(budget_s_); }
  // The same for the count of luminaires, which may take half of the budget: the rest is the fit's.
  std::string ReasonOfCount() const { return ReasonOf(budget_s_ / 2); }

 private:
  std::string ReasonOf(double budget_s) const;

  InterruptListener interrupt_;
  double budget_s_, start_s_;
};

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_FIT_STOP_H_
