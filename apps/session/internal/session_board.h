// Reads the `board = { ... }` of a [[camera]], which its calibration images show.
//
// The keys depend on the type. aprilgrid: columns, rows, tag_size_m, spacing, family, first_id; chessboard:
// columns, rows, square_size_m; charuco: columns, rows, square_size_m, marker_size_m, dictionary, first_id.
//
// Throws std::runtime_error("FILE:LINE: camera[i].board.key: expected ..., got ...; remedy").
// Source: docs/session-format.md.
#ifndef LUXFIT_APPS_SESSION_INTERNAL_SESSION_BOARD_H_
#define LUXFIT_APPS_SESSION_INTERNAL_SESSION_BOARD_H_

#include "apps/text/formats/toml_reader.h"
#include "calib/targets/board.h"

namespace luxfit {

Board ReadBoard(const TomlCursor& table);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_INTERNAL_SESSION_BOARD_H_
