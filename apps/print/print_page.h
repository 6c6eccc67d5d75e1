// Writes pages to print at true scale: black rectangles, lines and text, in millimetres from the top-left
// corner.
//
// A page is written as SVG (one page a file, its size in mm) or as PDF. All rectangles form one path, so that
// those that touch leave no seam.
#ifndef LUXFIT_APPS_PRINT_PRINT_PAGE_H_
#define LUXFIT_APPS_PRINT_PRINT_PAGE_H_

#include <Eigen/Core>
#include <string>
#include <vector>

namespace luxfit {

struct PrintRectangle {
  Eigen::Vector2d min_mm, max_mm;
};

struct PrintLine {
  Eigen::Vector2d from_mm, to_mm;
};

struct PrintText {
  Eigen::Vector2d at_mm;  // left end of the base line
  double height_mm = 3;   // font size
  std::string text;       // ASCII
};

struct PrintPage {
  Eigen::Vector2d size_mm;
  std::vector<PrintRectangle> black;
  std::vector<PrintLine> lines;
  std::vector<PrintText> texts;
};

std::string PageSvg(const PrintPage& page);

// Returns the bytes of a PDF file.
std::string PagesPdf(const std::vector<PrintPage>& pages, const std::string& title);

}  // namespace luxfit

#endif  // LUXFIT_APPS_PRINT_PRINT_PAGE_H_
