#include <fmt/format.h>

#include <utility>

#include "tests/validation/catalogue/catalogue_case.h"
#include "tests/validation/catalogue/session_edits.h"

namespace luxfit {
namespace {

using support::OfficeCopy;

constexpr char kGroup[] = "luxmeter";
constexpr double kLuxPerFootCandle = 10.764;

bool IsScale(const Fields& row) { return row[0] == "L3" && row[7] == "all"; }

CatalogueCase Scaled(const std::string& name, double factor) {
  return {kGroup, name, Required::kNamed, {"readings_as_if"}, [factor](const OfficeCopy& office) {
            MultiplyReadings(office, factor, IsScale);
          }};
}

CatalogueCase Edited(const std::string& name, Required required, std::vector<std::string> causes,
                     const std::function<void(Fields&)>& edit) {
  return {kGroup, name, required, std::move(causes),
          [edit](const OfficeCopy& office) { EditReadings(office, edit); }};
}

void AddTo(std::string& field, double value) { field = fmt::format("{}", std::stod(field) + value); }

}  // namespace

std::vector<CatalogueCase> LuxmeterCases() {
  return {
      {kGroup,
       "one reading ten times too high",
       Required::kNamed,
       {"reading_disagrees"},
       [](const OfficeCopy& office) {
         MultiplyReadings(office, 10, [](const Fields& row) { return row[0] == "L5" && row[7] == "B"; });
       }},
      Scaled("scale reading twice too high", 2),
      Scaled("scale reading in foot-candles", 1 / kLuxPerFootCandle),
      {kGroup,
       "all readings in foot-candles, camera's scale known",
       Required::kNamed,
       {"readings_as_if"},
       [](const OfficeCopy& office) {
         MultiplyReadings(office, 1 / kLuxPerFootCandle, [](const Fields&) { return true; });
         office.GiveCameraScale();
         office.Replace("office/session.toml", "scale = [\"L3@all\"]", "");
       }},
      Edited("heights 3 cm too high", Required::kSolved, {}, [](Fields& row) { AddTo(row[3], 0.03); }),
      Edited("head tilted by 5 degrees", Required::kNamed, {"readings_as_if"},
             [](Fields& row) {
               row[4] = "0.08716";
               row[6] = "0.99619";
             }),
      Edited("x and y exchanged", Required::kNamed, {"readings_as_if"},
             [](Fields& row) { std::swap(row[1], row[2]); }),
      Edited("meter said to face down", Required::kNamed, {"readings_as_if"},
             [](Fields& row) { row[6] = "-1"; }),
      Edited("states A and B exchanged", Required::kNamed, {"readings_as_if"},
             [](Fields& row) {
               if (row[7] == "A" || row[7] == "B") row[7] = row[7] == "A" ? "B" : "A";
             }),
      Edited("places in cm", Required::kNamed, {"readings_as_if", "reading_outside"},
             [](Fields& row) {
               for (const size_t i : {1, 2, 3}) row[i] = fmt::format("{}", 100 * std::stod(row[i]));
             }),
      Edited("scale reading inside a desk", Required::kNamed, {"reading_outside"},
             [](Fields& row) {
               if (row[0] == "L3") row[3] = "0.72";
             }),
      Edited("scale reading outside the room", Required::kNamed, {"reading_outside"},
             [](Fields& row) {
               if (row[0] == "L3") row[1] = "9";
             }),
  };
}

}  // namespace luxfit
