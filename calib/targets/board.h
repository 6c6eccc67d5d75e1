// Calibration boards: where their corners lie, and where a photo shows them.
//
// Board frame: origin at the first corner, x along a row of the board, y along a column, z away from the
// viewer (the printed face looks along -z), metres: a camera straight in front of the upright board has the
// board's axes along its own. Corners are numbered row by row; what a corner is depends on the board:
//
//   aprilgrid    the 4 corners of each of columns x rows tags' black squares, the grid of 2 columns x 2 rows
//                corners numbered row by row; tag ids from first_id, row by row from the *bottom-left* tag as
//                in Kalibr, whose corner is the origin there: here y points down, so the first corner is the
//                top-left one of the top-left tag
//   chessboard   columns x rows *inner* corners (OpenCV's and mrcal's count), square_size_m apart
//   charuco      columns x rows *squares* (OpenCV's count), (columns - 1) x (rows - 1) inner corners
//
// Source: Kalibr's wiki, "Calibration targets"; OpenCV 4.6, calib3d and aruco.
#ifndef LUXFIT_CALIB_TARGETS_BOARD_H_
#define LUXFIT_CALIB_TARGETS_BOARD_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/luminance/image.h"

namespace luxfit {

enum class BoardType { kAprilGrid, kChessboard, kCharuco };

struct Board {
  BoardType type = BoardType::kAprilGrid;
  int columns = 0, rows = 0;
  double tag_size_m = 0;                   // aprilgrid: side of a tag's black square; charuco: of its markers
  double spacing = 0;                      // aprilgrid: gap between black squares, in tag sizes
  double square_size_m = 0;                // chessboard, charuco
  int first_id = 0;                        // aprilgrid, charuco
  std::string family = "tag36h11";         // aprilgrid
  std::string dictionary = "DICT_4X4_50";  // charuco: OpenCV's name
};

// Every corner in the board frame, by its number. Throws std::invalid_argument naming the member that is
// missing or out of range.
std::vector<Eigen::Vector3d> BoardCorners(const Board& board);

// How many corners lie along a row and a column.
Eigen::Array2i BoardCornerCounts(const Board& board);

struct BoardCorner {
  int index = 0;  // into BoardCorners
  Eigen::Vector2d pixel;
  double sigma_px = 0;  // expected error per axis
};

struct BoardDetection {
  std::vector<BoardCorner> corners;  // by index; empty: the board was not found
  std::string message;               // what was not found and why, for the user; empty if all was
};

// Finds the board in a grey plane (height x width, any monotonic scale). Boards may be seen in part
// (aprilgrid, charuco). Throws std::invalid_argument as BoardCorners does.
BoardDetection DetectBoard(const ImagePlane& grey, const Board& board);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_BOARD_H_
