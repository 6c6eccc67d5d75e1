// Writes and reads the table of `luxfit chart`, OUT/chart.csv: the points of the forward model's chart.
#ifndef LUXFIT_APPS_COMMANDS_STUDY_INTERNAL_FORWARD_CHART_TABLE_H_
#define LUXFIT_APPS_COMMANDS_STUDY_INTERNAL_FORWARD_CHART_TABLE_H_

#include <string>
#include <vector>

#include "apps/charts/chart_points.h"
#include "apps/text/formats/csv_table.h"

namespace luxfit {

std::string ForwardChartCsv(const std::vector<ChartPoint>& points);

// Returns "all", or the number of reflections.
std::string BouncesOf(const ChartPoint& point);

// Reads what the picture of an earlier chart needs: factor, method, time, error, on_front and automatic.
// Throws std::runtime_error at the line of an unknown method or of a field that is no number.
std::vector<ChartPoint> ForwardPointsOf(const CsvTable& table);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_STUDY_INTERNAL_FORWARD_CHART_TABLE_H_
