// The data that a report's page holds.
#ifndef LUXFIT_TESTS_SUPPORT_APPS_REPORT_DATA_H_
#define LUXFIT_TESTS_SUPPORT_APPS_REPORT_DATA_H_

#include <nlohmann/json.hpp>
#include <string>

namespace luxfit::support {

inline nlohmann::json ReportDataOf(const std::string& page) {
  const std::string open = "id=\"report-data\">";
  const size_t from = page.find(open) + open.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_APPS_REPORT_DATA_H_
