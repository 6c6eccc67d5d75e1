#include "apps/report/report_page.h"

#include <fmt/format.h>

#include <cctype>
#include <ctime>
#include <map>
#include <nlohmann/json.hpp>

#include "apps/charts/svg.h"
#include "apps/version.h"

namespace luxfit {
namespace {

// Inserts a text in place of each mark <!--NAME--> of an HTML template. What is inserted is not searched again.
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

// Writes a text as a string of CSS: letters and digits as they are, other ASCII as the numbers of its characters, so that
// no name ends the string or the style.
std::string CssString(const std::string& text) {
  std::string css = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    css += byte >= 0x80 || std::isalnum(byte) != 0 ? std::string(1, c) : fmt::format("\\{:x} ", byte);
  }
  return css + '"';
}

// Prints title, version, date and page number on every sheet.
std::string SheetHeads(const std::string& title) {
  const std::string font = "font: 8pt system-ui, sans-serif; color: #667";
  return fmt::format("@page {{ @top-left {{ content: {}; {} }} @top-right {{ content: {}; {} }} ",
                     CssString(title), font, CssString(fmt::format("luxfit {}, {}", kVersion, NowUtc())),
                     font) +
         fmt::format("@bottom-right {{ content: counter(page) \" / \" counter(pages); {} }} }}\n", font);
}

std::string StyleOf(const std::string& title) {
  return std::string(GetReportAssets().css) + SheetHeads(title);
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
                              {"STYLE", StyleOf(title)},
                              {"SCRIPT_POLICY", "script-src 'unsafe-inline'; "},
                              {"PROGRAM", program}});
}

std::string ReportPageWithoutProgram(const std::string& title, const std::string& body) {
  const ReportAssets assets = GetReportAssets();
  return Filled(assets.html, {{"TITLE", XmlEscaped(title)}, {"STYLE", StyleOf(title)}, {"BODY", body}});
}

}  // namespace luxfit
