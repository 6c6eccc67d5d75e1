#include "apps/stages/calibrate/board_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "apps/text/suggest.h"
#include "calib/targets/board_search.h"

namespace luxfit {
namespace {

constexpr double kLargestSizeM = 2.0;  // a greater number was meant as millimetres

std::runtime_error BadBoard(const std::string& message) { return std::runtime_error("--board: " + message); }

std::vector<std::string> PartsOf(const std::string& text) {
  std::vector<std::string> parts;
  std::size_t start = 0;
  while (start <= text.size()) {
    const std::size_t end = std::min(text.find(':', start), text.size());
    parts.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return parts;
}

BoardType TypeFrom(const std::string& name) {
  if (name == "chessboard") return BoardType::kChessboard;
  if (name == "charuco") return BoardType::kCharuco;
  if (name == "aprilgrid") return BoardType::kAprilGrid;
  throw BadBoard(ExpectedOneOf({"chessboard", "charuco", "aprilgrid"}, name) +
                 "; such as chessboard:9x6:0.025, charuco:8x6:0.04 or aprilgrid:6x6:0.088");
}

// Returns what the type's text looks like whole, and in an example.
std::string FormOf(BoardType type) {
  switch (type) {
    case BoardType::kChessboard:
      return "chessboard:COLUMNSxROWS:SQUARE_M, with inner corners, such as chessboard:9x6:0.025";
    case BoardType::kCharuco:
      return "charuco:COLUMNSxROWS:SQUARE_M[:MARKER_M[:DICTIONARY]], with squares, such as "
             "charuco:8x6:0.04:0.028";
    case BoardType::kAprilGrid:
      break;
  }
  return "aprilgrid:COLUMNSxROWS:TAG_M[:GAP_IN_TAGS[:FAMILY]], such as aprilgrid:6x6:0.088:0.3";
}

double PositiveNumber(const std::string& part, const std::string& what) {
  char* end = nullptr;
  const double value = std::strtod(part.c_str(), &end);
  if (part.empty() || *end != '\0' || !(value > 0))
    throw BadBoard("expected " + what + " above 0, got " + Quoted(part));
  return value;
}

double SizeM(const std::string& part, const std::string& what) {
  const double size_m = PositiveNumber(part, what);
  if (size_m > kLargestSizeM)
    throw BadBoard(
        fmt::format("expected {} in metres, got {}; write {:g} for {} mm", what, part, size_m / 1000, part));
  return size_m;
}

void ReadCounts(const std::string& part, Board& board) {
  char rest = 0;
  if (std::sscanf(part.c_str(), "%dx%d%c", &board.columns, &board.rows, &rest) != 2)
    throw BadBoard("expected COLUMNSxROWS such as 9x6, got " + Quoted(part) + "; the whole is " +
                   FormOf(board.type));
}

void ReadSizes(const std::vector<std::string>& parts, Board& board) {
  if (board.type == BoardType::kAprilGrid) {
    board.tag_size_m = SizeM(parts[2], "the side of a tag's black square");
    board.spacing =
        parts.size() > 3 ? PositiveNumber(parts[3], "the gap between tags, in tag sizes,") : kPrintedTagGap;
    if (parts.size() > 4) board.family = parts[4];
    return;
  }
  board.square_size_m = SizeM(parts[2], "the side of a square");
  if (board.type == BoardType::kChessboard) return;
  board.tag_size_m =
      parts.size() > 3 ? SizeM(parts[3], "the side of a marker") : kPrintedMarkerShare * board.square_size_m;
  if (parts.size() > 4) board.dictionary = parts[4];
}

}  // namespace

Board BoardFromArgument(const std::string& text) {
  const std::vector<std::string> parts = PartsOf(text);
  Board board;
  board.type = TypeFrom(parts[0]);
  const std::size_t most = board.type == BoardType::kChessboard ? 3 : 5;
  if (parts.size() < 3 || parts.size() > most)
    throw BadBoard("expected " + FormOf(board.type) + ", got " + Quoted(text));
  ReadCounts(parts[1], board);
  ReadSizes(parts, board);
  try {
    BoardCorners(board);
  } catch (const std::invalid_argument& error) {
    throw BadBoard(std::string(error.what()) + "; correct " + Quoted(text));
  }
  return board;
}

std::string BoardArgument(const Board& board) {
  const std::string counts = fmt::format("{}x{}", board.columns, board.rows);
  switch (board.type) {
    case BoardType::kChessboard:
      return fmt::format("chessboard:{}:{:g}", counts, board.square_size_m);
    case BoardType::kCharuco:
      return fmt::format("charuco:{}:{:g}:{:g}:{}", counts, board.square_size_m, board.tag_size_m,
                         board.dictionary);
    case BoardType::kAprilGrid:
      break;
  }
  return fmt::format("aprilgrid:{}:{:g}:{:g}:{}", counts, board.tag_size_m, board.spacing, board.family);
}

std::string BoardLine(const Board& board) {
  const std::string counts = fmt::format("columns = {}, rows = {}", board.columns, board.rows);
  const std::string first = board.first_id > 0 ? fmt::format(", first_id = {}", board.first_id) : "";
  switch (board.type) {
    case BoardType::kAprilGrid:
      return fmt::format("board = {{ type = \"aprilgrid\", {}, tag_size_m = {:g}, spacing = {:g}{}{} }}",
                         counts, board.tag_size_m, board.spacing,
                         board.family == "tag36h11" ? "" : fmt::format(", family = \"{}\"", board.family),
                         first);
    case BoardType::kChessboard:
      return fmt::format("board = {{ type = \"chessboard\", {}, square_size_m = {:g} }}", counts,
                         board.square_size_m);
    case BoardType::kCharuco:
      break;
  }
  return fmt::format(
      "board = {{ type = \"charuco\", {}, square_size_m = {:g}, marker_size_m = {:g}, dictionary = \"{}\"{} "
      "}}",
      counts, board.square_size_m, board.tag_size_m, board.dictionary, first);
}

}  // namespace luxfit
