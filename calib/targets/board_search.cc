#include "calib/targets/board_search.h"

#include <algorithm>
#include <array>

#include "calib/targets/internal/boards/april_grid.h"
#include "calib/targets/internal/boards/aruco_dictionary.h"
#include "calib/targets/internal/boards/charuco_board.h"
#include "calib/targets/internal/boards/chessboard.h"

namespace luxfit {
namespace {

// Returns the expected board as one of another kind.
Board AsKind(const Board& expected, BoardType type) {
  if (expected.type == type) return expected;
  const double size_m = expected.type == BoardType::kAprilGrid ? expected.tag_size_m : expected.square_size_m;
  Board board;
  board.type = type;
  board.columns = expected.columns;
  board.rows = expected.rows;
  board.square_size_m = type == BoardType::kAprilGrid ? 0 : size_m;
  board.tag_size_m = type == BoardType::kAprilGrid ? size_m : kPrintedMarkerShare * size_m;
  board.spacing = kPrintedTagGap;
  return board;
}

std::optional<Board> SearchKind(const ImagePlane& grey, const Board& expected) {
  switch (expected.type) {
    case BoardType::kCharuco:
      return SearchCharuco(grey, expected);
    case BoardType::kAprilGrid:
      return SearchAprilGrid(grey, expected);
    case BoardType::kChessboard:
      break;
  }
  return SearchChessboard(grey, expected);
}

bool DifferAtMostInRows(const Board& a, const Board& b) {
  return a.type == b.type && a.columns == b.columns && a.family == b.family && a.dictionary == b.dictionary &&
         (a.type != BoardType::kChessboard || a.rows == b.rows);
}

}  // namespace

std::optional<Board> SearchBoard(const ImagePlane& grey, const Board& expected) {
  BoardCornerCounts(expected);  // throws
  if (grey.size() == 0) return {};
  // Boards of tags have corners as chessboards have, so those without codes come last.
  std::array<BoardType, 3> kinds = {BoardType::kCharuco, BoardType::kAprilGrid, BoardType::kChessboard};
  if (expected.type == BoardType::kAprilGrid) std::swap(kinds[0], kinds[1]);
  for (const BoardType kind : kinds) {
    if (auto board = SearchKind(grey, AsKind(expected, kind))) return board;
  }
  return {};
}

std::vector<std::string> DictionariesAlike(const std::string& dictionary) {
  return LargerArucoDictionaries(dictionary);
}

std::optional<ShownBoard> MostShown(const std::vector<std::optional<Board>>& found) {
  std::vector<ShownBoard> shown;
  for (const std::optional<Board>& board : found) {
    if (!board) continue;
    const auto same = std::find_if(shown.begin(), shown.end(), [&](const ShownBoard& other) {
      return DifferAtMostInRows(other.board, *board);
    });
    if (same == shown.end()) {
      shown.push_back({*board, 1});
      continue;
    }
    ++same->photos;
    same->board.rows = std::max(same->board.rows, board->rows);
  }
  if (shown.empty()) return {};
  return *std::max_element(shown.begin(), shown.end(),
                           [](const ShownBoard& a, const ShownBoard& b) { return a.photos < b.photos; });
}

}  // namespace luxfit
