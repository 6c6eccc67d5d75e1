// Reads the table of an earlier `luxfit chart`, to be drawn with the present one (`--before`).
//
// The earlier chart is named by its folder or by its table. The table tells its kind by its header. It does
// not tell its session: that is checked where the chart's artifact lies beside the table, in stages/.
//
// Throws std::runtime_error naming the file where it is missing, of another kind, of another session, scored
// against another truth, or no whole table.
#ifndef LUXFIT_APPS_COMMANDS_STUDY_INTERNAL_EARLIER_CHART_H_
#define LUXFIT_APPS_COMMANDS_STUDY_INTERNAL_EARLIER_CHART_H_

#include <string>
#include <vector>

#include "apps/text/formats/csv_table.h"

namespace luxfit {

enum class ChartKind { kForward, kFit, kStability };

// Returns the columns of the kind's table, in order.
const std::vector<std::string>& ColumnsOf(ChartKind kind);

// States what the earlier chart must share with the present one.
struct ChartSubject {
  ChartKind kind = ChartKind::kFit;
  std::string session;     // its name
  std::string truth_path;  // file of true luminaires; empty: none
};
CsvTable ReadEarlierChart(const std::string& named, const ChartSubject& subject);

// Returns the field as a number; NaN where it is empty.
double CsvNumberOrNan(const CsvTable& table, const CsvRow& row, const std::string& column);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_STUDY_INTERNAL_EARLIER_CHART_H_
