// Reads [report]: what the cover of a report says of the job, the people and the meter.
//
//   title, client, address, author, meter, meter_serial   texts of one line
//   date, meter_calibrated                                 days, YYYY-MM-DD
//
// The section may stand in the session and in the targets file; a key of the targets file goes before that of the
// session. A text that is absent is empty.
//
// Throws std::runtime_error("FILE:LINE: report.KEY: expected X, got Y; remedy") for unknown keys, empty texts, days
// that the calendar does not have, and a meter that was calibrated after the day of the measurement.
// Source: docs/session-format.md, [report].
#ifndef LUXFIT_APPS_SESSION_REPORT_DETAILS_H_
#define LUXFIT_APPS_SESSION_REPORT_DETAILS_H_

#include <string>

#include "apps/text/formats/toml_reader.h"

namespace luxfit {

struct ReportDetails {
  std::string title, client, address, author;
  std::string date;  // of the measurement
  std::string meter, meter_serial;
  std::string meter_calibrated;  // day of the calibration
};

ReportDetails ReadReportDetails(const TomlCursor& section);

// Returns those of a session file; all empty without the section.
ReportDetails ReportDetailsOfSession(const std::string& session_path);

// Returns `details`, completed by `others` where they are empty.
ReportDetails CompletedBy(ReportDetails details, const ReportDetails& others);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_REPORT_DETAILS_H_
