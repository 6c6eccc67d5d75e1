#include "calib/targets/internal/boards/chessboard.h"

#include <algorithm>
#include <opencv2/calib3d.hpp>

#include "calib/luminance/internal/plane_sample.h"
#include "calib/targets/internal/boards/checker_corner.h"
#include "calib/targets/internal/boards/homography.h"
#include "calib/targets/internal/tags/find_tags.h"

namespace luxfit {
namespace {

// Longer sides of the photo in which each of OpenCV's two detectors searches. The first is fast and finds
// most boards; the second finds blurred and oblique ones.
constexpr int kFastLongestPx = 800, kRobustLongestPx = 1200;
constexpr double kClearSquares = 0.45;  // the outermost squares of some prints are half as wide

// Holds rows of corners, as many as the board has; pixels of the full photo.
struct CornerGrid {
  int columns = 0, rows = 0;
  std::vector<Eigen::Vector2d> pixels;  // row by row

  const Eigen::Vector2d& At(int column, int row) const {
    const int index = row * columns + column;
    return pixels[static_cast<std::size_t>(index)];
  }
};

// Returns the same corners numbered from another one of the four ends, or along columns first.
CornerGrid Renumbered(const CornerGrid& grid, bool flip_columns, bool flip_rows, bool transpose) {
  CornerGrid other{grid.columns, grid.rows, {}};
  other.pixels.reserve(grid.pixels.size());
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      int from_column = transpose ? row : column, from_row = transpose ? column : row;
      if (flip_columns) from_column = grid.columns - 1 - from_column;
      if (flip_rows) from_row = grid.rows - 1 - from_row;
      other.pixels.push_back(grid.At(from_column, from_row));
    }
  }
  return other;
}

CornerGrid FindCorners(const ImagePlane& grey, const Board& board) {
  const cv::Size size(board.columns, board.rows);
  std::vector<cv::Point2f> corners;
  ReducedPhoto photo = ReducePhoto(grey, kFastLongestPx);
  const auto is_large_enough = [&] { return std::min(photo.grey.rows, photo.grey.cols) >= 16; };
  if (!is_large_enough()) return {};
  if (!cv::findChessboardCorners(photo.grey, size, corners)) {
    photo = ReducePhoto(grey, kRobustLongestPx);
    if (!cv::findChessboardCornersSB(photo.grey, size, corners, cv::CALIB_CB_NORMALIZE_IMAGE)) return {};
  }
  CornerGrid grid{board.columns, board.rows, {}};
  grid.pixels.reserve(corners.size());
  for (const cv::Point2f& corner : corners) grid.pixels.push_back(photo.ToFull({corner.x, corner.y}));
  return grid;
}

// Returns whether rows (x) and columns (y) turn clockwise in the photo, as its own axes do: the front is
// seen.
bool IsFromTheFront(const CornerGrid& grid) {
  const Eigen::Vector2d right = grid.At(grid.columns - 1, 0) - grid.At(0, 0);
  const Eigen::Vector2d down = grid.At(0, grid.rows - 1) - grid.At(0, 0);
  return right.x() * down.y() - right.y() * down.x() > 0;
}

// Returns whether the square outside the first corner is black, by the mean greys of both colours.
bool IsFirstSquareBlack(const ImagePlane& grey, const CornerGrid& grid) {
  double black = 0, white = 0;
  // Only squares inside the corners are certain to be in the photo: (1, 1) has the first one's colour.
  for (int row = 0; row + 1 < grid.rows; ++row) {
    for (int column = 0; column + 1 < grid.columns; ++column) {
      const Eigen::Vector2d middle = (grid.At(column, row) + grid.At(column + 1, row) +
                                      grid.At(column, row + 1) + grid.At(column + 1, row + 1)) /
                                     4;
      const double value = SampleBilinear(grey, middle);
      if (!std::isfinite(value)) continue;
      // The squares divide about equally between the two colours, so the difference of the sums decides.
      ((column + row) % 2 == 0 ? black : white) += value;
    }
  }
  const int squares = (grid.columns - 1) * (grid.rows - 1);
  const int blacks = (squares + 1) / 2, whites = squares / 2;
  return black / blacks < white / whites;
}

