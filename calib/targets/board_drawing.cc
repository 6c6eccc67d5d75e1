#include "calib/targets/board.h"

#include <cmath>
#include <stdexcept>

#include "calib/targets/internal/boards/aruco_dictionary.h"
#include "calib/targets/internal/tags/tag_family.h"

namespace luxfit {
namespace {

using Cells = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;  // true: black; row down, column right

// Adds black cells of side `cell_m`, with runs along rows joined. The top-left corner of cell (0, 0) is at
// `origin_m`.
void AddCells(const Cells& black, const Eigen::Vector2d& origin_m, double cell_m, BoardDrawing& drawing) {
  for (Eigen::Index row = 0; row < black.rows(); ++row) {
    for (Eigen::Index first = 0; first < black.cols(); ++first) {
      if (!black(row, first)) continue;
      Eigen::Index end = first;
      while (end < black.cols() && black(row, end)) ++end;
      const auto at = [&](Eigen::Index column, Eigen::Index line) {
        return Eigen::Vector2d(
            origin_m + cell_m * Eigen::Vector2d(static_cast<double>(column), static_cast<double>(line)));
      };
      drawing.black.push_back({at(first, row), at(end, row + 1)});
      first = end;
    }
  }
}

void AddSquare(const Eigen::Vector2d& min_m, double size_m, BoardDrawing& drawing) {
  AddCells(Cells::Constant(1, 1, true), min_m, size_m, drawing);
}

// Adds a tag whose black square is `size_m` wide and begins at `corner_m`.
void AddTag(const apriltag_family_t& family, int id, int border_bits, const Eigen::Vector2d& corner_m,
            double size_m, BoardDrawing& drawing) {
  const TagPicture picture = DrawTag(family, id, border_bits);
  const double cell_m = size_m / (picture.border_end - picture.border_begin);
  const Eigen::Vector2d origin_m = corner_m - Eigen::Vector2d::Constant(picture.border_begin * cell_m);
  AddCells(picture.cells < 0.5, origin_m, cell_m, drawing);
}

BoardDrawing Bounded(BoardDrawing drawing, double margin_m) {
  drawing.min_m = drawing.black.front().min_m;
  drawing.max_m = drawing.black.front().max_m;
  for (const BlackRectangle& rectangle : drawing.black) {
    drawing.min_m = drawing.min_m.cwiseMin(rectangle.min_m);
    drawing.max_m = drawing.max_m.cwiseMax(rectangle.max_m);
  }
  drawing.margin_m = margin_m;
  return drawing;
}

// Returns the width, in tag sizes, of a tag's picture beyond its black square on one side.
double RimInTagSizes(const TagPicture& picture) {
  return static_cast<double>(picture.border_begin) / (picture.border_end - picture.border_begin);
}

BoardDrawing DrawAprilGrid(const Board& board, const BoardStyle& style) {
  const std::vector<Eigen::Vector3d> corners = BoardCorners(board);
  const TagFamilyPtr family = MakeTagFamily(board.family);
  const TagPicture picture = DrawTag(*family, board.first_id, style.border_bits);
  const double rim = RimInTagSizes(picture);
  if (family->reversed_border && style.has_corner_squares)
    throw std::invalid_argument("has_corner_squares: expected a family with a black border, got " +
                                board.family);
  // Tags share a white rim one cell wide; bits outside the square are not shared.
  const double least = family->reversed_border ? 2 * rim : rim;
  if (board.spacing < least)
    throw std::invalid_argument("spacing: expected at least " + std::to_string(least) + " tag sizes for " +
                                board.family + ", got " + std::to_string(board.spacing));
  BoardDrawing drawing;
  for (int row = 0; row < board.rows; ++row) {
    for (int column = 0; column < board.columns; ++column) {
      const int corner = 4 * row * board.columns + 2 * column;
      const int id = board.first_id + (board.rows - 1 - row) * board.columns + column;
      AddTag(*family, id, style.border_bits, corners[static_cast<std::size_t>(corner)].head<2>(),
             board.tag_size_m, drawing);
    }
  }
  const double gap_m = board.spacing * board.tag_size_m, pitch_m = board.tag_size_m + gap_m;
  if (style.has_corner_squares) {
    for (int row = 0; row <= board.rows; ++row) {
      for (int column = 0; column <= board.columns; ++column)
        AddSquare(pitch_m * Eigen::Vector2d(column, row) - Eigen::Vector2d::Constant(gap_m), gap_m, drawing);
    }
  }
  return Bounded(std::move(drawing), rim * board.tag_size_m);
}

void AddCheckers(int columns, int rows, double square_m, BoardDrawing& drawing) {
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      if ((column + row) % 2 == 0)
        AddSquare(square_m * Eigen::Vector2d(column - 1, row - 1), square_m, drawing);
    }
  }
}

BoardDrawing DrawChessboard(const Board& board) {
  BoardDrawing drawing;
  AddCheckers(board.columns + 1, board.rows + 1, board.square_size_m, drawing);
  return Bounded(std::move(drawing), board.square_size_m / 2);
}

BoardDrawing DrawCharuco(const Board& board) {
  const cv::Ptr<cv::aruco::Dictionary> dictionary = ArucoDictionary(board.dictionary);
  const int width = dictionary->markerSize + 2;
  BoardDrawing drawing;
  AddCheckers(board.columns, board.rows, board.square_size_m, drawing);
  int id = board.first_id;
  const double inset_m = (board.square_size_m - board.tag_size_m) / 2;
  for (int row = 0; row < board.rows; ++row) {
    for (int column = 0; column < board.columns; ++column) {
      if ((column + row) % 2 == 0) continue;
      const cv::Mat bits = cv::aruco::Dictionary::getBitsFromByteList(
          dictionary->bytesList.rowRange(id, id + 1), dictionary->markerSize);
      Cells black = Cells::Constant(width, width, true);
      for (int y = 0; y < bits.rows; ++y) {
        for (int x = 0; x < bits.cols; ++x) black(y + 1, x + 1) = bits.at<uchar>(y, x) == 0;
      }
      const Eigen::Vector2d square_m = board.square_size_m * Eigen::Vector2d(column - 1, row - 1);
      AddCells(black, square_m + Eigen::Vector2d::Constant(inset_m), board.tag_size_m / width, drawing);
      ++id;
    }
  }
  return Bounded(std::move(drawing), board.square_size_m / 4);
}

}  // namespace

BoardDrawing DrawBoard(const Board& board, const BoardStyle& style) {
  BoardCornerCounts(board);  // throws
  switch (board.type) {
    case BoardType::kAprilGrid:
      return DrawAprilGrid(board, style);
    case BoardType::kChessboard:
      return DrawChessboard(board);
    case BoardType::kCharuco:
      break;
  }
  return DrawCharuco(board);
}

BoardDrawing DrawSingleTag(const std::string& family, int id, double size_m) {
  if (!(size_m > 0) || !std::isfinite(size_m))
    throw std::invalid_argument("size_m: expected > 0, got " + std::to_string(size_m));
  const TagFamilyPtr its_family = MakeTagFamily(family);
  BoardDrawing drawing;
  AddTag(*its_family, id, 1, Eigen::Vector2d::Zero(), size_m, drawing);
  return Bounded(std::move(drawing), size_m * RimInTagSizes(DrawTag(*its_family, id)));
}

}  // namespace luxfit
