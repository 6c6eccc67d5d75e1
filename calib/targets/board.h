// Defines calibration boards: where their corners lie, where a photo shows them, and what is black on print.
// Reads and writes mrcal's corners.vnl.
//
// Board frame, metres: origin at the first corner, x along a row of the board, y along a column, z away from
// the viewer. The printed face looks along -z: a camera straight in front of the upright board has the
// board's axes along its own. Corners are numbered row by row; the board tells which points its corners are:
//
//   aprilgrid    the 4 corners of each of columns x rows tags' black squares, the grid of 2 columns x 2 rows
//                corners numbered row by row; tag ids from first_id, row by row from the *bottom-left* tag as
//                in Kalibr, whose corner is the origin there: here y points down, so the first corner is the
//                top-left one of the top-left tag
//   chessboard   columns x rows *inner* corners (OpenCV's and mrcal's count), square_size_m apart
//   charuco      columns x rows *squares* (OpenCV's count), (columns - 1) x (rows - 1) inner corners
//
// A drawing's places are x right, y down, metres, from the board's own origin. Its rectangles touch but do
// not overlap: drawn as one path they leave no seams.
//
// corners.vnl says where images show a board's corners:
//
//   # filename x y level
//   left01.jpg 244.4 94.1 0        one row per corner, all of a board in order
//   left01.jpg - - -               "-": not found
//
// level: the corner was found in the image shrunk by 2^level, so its weight is 2^-level. An image without any
// corner may be a single row of "-". Other columns are ignored. The header gives the order of the columns.
//
// Source: Kalibr's wiki, "Calibration targets"; OpenCV 4.6, calib3d and aruco; mrcal 2.2, "Calibration object
// corner finding"; vnlog.
#ifndef LUXFIT_CALIB_TARGETS_BOARD_H_
#define LUXFIT_CALIB_TARGETS_BOARD_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/photo_files/image.h"

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

// Returns every corner in the board frame, by its number. Throws std::invalid_argument naming the member that
// is missing or out of range.
std::vector<Eigen::Vector3d> BoardCorners(const Board& board);

// Returns how many corners lie along a row and along a column. Throws as BoardCorners does.
Eigen::Array2i BoardCornerCounts(const Board& board);

struct BoardCorner {
  int index = 0;  // into BoardCorners
  Eigen::Vector2d pixel;
  double sigma_px = 0;  // expected error per axis
};

struct BoardDetection {
  std::vector<BoardCorner> corners;  // by index; empty: the board was not found
  std::string message;               // says for the user what was not found and why; empty if all was
};

// Finds the board in a grey plane (height x width, any monotonic scale). Boards may be seen in part
// (aprilgrid, charuco). Throws std::invalid_argument as BoardCorners does.
BoardDetection DetectBoard(const ImagePlane& grey, const Board& board);

struct ImageCorners {
  std::string file;                  // as the table names it
  std::vector<BoardCorner> corners;  // only those found; sigma_px: 0.3 px 2^level
};

// Reads the images of a corners.vnl in the order of the table. `count`: corners of the board. Throws
// std::runtime_error("FILE:LINE: expected ..., got ...").
std::vector<ImageCorners> ReadCornersFile(const std::string& path, int count);

// Returns the content of a corners.vnl. A corner's level is that of its sigma over the least sigma, in whole
// steps.
std::string CornersFile(const std::vector<ImageCorners>& images, int count);

struct BlackRectangle {
  Eigen::Vector2d min_m, max_m;
};

struct BoardDrawing {
  std::vector<BlackRectangle> black;
  Eigen::Vector2d min_m, max_m;  // extent of all that is black
  double margin_m = 0;           // white that detection needs around it
};

struct BoardStyle {     // aprilgrid only
  int border_bits = 1;  // 2: as Kalibr prints, which libapriltag does not detect
  bool has_corner_squares =
      false;  // black squares between the tags' corners: libapriltag finds few tags then
};

// Draws a board: tags upright, ids from the bottom left; the top-left square of a chessboard and of a charuco
// is black. Throws std::invalid_argument as BoardCorners does, and for gaps between tags that are too narrow
// to be seen.
BoardDrawing DrawBoard(const Board& board, const BoardStyle& style = {});

// Draws one tag with its black square's top-left corner at the origin. Throws std::invalid_argument for an
// unknown family or id and a size that is not > 0.
BoardDrawing DrawSingleTag(const std::string& family, int id, double size_m);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_BOARD_H_
