#include "apps/session/internal/session_board.h"

#include <stdexcept>

namespace luxfit {
namespace {

BoardType ReadType(const TomlCursor& table) {
  const std::string type =
      table.Require("type", "aprilgrid, chessboard or charuco").OneOf({"aprilgrid", "chessboard", "charuco"});
  if (type == "aprilgrid") return BoardType::kAprilGrid;
  return type == "chessboard" ? BoardType::kChessboard : BoardType::kCharuco;
}

std::vector<std::string> KeysOf(BoardType type) {
  switch (type) {
    case BoardType::kAprilGrid:
      return {"type", "columns", "rows", "tag_size_m", "spacing", "family", "first_id"};
    case BoardType::kChessboard:
      return {"type", "columns", "rows", "square_size_m"};
    case BoardType::kCharuco:
      break;
  }
  return {"type", "columns", "rows", "square_size_m", "marker_size_m", "dictionary", "first_id"};
}

void ReadAprilGrid(const TomlCursor& table, Board& board) {
  board.tag_size_m = table.Require("tag_size_m", "the side of a tag's black square, m").NumberAbove(0, "m");
  board.spacing =
      table.Require("spacing", "the gap between black squares, in tag sizes").NumberAbove(0, "tag sizes");
  if (const auto family = table.Find("family")) board.family = family->Text("a tag family");
}

void ReadCharuco(const TomlCursor& table, Board& board) {
  board.tag_size_m = table.Require("marker_size_m", "the side of a marker, m").NumberAbove(0, "m");
  if (const auto dictionary = table.Find("dictionary"))
    board.dictionary = dictionary->Text("a dictionary of OpenCV's, \"DICT_4X4_50\"");
}

int ReadFirstId(const TomlCursor& value) {
  const double id = value.NumberAtLeast(0, "an id");
  if (id != static_cast<int>(id)) throw value.Error("expected a whole number, got " + value.Shown());
  return static_cast<int>(id);
}

}  // namespace

Board ReadBoard(const TomlCursor& table) {
  Board board;
  board.type = ReadType(table);
  table.ExpectKeys(KeysOf(board.type));
  board.columns = table.Require("columns", "a number of columns").WholeNumber("a number of columns");
  board.rows = table.Require("rows", "a number of rows").WholeNumber("a number of rows");
  if (board.type == BoardType::kAprilGrid) {
    ReadAprilGrid(table, board);
  } else {
    board.square_size_m = table.Require("square_size_m", "the side of a square, m").NumberAbove(0, "m");
  }
  if (board.type == BoardType::kCharuco) ReadCharuco(table, board);
  if (const auto first_id = table.Find("first_id")) board.first_id = ReadFirstId(*first_id);
  try {
    BoardCorners(board);
  } catch (const std::invalid_argument& error) {
    throw table.Error(std::string(error.what()) + "; correct the board");
  }
  return board;
}

}  // namespace luxfit
