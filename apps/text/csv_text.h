// A table of comma-separated values as text; fields are quoted where they need it.
//
// Numbers are written with the digits that tell doubles apart where they have a meaning: nine. What is not
// known (null, NaN) is an empty field.
//
// Source: RFC 4180 (lines end with LF).
#ifndef LUXFIT_APPS_TEXT_CSV_TEXT_H_
#define LUXFIT_APPS_TEXT_CSV_TEXT_H_

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace luxfit {

std::string CsvField(double value);
std::string CsvField(const std::string& text);
// A number, text, or list of texts ("a; b"); nothing for null and for what is missing.
std::string CsvField(const nlohmann::json& value);

std::string CsvLine(const std::vector<std::string>& fields);

// One line an entry of a list of objects, by JSON pointers into each; the header comes first.
struct CsvColumn {
  std::string header, pointer;
};
std::string CsvOf(const nlohmann::json& list, const std::vector<CsvColumn>& columns);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_CSV_TEXT_H_
