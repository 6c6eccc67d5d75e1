#include "apps/session/report_details.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "apps/session/report_targets.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using testing::HasSubstr;

class ReportDetailsTest : public testing::Test {
 protected:
  ReportDetails Read(const std::string& text) const {
    folder_.Write("session.toml", "[report]\n" + text);
    return ReportDetailsOfSession(folder_.Path("session.toml"));
  }
  std::string Error(const std::string& text) const {
    try {
      Read(text);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
  TempFolder folder_;
};

TEST_F(ReportDetailsTest, EverythingThatCanBeWritten) {
  const ReportDetails details = Read(R"(title = "Office 2.14"
client = "Example Ltd"
address = "1 Example Street"
author = "A. Engineer"
date = 2024-02-29
meter = "Lux 5"
meter_serial = "4711"
meter_calibrated = "2023-11-02"
)");
  EXPECT_EQ(details.title, "Office 2.14");
  EXPECT_EQ(details.client, "Example Ltd");
  EXPECT_EQ(details.address, "1 Example Street");
  EXPECT_EQ(details.author, "A. Engineer");
  EXPECT_EQ(details.date, "2024-02-29");  // a date of TOML and a text are the same
  EXPECT_EQ(details.meter, "Lux 5");
  EXPECT_EQ(details.meter_serial, "4711");
  EXPECT_EQ(details.meter_calibrated, "2023-11-02");
}

TEST_F(ReportDetailsTest, ErrorsNameFileLineAndKey) {
  EXPECT_THAT(Error("cleint = \"a\"\n"), HasSubstr("did you mean \"client\"?"));
  EXPECT_THAT(Error("client = \"\"\n"), HasSubstr("session.toml:2: report.client"));
  EXPECT_THAT(Error("meter_serial = 4711\n"), HasSubstr("report.meter_serial: expected a text of one line"));
  for (const char* day : {"\"31.03.2026\"", "\"2026-3-31\"", "2026", "\"2025-02-29\"", "\"2026-13-01\""})
    EXPECT_THAT(Error("date = " + std::string(day) + "\n"),
                HasSubstr("report.date: expected a day YYYY-MM-DD"));
  EXPECT_THAT(Error("date = 2026-03-31\nmeter_calibrated = 2026-04-01\n"),
              HasSubstr("report.meter_calibrated: expected a day before the measurement (2026-03-31)"));
}

TEST_F(ReportDetailsTest, TargetsGoBeforeTheSession) {
  folder_.Write("targets.toml", "[report]\nauthor = \"B\"\n");
  const ReportDetails details = CompletedBy(ReadTargets(folder_.Path("targets.toml")).details,
                                            Read("author = \"A\"\nclient = \"C\"\n"));
  EXPECT_EQ(details.author, "B");
  EXPECT_EQ(details.client, "C");
}

}  // namespace
}  // namespace luxfit
