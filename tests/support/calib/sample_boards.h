// Makes calibration boards of every type, sizes in m.
#ifndef LUXFIT_TESTS_SUPPORT_CALIB_SAMPLE_BOARDS_H_
#define LUXFIT_TESTS_SUPPORT_CALIB_SAMPLE_BOARDS_H_

#include "calib/targets/board.h"

namespace luxfit::support {

inline Board Chessboard(int columns, int rows, double square_size_m) {
  Board board;
  board.type = BoardType::kChessboard;
  board.columns = columns;
  board.rows = rows;
  board.square_size_m = square_size_m;
  return board;
}

inline Board Charuco(int columns, int rows, double square_size_m, double marker_size_m) {
  Board board = Chessboard(columns, rows, square_size_m);
  board.type = BoardType::kCharuco;
  board.tag_size_m = marker_size_m;
  return board;
}

inline Board AprilGrid(int columns, int rows, double tag_size_m) {
  Board board;
  board.columns = columns;
  board.rows = rows;
  board.tag_size_m = tag_size_m;
  board.spacing = 0.3;
  return board;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_CALIB_SAMPLE_BOARDS_H_
