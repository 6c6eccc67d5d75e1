// Makes the pieces of HTML of which a page without a program consists. Every text is escaped; parameters that
// are HTML already say so in their names.
#ifndef LUXFIT_APPS_REPORT_HTML_H_
#define LUXFIT_APPS_REPORT_HTML_H_

#include <string>
#include <utility>
#include <vector>

namespace luxfit {

struct HtmlColumn {
  std::string title;
  bool is_number = false;
};

// Returns a table in a box that scrolls by itself where the page is narrow. A row has as many texts as there
// are columns; its first one is its heading.
std::string HtmlTable(const std::vector<HtmlColumn>& columns,
                      const std::vector<std::vector<std::string>>& rows);

// Returns names beside values.
std::string HtmlPairs(const std::vector<std::pair<std::string, std::string>>& pairs);

// `css_class` is a class of page/style.css, or empty.
std::string HtmlParagraph(const std::string& text, const std::string& css_class = "");

std::string HtmlHeading(int level, const std::string& text);

// An empty lead is left out.
std::string HtmlSection(const std::string& id, const std::string& title, const std::string& lead,
                        const std::string& body_html);

std::string HtmlFigure(const std::string& svg, const std::string& caption);

// Returns parts side by side, where there is room.
std::string HtmlSideBySide(const std::string& parts_html);

struct HtmlCard {
  std::string title, value, unit, note;
};
std::string HtmlCards(const std::vector<HtmlCard>& cards);

// Returns a part that can be folded, open at first: paper cannot unfold it.
std::string HtmlDetails(const std::string& summary, const std::string& body_html);

}  // namespace luxfit

#endif  // LUXFIT_APPS_REPORT_HTML_H_
