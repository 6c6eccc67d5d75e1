// Writes a table as comma-separated text, with quotes around fields that need them.
//
// Numbers are written with nine significant digits. A value that is not known (null, NaN) is an empty field.
//
// Sources: RFC 4180 (lines end with LF); OWASP, "CSV injection".
#ifndef LUXFIT_APPS_TEXT_FORMATS_CSV_TEXT_H_
#define LUXFIT_APPS_TEXT_FORMATS_CSV_TEXT_H_

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace luxfit {

std::string CsvField(double value);
// Returns the field of a text. One that a spreadsheet would run as a formula gets an apostrophe before it, as spreadsheets
// write them; CsvTable takes it off again.
std::string CsvField(const std::string& text);
// Returns whether a spreadsheet takes the text for a formula: it begins with =, +, - or @ and is no number.
bool IsFormula(const std::string& text);
// Returns the field of a number, a text or a list of texts ("a; b"). It is empty for null and for a missing
// value.
std::string CsvField(const nlohmann::json& value);

std::string CsvLine(const std::vector<std::string>& fields);

// CsvOf writes a header and one line for each object of a list. JSON pointers into the object name the
// fields.
struct CsvColumn {
  std::string header, pointer;
};
std::string CsvOf(const nlohmann::json& list, const std::vector<CsvColumn>& columns);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_FORMATS_CSV_TEXT_H_
