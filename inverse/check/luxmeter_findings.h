// Which readings disagree with their predictions, and whether they do so together or alone.
//
//   z_i = (measured_i - predicted_i) / sigma_i,   sigma_i^2 = sigma_measured^2 + sigma_predicted^2
//
// Common factor: the weighted median of measured / predicted; its standard error is that of a median of
// independent readings, and the median of the predictions' own relative sigmas, which they share. It is
// beyond chance above 1.96 of it, with three readings or more. A reading disagrees where |z|, with the common
// factor taken out if that is beyond chance, exceeds the two-sided limit at which one of n readings would by
// chance in 5 % of cases (Bonferroni: 0.05 / n each). Readings of one place that all disagree speak of the
// place, most of the readings of one state of the state.
//
// Source: Bonferroni, see Dunn (1961), "Multiple comparisons among means".
#ifndef LUXFIT_INVERSE_CHECK_LUXMETER_FINDINGS_H_
#define LUXFIT_INVERSE_CHECK_LUXMETER_FINDINGS_H_

#include <string>
#include <vector>

#include "inverse/check/luxmeter_check.h"

namespace luxfit {

struct NamedReading {
  std::string id, state;
  CheckedReading reading;
};

struct Disagreement {
  enum class Of { kReading, kPlace, kState };
  Of of = Of::kReading;
  std::string id, state;        // of a place: state empty; of a state: id empty
  double z = 0;                 // the one furthest from 0 of those meant
  double relative = 0;          // measured / predicted - 1 of it
  std::string meaning, remedy;  // a sentence each, without a full stop
};

struct LuxmeterFindings {
  double z_limit = 0;
  double common_factor = 1;  // measured / predicted
  double common_sigma = 0;
  bool has_common_factor = false;  // beyond chance
  std::string common_meaning, common_remedy;
  std::vector<Disagreement> disagreements;
};

LuxmeterFindings FindDisagreements(const std::vector<NamedReading>& readings);

// Quantile of the standard normal for a probability in (0, 1). Throws std::invalid_argument otherwise.
double NormalQuantile(double probability);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHECK_LUXMETER_FINDINGS_H_