// Returns the numbering that the header states.
CornerGrid Oriented(const ImagePlane& grey, const CornerGrid& grid) {
  CornerGrid best;
  double best_right = 0;
  bool is_best_black = false;
  for (int i = 0; i < 8; ++i) {
    const bool transpose = (i & 4) != 0;
    if (transpose && grid.columns != grid.rows) continue;
    const CornerGrid other = Renumbered(grid, (i & 1) != 0, (i & 2) != 0, transpose);
    if (!IsFromTheFront(other)) continue;
    const bool is_black = IsFirstSquareBlack(grey, other);
    const double right = (other.At(grid.columns - 1, 0) - other.At(0, 0)).normalized().x();
    if (!best.pixels.empty() &&
        (is_best_black > is_black || (is_best_black == is_black && best_right >= right)))
      continue;
    best = other;
    best_right = right;
    is_best_black = is_black;
  }
  return best;
}

// Returns the map from board to pixels about one corner, from it and its neighbours.
std::optional<Eigen::Matrix3d> PixelFromBoardNear(const CornerGrid& grid, int column, int row,
                                                  double square_m) {
  std::vector<Eigen::Vector2d> from, to;
  for (int r = std::max(0, row - 1); r <= std::min(grid.rows - 1, row + 1); ++r) {
    for (int c = std::max(0, column - 1); c <= std::min(grid.columns - 1, column + 1); ++c) {
      from.push_back(square_m * Eigen::Vector2d(c, r));
      to.push_back(grid.At(c, r));
    }
  }
  return FitHomography(from, to);
}

}  // namespace

BoardDetection DetectChessboard(const ImagePlane& grey, const Board& board) {
  BoardDetection detection;
  const CornerGrid found = FindCorners(grey, board);
  if (found.pixels.empty()) {
    detection.message = "no chessboard of " + std::to_string(board.columns) + " x " +
                        std::to_string(board.rows) +
                        " inner corners was found; it must be seen whole, with a white rim";
    return detection;
  }
  const CornerGrid grid = Oriented(grey, found);
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const auto homography = PixelFromBoardNear(grid, column, row, board.square_size_m);
      if (!homography) continue;
      CheckerCorner corner;
      corner.place_m = board.square_size_m * Eigen::Vector2d(column, row);
      corner.clear_m = kClearSquares * board.square_size_m;
      corner.is_top_left_black = (column + row) % 2 == 0;
      const auto saddle = MeasureCheckerCorner(grey, *homography, corner);
      if (saddle) detection.corners.push_back({row * grid.columns + column, saddle->pixel, saddle->sigma_px});
    }
  }
  const std::size_t all = grid.pixels.size();
  if (detection.corners.size() < all)
    detection.message = std::to_string(all - detection.corners.size()) + " of " + std::to_string(all) +
                        " corners could not be measured: too small, blurred or covered";
  return detection;
}

std::optional<Board> SearchChessboard(const ImagePlane& grey, const Board& expected) {
  constexpr int kLeastCorners = 3;
  const ReducedPhoto photo = ReducePhoto(grey, kRobustLongestPx);
  std::vector<cv::Point2f> corners;
  cv::Mat marks;  // of the grid's size
  if (!cv::findChessboardCornersSB(photo.grey, {kLeastCorners, kLeastCorners}, corners,
                                   cv::CALIB_CB_LARGER | cv::CALIB_CB_NORMALIZE_IMAGE, marks))
    return {};
  const auto [less, more] = std::minmax(marks.cols, marks.rows);
  Board board = expected;
  const bool is_upright = expected.rows > expected.columns;
  board.columns = is_upright ? less : more;
  board.rows = is_upright ? more : less;
  return board;
}

}  // namespace luxfit
