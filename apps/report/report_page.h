// Makes the page of a report: one HTML file that needs nothing else.
//
// The file holds style, program (including three.js) and data; a page that needs no program holds its parts
// as HTML, and its browser refuses every script. The data are JSON in a script element that no browser runs.
// Every '<', '>' and '&' in it is written as \u003c, \u003e, \u0026, so that no text of the user can end the
// element.
//
// Printed sheets have the title, version and date at their head, and their number at the foot.
//
// Source: HTML Living Standard, sec. 4.12.1.3 (restrictions for contents of script elements).
#ifndef LUXFIT_APPS_REPORT_REPORT_PAGE_H_
#define LUXFIT_APPS_REPORT_REPORT_PAGE_H_

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace luxfit {

// The build makes it from apps/report/page/ (CMakeLists.txt).
struct ReportAssets {
  std::string_view html, program, css, script;  // program: the elements that run the script on the data
};
ReportAssets GetReportAssets();

// Returns the date and time that a page carries: "2025-01-31 12:00 UTC".
std::string NowUtc();

std::string JsonForHtml(const nlohmann::json& data);

std::string ReportPage(const std::string& title, const nlohmann::json& data);

// `body` is HTML, in which the caller has escaped every text (apps/report/html.h).
std::string ReportPageWithoutProgram(const std::string& title, const std::string& body);

}  // namespace luxfit

#endif  // LUXFIT_APPS_REPORT_REPORT_PAGE_H_
