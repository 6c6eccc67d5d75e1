#include "apps/text/formats/csv_text.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

namespace luxfit {

bool IsFormula(const std::string& text) {
  if (text.empty() || std::string("=+-@").find(text[0]) == std::string::npos) return false;
  double value = 0;
  const char* begin = text.data() + (text[0] == '+' ? 1 : 0);
  const auto [stop, error] = std::from_chars(begin, text.data() + text.size(), value);
  return error != std::errc() || stop != text.data() + text.size();
}

std::string CsvField(double value) { return std::isfinite(value) ? fmt::format("{:.9g}", value) : ""; }

std::string CsvField(const std::string& given) {
  std::string text = (IsFormula(given) ? "'" : "") + given;
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string CsvField(const nlohmann::json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return CsvField(value.get<std::string>());
  if (value.is_number()) return CsvField(value.get<double>());
  if (!value.is_array()) return CsvField(value.dump());
  std::string joined;
  for (const nlohmann::json& item : value)
    joined += (joined.empty() ? "" : "; ") + (item.is_string() ? item.get<std::string>() : item.dump());
  return CsvField(joined);
}

std::string CsvLine(const std::vector<std::string>& fields) {
  return fmt::format("{}\n", fmt::join(fields, ","));
}

std::string CsvOf(const nlohmann::json& list, const std::vector<CsvColumn>& columns) {
  std::vector<std::string> fields;
  fields.reserve(columns.size());
  for (const CsvColumn& column : columns) fields.push_back(column.header);
  std::string text = CsvLine(fields);
  for (const nlohmann::json& entry : list) {
    for (size_t i = 0; i < columns.size(); ++i) {
      const nlohmann::json::json_pointer pointer(columns[i].pointer);
      fields[i] = entry.contains(pointer) ? CsvField(entry.at(pointer)) : "";
    }
    text += CsvLine(fields);
  }
  return text;
}

}  // namespace luxfit
