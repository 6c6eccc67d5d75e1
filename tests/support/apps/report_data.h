// The data that a report's page holds.
#ifndef LUXFIT_TESTS_SUPPORT_APPS_REPORT_DATA_H_
#define LUXFIT_TESTS_SUPPORT_APPS_REPORT_DATA_H_

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace luxfit::support {

inline nlohmann::json ReportDataOf(const std::string& page) {
  const std::string open = "id=\"report-data\">";
  const size_t from = page.find(open) + open.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

// Decodes what Base64Floats wrote (apps/text/formats/base64.h).
inline std::vector<float> FloatsOf(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<uint8_t> bytes;
  uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<uint32_t>(digits.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<uint8_t>(bits >> count & 0xff));
  }
  std::vector<float> floats(bytes.size() / sizeof(float));
  std::memcpy(floats.data(), bytes.data(), floats.size() * sizeof(float));
  return floats;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_APPS_REPORT_DATA_H_
