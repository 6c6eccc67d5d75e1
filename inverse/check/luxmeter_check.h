// Compares luxmeter readings with predictions, and finds those that disagree, together or alone.
//
//   mean_abs_error_percent = 100 * mean |predicted - measured| / mean measured
//   z = (measured - predicted) / sigma,   sigma^2 = sigma_measured^2 + sigma_predicted^2
//
// The mean runs over the readings that only check and are not fitted to. Units: lx.
//
// The common factor is the weighted median of measured / predicted. Its standard error combines two parts:
// that of a median of independent readings, and the median of the predictions' relative sigmas, which they
// share. The factor is beyond chance where it differs from 1 by more than 1.96 standard errors, with at least
// three readings.
//
// The readings contradict the fit where their mean error is above 5 % and above twice the one that the meter explains,
// E |N(0, sigma)| = 0.8 sigma. Of three and more, this holds whichever one is left out: one alone that is wrong says nothing
// of the fit. Whatever the sigmas of a contradicted fit say, its numbers are in doubt.
//
// A reading disagrees where |z| exceeds a two-sided limit. One of n readings exceeds this limit by chance in
// 5 % of cases (Bonferroni: 0.05 / n each). A common factor beyond chance is removed from z first. Where all
// readings of one place disagree, the place is named; where most readings of one state disagree, the state is
// named. A reading that is too low as the shade of one luminaire would make it (internal/shade.h) is no evidence against the fit.
//
// Sources: docs/session-format.md, "summary" (the figure that published comparisons give); Bonferroni, see
// Dunn (1961), "Multiple comparisons among means".
#ifndef LUXFIT_INVERSE_CHECK_LUXMETER_CHECK_H_
#define LUXFIT_INVERSE_CHECK_LUXMETER_CHECK_H_

#include <string>
#include <utility>
#include <vector>

namespace luxfit {

struct CheckedReading {
  double measured_lx = 0;
  double predicted_lx = 0;
  double measured_sigma_lx = 0;
  double predicted_sigma_lx = 0;
};

// Holds errors over readings; NaN where there are none.
struct LuxmeterSummary {
  double mean_abs_error_lx = 0;
  double mean_abs_error_percent = 0;
  double max_abs_error_percent = 0;  // largest error of one reading, in percent of its own value
  int readings_checked = 0;
};

LuxmeterSummary SummarizeLuxmeter(const std::vector<CheckedReading>& readings);

// Returns the mean |error| that the sigmas of the measured values explain, in percent of the mean measured value; NaN
// without readings.
double ExplainedByTheMeterPercent(const std::vector<CheckedReading>& readings);
bool ContradictTheFit(const std::vector<CheckedReading>& readings);

// Returns z; 0 where both sigmas are 0.
double ZScore(const CheckedReading& reading);

struct NamedReading {
  std::string id, state;
  CheckedReading reading;
  std::vector<std::pair<std::string, double>> direct_lx = {};  // of the prediction, by luminaire
};

struct Disagreement {
  enum class Of { kReading, kPlace, kState };
  Of of = Of::kReading;
  std::string id, state;    // kPlace: state empty; kState: id empty
  double z = 0;             // the z farthest from 0 among the readings named
  double relative = 0;      // measured / predicted - 1 of that reading; infinity where no light is predicted
  std::string shaded_from;  // kReading: the luminaire in whose shade it would be so; empty: none
  std::string meaning, remedy;  // a sentence each, without a full stop
};

struct LuxmeterFindings {
  double z_limit = 0;
  double common_factor = 1;  // measured / predicted
  double common_sigma = 0;
  bool has_common_factor = false;  // true: it is beyond chance
  std::string common_meaning, common_remedy;
  std::vector<Disagreement> disagreements;
};

LuxmeterFindings FindDisagreements(const std::vector<NamedReading>& readings);

// Returns the standard normal quantile of a probability in (0, 1). Throws std::invalid_argument otherwise.
double NormalQuantile(double probability);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHECK_LUXMETER_CHECK_H_
