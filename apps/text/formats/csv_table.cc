#include "apps/text/formats/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

#include "apps/text/formats/csv_text.h"
#include "apps/text/formats/text_file.h"
#include "apps/text/formats/units.h"
#include "apps/text/input_error.h"
#include "apps/text/suggest.h"
#include "forward/room/one_line.h"

namespace luxfit {
namespace {

constexpr char kDecimalCommaRemedy[] =
    "it looks like a decimal comma; save the table with decimal points (1.2) and commas between columns";

std::string Trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// Spreadsheets write rows without content as their commas.
bool IsBlank(const std::string& line) { return line.find_first_not_of(" \t,") == std::string::npos; }

std::string Joined(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, ",")); }

std::string ExpectedHeader(const CsvColumns& expected) {
  return Joined(expected.required) +
         (expected.optional.empty() ? "" : "[," + Joined(expected.optional) + "]");
}

std::vector<std::string> ReadLines(const std::string& path) {
  std::istringstream text(ReadTextFile(path, "a table"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

// Takes off the apostrophe that keeps a spreadsheet from running a text (apps/text/formats/csv_text.h).
std::string WithoutApostrophe(const std::string& text) {
  return !text.empty() && text[0] == '\'' && IsFormula(text.substr(1)) ? text.substr(1) : text;
}

std::vector<std::string> SplitFields(const SourcePlace& place, const std::string& line) {
  std::vector<std::string> fields;
  std::string field;
  bool quoted = false, was_quoted = false;
  for (size_t i = 0; i <= line.size(); ++i) {
    const bool end = i == line.size();
    if (quoted) {
      if (end)
        throw InputError(place, "", "expected a closing quote, got the end of the line; close the quote");
      if (line[i] != '"') {
        field += line[i];
      } else if (i + 1 < line.size() && line[i + 1] == '"') {
        field += line[i++];
      } else {
        quoted = false;
      }
    } else if (end || line[i] == ',') {
      fields.push_back(WithoutApostrophe(was_quoted ? field : Trimmed(field)));
      field.clear();
      was_quoted = false;
    } else if (line[i] == '"' && Trimmed(field).empty()) {
      field.clear();
      quoted = was_quoted = true;
    } else if (!was_quoted || (line[i] != ' ' && line[i] != '\t')) {
      field += line[i];
    }
  }
  return fields;
}

std::optional<double> ParseNumber(const std::string& text) {
  const char* begin = text.data() + (!text.empty() && text[0] == '+' ? 1 : 0);
  const char* end = text.data() + text.size();
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

// "1,2" or "1.234,5": digits with exactly one comma between them.
bool HasDecimalComma(const std::string& text) {
  const size_t comma = text.find(',');
  if (comma == std::string::npos || text.find(',', comma + 1) != std::string::npos) return false;
  const auto numeric = [](char c) {
    return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e';
  };
  return comma > 0 && comma + 1 < text.size() &&
         std::all_of(text.begin(), text.end(), [&](char c) { return c == ',' || numeric(c); });
}

// Returns the column of which this is an alias, or the name itself.
std::string ColumnOf(const CsvColumns& expected, const std::string& name) {
  const auto at = expected.alias.find(name);
  return at == expected.alias.end() ? name : at->second;
}

std::string QuotedWithAlias(const CsvColumns& expected, const std::string& column) {
  std::vector<std::string> aliases;
  for (const auto& [alias, of] : expected.alias) {
    if (of == column) aliases.push_back(alias);
  }
  return Quoted(column) + (aliases.empty() ? "" : " (or its alias " + ListQuoted(aliases) + ")");
}

void ExpectOneNameForEachColumn(const CsvColumns& expected, const CsvTable& table, int line) {
  for (const auto& [alias, column] : expected.alias) {
    if (HasColumn(table, column) && HasColumn(table, alias))
      throw InputError({table.path, line}, "header",
                       "expected one of the columns " + Quoted(column) + " and " + Quoted(alias) +
                           " (its alias), got both; keep one and remove the other");
  }
}

// Says of a column that stands where `column` is expected what it has to be.
std::string ColumnRemedy(const CsvColumns& expected, const std::string& column, const std::string& found) {
  if (const auto factor = UnitFactor(found, column))
    return fmt::format(" is in another unit: multiply its numbers by {:.6g} and name it {}", *factor,
                       Quoted(column));
  return " must be " + QuotedWithAlias(expected, column) + ": rename, reorder or add it";
}

void CheckHeader(const CsvColumns& expected, const CsvTable& table, int line, const std::string& found_line) {
  const std::string found = "expected " + Quoted(ExpectedHeader(expected)) + ", got " + Quoted(found_line);
  const SourcePlace place{table.path, line};
  if (table.columns.size() == 1 && found_line.find(';') != std::string::npos)
    throw InputError(
        place, "header",
        found +
            "; columns end with commas, not semicolons: a spreadsheet writes semicolons "
            "where numbers have a decimal comma; save the table with commas and decimal points (1.2)");
  if (table.columns.size() == 1 && found_line.find('\t') != std::string::npos)
    throw InputError(place, "header",
                     found + "; columns end with commas, not tabs: save the table as CSV with commas");
  ExpectOneNameForEachColumn(expected, table, line);
  size_t i = 0;
  for (; i < expected.required.size() && i < table.columns.size(); ++i) {
    if (ColumnOf(expected, table.columns[i]) == expected.required[i]) continue;
    throw InputError(place, "header",
                     found + "; column " + std::to_string(i + 1) +
                         ColumnRemedy(expected, expected.required[i], table.columns[i]));
  }
  if (i < expected.required.size())
    throw InputError(place, "header",
                     found + "; add the column " + QuotedWithAlias(expected, expected.required[i]));
  for (auto next = expected.optional.begin(); i < table.columns.size(); ++i) {
    const auto at = std::find(next, expected.optional.end(), table.columns[i]);
    if (at == expected.optional.end())
      throw InputError(place, "header", found + "; remove the column " + Quoted(table.columns[i]));
    next = at + 1;
  }
}

void CheckFieldCount(const CsvTable& table, const CsvRow& row) {
  if (row.fields.size() == table.columns.size()) return;
  const std::string found = "expected " + std::to_string(table.columns.size()) + " fields (" +
                            Joined(table.columns) + "), got " + std::to_string(row.fields.size());
  const SourcePlace place{table.path, row.line};
  if (row.fields.size() < table.columns.size())
    throw InputError(place, "", found + "; fill in or remove the row");
  for (size_t i = 0; i + 1 < row.fields.size(); ++i)
    if (ParseNumber(row.fields[i]) && ParseNumber(row.fields[i + 1]))
      throw InputError(place, "", found + "; " + kDecimalCommaRemedy);
  throw InputError(place, "", found + "; put a field that holds a comma between double quotes");
}

void ExpectNoControlCharacters(const CsvTable& table, const CsvRow& row) {
  for (size_t i = 0; i < row.fields.size(); ++i)
    if (HasControlCharacter(row.fields[i]))
      throw CsvError(table, row, table.columns[i],
                     "expected text without control characters, got " + Quoted(OneLine(row.fields[i])) +
                         " with one; remove it");
}

size_t ColumnIndex(const CsvTable& table, const std::string& column) {
  const auto at = std::find(table.columns.begin(), table.columns.end(), column);
  if (at == table.columns.end()) throw std::invalid_argument("CsvTable: no column " + column);
  return static_cast<size_t>(at - table.columns.begin());
}

}  // namespace

CsvTable ReadCsvTable(const std::string& path, const CsvColumns& expected) {
  const std::vector<std::string> lines = ReadLines(path);
  CsvTable table;
  table.path = path;
  for (size_t i = 0; i < lines.size(); ++i) {
    if (IsBlank(lines[i])) continue;
    CsvRow row{static_cast<int>(i) + 1, {}};
    row.fields = SplitFields({path, row.line}, lines[i]);
    if (table.columns.empty()) {
      table.columns = row.fields;
      CheckHeader(expected, table, row.line, lines[i]);
    } else {
      CheckFieldCount(table, row);
      ExpectNoControlCharacters(table, row);
      table.rows.push_back(std::move(row));
    }
  }
  if (table.columns.empty())
    throw InputError(
        {path, 1}, "header",
        "expected " + Quoted(ExpectedHeader(expected)) + ", got an empty file; write the header and rows");
  if (table.rows.empty())
    throw InputError({path, 1}, "", "expected at least one row under the header, got none; add rows");
  return table;
}

const std::string& CsvText(const CsvTable& table, const CsvRow& row, const std::string& column) {
  return row.fields[ColumnIndex(table, column)];
}

bool HasColumn(const CsvTable& table, const std::string& column) {
  return std::find(table.columns.begin(), table.columns.end(), column) != table.columns.end();
}

double CsvNumber(const CsvTable& table, const CsvRow& row, const std::string& column) {
  const std::string& text = CsvText(table, row, column);
  const std::optional<double> value = ParseNumber(text);
  if (value && std::isfinite(*value)) return *value;
  const std::string found = "expected a finite number, got " + Quoted(text);
  if (HasDecimalComma(text)) throw CsvError(table, row, column, found + "; " + kDecimalCommaRemedy);
  throw CsvError(table, row, column, found + "; write it like 1.2 or 3e-4, without a unit");
}

std::runtime_error CsvError(const CsvTable& table, const CsvRow& row, const std::string& column,
                            const std::string& message) {
  return InputError({table.path, row.line}, column, message);
}

}  // namespace luxfit
