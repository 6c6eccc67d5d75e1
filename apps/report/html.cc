#include "apps/report/html.h"

#include <fmt/format.h>

#include <cstddef>

#include "apps/charts/svg.h"

namespace luxfit {
namespace {

std::string Cell(const char* tag, const std::string& scope, const HtmlColumn& column,
                 const std::string& text) {
  return fmt::format("<{0} class=\"{1}\"{2}>{3}</{0}>", tag, column.is_number ? "number" : "text", scope,
                     XmlEscaped(text));
}

}  // namespace

std::string HtmlTable(const std::vector<HtmlColumn>& columns,
                      const std::vector<std::vector<std::string>>& rows) {
  std::string html = "<div class=\"scroll\"><table><thead><tr>";
  for (const HtmlColumn& column : columns) html += Cell("th", " scope=\"col\"", column, column.title);
  html += "</tr></thead>\n<tbody>\n";
  for (const std::vector<std::string>& row : rows) {
    html += "<tr>";
    for (std::size_t i = 0; i < columns.size(); ++i)
      html += i == 0 ? Cell("th", " scope=\"row\"", columns[i], row[i]) : Cell("td", "", columns[i], row[i]);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string HtmlPairs(const std::vector<std::pair<std::string, std::string>>& pairs) {
  std::string html = "<table class=\"pairs\"><tbody>\n";
  for (const auto& [name, value] : pairs)
    html += fmt::format("<tr><th scope=\"row\" class=\"text\">{}</th><td>{}</td></tr>\n", XmlEscaped(name),
                        XmlEscaped(value));
  return html + "</tbody></table>\n";
}

std::string HtmlParagraph(const std::string& text, const std::string& css_class) {
  return fmt::format("<p{}>{}</p>\n", css_class.empty() ? "" : " class=\"" + css_class + "\"",
                     XmlEscaped(text));
}

std::string HtmlHeading(int level, const std::string& text) {
  return fmt::format("<h{0}>{1}</h{0}>\n", level, XmlEscaped(text));
}

std::string HtmlSection(const std::string& id, const std::string& title, const std::string& lead,
                        const std::string& body_html) {
  return fmt::format("<section id=\"{}\">\n{}{}{}</section>\n", id, HtmlHeading(2, title),
                     lead.empty() ? "" : HtmlParagraph(lead, "lead"), body_html);
}

std::string HtmlFigure(const std::string& svg, const std::string& caption) {
  return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", svg, XmlEscaped(caption));
}

std::string HtmlSideBySide(const std::string& parts_html) {
  return "<div class=\"beside\">\n" + parts_html + "</div>\n";
}

std::string HtmlCards(const std::vector<HtmlCard>& cards) {
  std::string html = "<div class=\"cards\">\n";
  for (const HtmlCard& card : cards)
    html += fmt::format(
        "<div class=\"card\"><div class=\"card-title\">{}</div><div class=\"card-value\">{}<small> "
        "{}</small></div>"
        "<div class=\"card-note\">{}</div></div>\n",
        XmlEscaped(card.title), XmlEscaped(card.value), XmlEscaped(card.unit), XmlEscaped(card.note));
  return html + "</div>\n";
}

std::string HtmlDetails(const std::string& summary, const std::string& body_html) {
  return fmt::format("<details open><summary>{}</summary>\n{}</details>\n", XmlEscaped(summary), body_html);
}

}  // namespace luxfit
