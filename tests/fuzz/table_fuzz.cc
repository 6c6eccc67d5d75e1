// Any bytes as a table of readings or as a tag map, in whatever encoding: the readers must answer with rows whose texts
// are UTF-8 and can be written as JSON, or with a std::runtime_error. The first byte says which reader.
//
// Run by .ci/fuzz.sh. Source: LLVM, "libFuzzer".
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "apps/session/tag_map.h"
#include "apps/text/formats/csv_table.h"

namespace {

using namespace luxfit;

const std::string& File() {
  static const std::string file =
      (std::filesystem::temp_directory_path() / ("luxfit_fuzz_table_" + std::to_string(getpid()))).string();
  return file;
}

// The strict writer throws for what is no UTF-8.
void ExpectUtf8(const std::string& text) {
  try {
    static_cast<void>(nlohmann::json(text).dump());
  } catch (const nlohmann::json::exception&) {
    std::abort();
  }
}

void UseTable() {
  const CsvTable table =
      ReadCsvTable(File(), {{"id", "x_m", "lux"}, {"sensor"}, {{"illuminance_fc", "lux"}}});
  for (const CsvRow& row : table.rows) {
    if (row.fields.size() != table.columns.size()) std::abort();
    for (const std::string& field : row.fields) ExpectUtf8(field);
  }
  for (const CsvRow& row : table.rows) CsvNumber(table, row, "x_m");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size < 1) return 0;
  std::ofstream(File(), std::ios::binary)
      .write(reinterpret_cast<const char*>(data) + 1, static_cast<std::streamsize>(size - 1));
  try {
    if (data[0] % 2 == 0) {
      UseTable();
    } else {
      ReadTagMap(File());
    }
  } catch (const std::runtime_error& error) {
    ExpectUtf8(error.what());
  }
  return 0;
}
