// Says how readings that disagree with a fit were probably taken (inverse/check/explain_readings.h): `explained` of
// `check` in result.json, and the warning readings_as_if, which stands before those of single readings.
#ifndef LUXFIT_APPS_STAGES_CHECK_EXPLAIN_CHECK_H_
#define LUXFIT_APPS_STAGES_CHECK_EXPLAIN_CHECK_H_

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "apps/stages/stages.h"
#include "inverse/check/explain_readings.h"

namespace luxfit {

// `readings`: those of `fit.data`, in its order.
std::vector<ReadingExplanation> ExplainCheck(const Session& session,
                                             const std::vector<LuminaireReading>& readings, const Room& room,
                                             const RoomFit& fit);

// Warns where there are explanations. Readings that are more than 5 % off as given, or of which nothing is predicted,
// leave the result undetermined.
void WarnOfExplanations(const std::vector<ReadingExplanation>& explanations, Findings& findings);

// `explanations`: one or more.
nlohmann::json ExplainedJson(const std::vector<ReadingExplanation>& explanations);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_CHECK_EXPLAIN_CHECK_H_
