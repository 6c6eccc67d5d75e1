// Lays out boards and room tags on paper, with a scale bar and a caption.
//
// Throws std::runtime_error("--paper: expected at least ..., got ...; ...") where the drawing does not fit.
#ifndef LUXFIT_APPS_PRINT_BOARD_SHEETS_H_
#define LUXFIT_APPS_PRINT_BOARD_SHEETS_H_

#include <string>
#include <vector>

#include "apps/print/paper.h"
#include "apps/print/print_page.h"
#include "calib/targets/board.h"

namespace luxfit {

// Returns the width and height of the paper that a drawing of that many millimetres needs, with rims, bar and
// caption.
Eigen::Vector2d SheetSizeMm(const BoardDrawing& drawing);

// Draws the board in the middle of one page, turned so that it fits the paper.
PrintPage BoardSheet(const BoardDrawing& drawing, const Paper& paper, const std::string& caption);

// Draws as many tags on each page as fit, in the order of `ids`. Each has its family, id, size and an arrow
// to its top.
std::vector<PrintPage> TagSheets(const std::string& family, const std::vector<int>& ids, double size_m,
                                 const Paper& paper);

}  // namespace luxfit

#endif  // LUXFIT_APPS_PRINT_BOARD_SHEETS_H_
