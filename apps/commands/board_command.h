// Runs `luxfit board`: prints calibration boards and room tags as SVG or PDF at true scale.
//
// Prints what belongs in the session: the `board = { ... }` of its camera, or [tags].
//
// Throws std::runtime_error for bad input and for a drawing that does not fit its paper (exit status 2).
// Source: docs/session-format.md, "Boards".
#ifndef LUXFIT_APPS_COMMANDS_BOARD_COMMAND_H_
#define LUXFIT_APPS_COMMANDS_BOARD_COMMAND_H_

#include <string>

#include "calib/targets/board.h"

namespace luxfit {

struct BoardCommandOptions {
  std::string type;  // aprilgrid | chessboard | charuco | tags
  std::string file;  // .svg or .pdf
  std::string paper = "A4";
  int columns = 0, rows = 0;  // 0: those of the type
  double tag_size_m = 0;      // 0: the largest, to half a millimetre, that fits
  double spacing = 0.3;
  double square_size_m = 0;  // as tag_size_m
  double marker_size_m = 0;  // 0: 0.7 squares
  int first_id = 0;
  std::string ids = "0-3";  // tags: "0-11,20"
  std::string family = "tag36h11";
  std::string dictionary = Board().dictionary;  // as boards that do not name one
  bool has_corner_squares = false;
  int border_bits = 1;
};

int BoardCommand(const BoardCommandOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_BOARD_COMMAND_H_
