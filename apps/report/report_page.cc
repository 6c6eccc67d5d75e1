#include "apps/report/report_page.h"

#include <map>
#include <nlohmann/json.hpp>

#include "apps/charts/svg.h"

namespace luxfit {

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
  const std::map<std::string, std::string> parts = {{"TITLE", XmlEscaped(title)},
                                                    {"STYLE", std::string(assets.css)},
                                                    {"DATA", JsonForHtml(data)},
                                                    {"SCRIPT", std::string(assets.script)}};
  // Placeholders are <!--NAME--> in the page's own text alone; inserted text is not searched again.
  std::string page;
  size_t at = 0;
  const std::string html(assets.html);
  for (size_t open; (open = html.find("<!--", at)) != std::string::npos;) {
    const size_t close = html.find("-->", open);
    const auto part = parts.find(html.substr(open + 4, close - open - 4));
    page += html.substr(at, open - at);
    if (part != parts.end()) page += part->second;
    at = close + 3;
  }
  return page + html.substr(at);
}

}  // namespace luxfit
