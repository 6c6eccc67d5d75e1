// Reads a table of comma-separated values with a fixed header, and keeps its line numbers.
//
// The header must hold the expected columns in their order. Optional columns may follow in any selection.
// A column may stand under an alias instead. The table keeps the name that the file uses.
// Fields may be quoted ("a, b", "" for a quote). Blanks around a field, empty lines and rows, a byte-order mark and
// CRLF or CR are dropped. The text is UTF-8 or UTF-16 (apps/text/formats/text_file.h). Numbers have a decimal point. A decimal comma, which spreadsheets may write, is
// recognised and reported as such.
//
// Throws std::runtime_error("FILE:LINE: column: expected ..., got ...; remedy") for anything else, for a
// control character in a field, for a column beside its alias, and for a table without rows.
//
// Source: RFC 4180.
#ifndef LUXFIT_APPS_TEXT_FORMATS_CSV_TABLE_H_
#define LUXFIT_APPS_TEXT_FORMATS_CSV_TABLE_H_

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace luxfit {

struct CsvColumns {
  std::vector<std::string> required;
  std::vector<std::string> optional;
  std::map<std::string, std::string> alias = {};  // required columns by their other names
};

struct CsvRow {
  int line = 0;                     // in the file, from 1
  std::vector<std::string> fields;  // as many as the table has columns
};

struct CsvTable {
  std::string path;
  std::vector<std::string> columns;
  std::vector<CsvRow> rows;  // at least one
};

CsvTable ReadCsvTable(const std::string& path, const CsvColumns& expected);

// Returns the field of a column. Throws std::invalid_argument where the table has no such column.
const std::string& CsvText(const CsvTable& table, const CsvRow& row, const std::string& column);

bool HasColumn(const CsvTable& table, const std::string& column);

// Returns the field as a finite number.
double CsvNumber(const CsvTable& table, const CsvRow& row, const std::string& column);

// Makes an error at a row's line. `message` is "expected ..., got ...; remedy".
std::runtime_error CsvError(const CsvTable& table, const CsvRow& row, const std::string& column,
                            const std::string& message);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_FORMATS_CSV_TABLE_H_
