#include "apps/session/report_details.h"

#include <cstdio>
#include <utility>
#include <vector>

namespace luxfit {
namespace {

struct DetailKey {
  const char* name;
  std::string ReportDetails::*member;
  bool is_day;
};

const std::vector<DetailKey>& DetailKeys() {
  static const std::vector<DetailKey> keys = {{"title", &ReportDetails::title, false},
                                              {"client", &ReportDetails::client, false},
                                              {"address", &ReportDetails::address, false},
                                              {"author", &ReportDetails::author, false},
                                              {"date", &ReportDetails::date, true},
                                              {"meter", &ReportDetails::meter, false},
                                              {"meter_serial", &ReportDetails::meter_serial, false},
                                              {"meter_calibrated", &ReportDetails::meter_calibrated, true}};
  return keys;
}

bool IsDay(const std::string& text) {
  int year = 0, month = 0, day = 0, used = 0;
  if (text.size() != 10 || std::sscanf(text.c_str(), "%4d-%2d-%2d%n", &year, &month, &day, &used) != 3 ||
      used != 10)
    return false;
  const bool is_leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  const int days[] = {31, is_leap ? 29 : 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  return month >= 1 && month <= 12 && day >= 1 && day <= days[month - 1];
}

// Accepts a day as a text and as a date of TOML, which has no quotes.
std::string Day(const TomlCursor& value) {
  std::string text = value.IsText() ? value.Text("a day") : value.Shown();
  if (!IsDay(text))
    throw value.Error("expected a day YYYY-MM-DD, got " + value.Shown() + "; write \"2026-03-31\"");
  return text;
}

}  // namespace

ReportDetails ReadReportDetails(const TomlCursor& section) {
  std::vector<std::string> names;
  names.reserve(DetailKeys().size());
  for (const DetailKey& key : DetailKeys()) names.emplace_back(key.name);
  section.ExpectKeys(names);
  ReportDetails details;
  for (const DetailKey& key : DetailKeys()) {
    if (const auto value = section.Find(key.name))
      details.*key.member = key.is_day ? Day(*value) : value->Text("a text of one line");
  }
  // Days of this form are in the order of their letters.
  if (!details.date.empty() && details.meter_calibrated > details.date)
    throw section.Find("meter_calibrated")
        ->Error("expected a day before the measurement (" + details.date + "), got " +
                details.meter_calibrated + "; give the calibration that held on that day");
  return details;
}

ReportDetails ReportDetailsOfSession(const std::string& session_path) {
  const toml::table document = ReadTomlFile(session_path);
  const auto section = TomlCursor(document, {session_path, 1}, "").Find("report");
  return section ? ReadReportDetails(*section) : ReportDetails();
}

ReportDetails CompletedBy(ReportDetails details, const ReportDetails& others) {
  for (const DetailKey& key : DetailKeys()) {
    if ((details.*key.member).empty()) details.*key.member = others.*key.member;
  }
  return details;
}

}  // namespace luxfit
