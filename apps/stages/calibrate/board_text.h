// Reads and writes calibration boards as a person types them: on a command line, or as a line of a session.
//
//   chessboard:9x6:0.025                        inner corners; the side of a square, m
//   charuco:8x6:0.04[:0.028[:DICT_4X4_50]]      squares; the sides of a square and of a marker, m (absent: 0.7 squares);
//                                               dictionary
//   aprilgrid:6x6:0.088[:0.3[:tag36h11]]        tags; the side of a tag's black square, m; the gap between two in tag sizes;
//                                               family
//
// Text in brackets may be absent. A session's line has the same board as `board = { type = "chessboard", ... }`.
// Source: docs/session-format.md, "Boards".
#ifndef LUXFIT_APPS_STAGES_CALIBRATE_BOARD_TEXT_H_
#define LUXFIT_APPS_STAGES_CALIBRATE_BOARD_TEXT_H_

#include <string>

#include "calib/targets/board.h"

namespace luxfit {

// Throws std::runtime_error("--board: expected ..., got ...") for a text that describes no board.
Board BoardFromArgument(const std::string& text);

// Return the board as above, and as a line of a session.
std::string BoardArgument(const Board& board);
std::string BoardLine(const Board& board);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_CALIBRATE_BOARD_TEXT_H_
