#include "apps/report/report_page.h"

#include <ctime>
#include <map>
#include <nlohmann/json.hpp>

#include "apps/charts/svg.h"

namespace luxfit {
namespace {

// Fills in the placeholders <!--NAME--> of a text. Text that is inserted is not searched again.
std::string Filled(std::string_view text, const std::map<std::string, std::string>& parts) {
  std::string filled;
  size_t at = 0;
  const std::string html(text);
  for (size_t open; (open = html.find("<!--", at)) != std::string::npos;) {
    const size_t close = html.find("-->", open);
    const auto part = parts.find(html.substr(open + 4, close - open - 4));
    filled += html.substr(at, open - at);
    if (part != parts.end()) filled += part->second;
    at = close + 3;
  }
  return filled + html.substr(at);
}

}  // namespace

std::string NowUtc() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &parts)};
}

std::string JsonForHtml(const nlohmann::json& data) {
  std::string text;
  // Bytes that are not UTF-8 (an id in an old file) must not stop the report.
  for (const char c : data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)) {
    if (c == '<') {
      text += "\\u003c";
    } else if (c == '>') {
      text += "\\u003e";
    } else if (c == '&') {
      text += "\\u0026";
    } else {
      text += c;
    }
  }
  return text;
}

std::string ReportPage(const std::string& title, const nlohmann::json& data) {
  const ReportAssets assets = GetReportAssets();
  const std::string program =
      Filled(assets.program, {{"DATA", JsonForHtml(data)}, {"SCRIPT", std::string(assets.script)}});
  return Filled(assets.html, {{"TITLE", XmlEscaped(title)},
                              {"STYLE", std::string(assets.css)},
                              {"SCRIPT_POLICY", "script-src 'unsafe-inline'; "},
                              {"PROGRAM", program}});
}

std::string ReportPageWithoutProgram(const std::string& title, const std::string& body) {
  const ReportAssets assets = GetReportAssets();
  return Filled(assets.html,
                {{"TITLE", XmlEscaped(title)}, {"STYLE", std::string(assets.css)}, {"BODY", body}});
}

}  // namespace luxfit
