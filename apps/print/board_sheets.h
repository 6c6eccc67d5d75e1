// Boards and room tags laid out on paper, with a scale bar and a caption.
//
// Throws std::runtime_error("--paper: expected at least ..., got ...; ...") where the drawing does not fit.
#ifndef LUXFIT_APPS_PRINT_BOARD_SHEETS_H_
#define LUXFIT_APPS_PRINT_BOARD_SHEETS_H_

#include <string>
#include <vector>

#include "apps/print/paper.h"
#include "apps/print/print_page.h"
#include "calib/targets/board_drawing.h"

namespace luxfit {

// Width and height of the paper that a drawing of that many millimetres needs, with rims, bar and caption.
Eigen::Vector2d SheetSizeMm(const BoardDrawing& drawing);

// The board in the middle of one page, turned to whichever way of the paper it fits.
PrintPage BoardSheet(const BoardDrawing& drawing, const Paper& paper, const std::string& caption);

// As many tags a page as fit, in the order of `ids`; beside each its family, id, size and an arrow to its
// top.
std::vector<PrintPage> TagSheets(const std::string& family, const std::vector<int>& ids, double size_m,
                                 const Paper& paper);

}  // namespace luxfit

#endif  // LUXFIT_APPS_PRINT_BOARD_SHEETS_H_
