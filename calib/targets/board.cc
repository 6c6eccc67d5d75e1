#include "calib/targets/board.h"

#include <cmath>
#include <stdexcept>

#include "calib/targets/internal/boards/aruco_dictionary.h"
#include "calib/targets/internal/tags/tag_family.h"

namespace luxfit {
namespace {

constexpr int kLeastCorners = 3;  // a row and column of fewer give no usable homography
constexpr int kMostTags = 10000;

std::invalid_argument BadMember(const std::string& member, const std::string& expected, double got) {
  std::string shown = std::to_string(got);
  shown.erase(shown.find_last_not_of('0') + 1);
  if (shown.back() == '.') shown.pop_back();
  return std::invalid_argument(member + ": expected " + expected + ", got " + shown);
}

void ExpectCount(const std::string& member, int count, int least, const std::string& of) {
  if (count < least || count > kMostTags)
    throw BadMember(member, "at least " + std::to_string(least) + " " + of, count);
}

void ExpectSize(const std::string& member, double size, const std::string& expected) {
  if (!(size > 0) || !std::isfinite(size)) throw BadMember(member, expected, size);
}

// `remedy` follows the counts where the board has too many tags.
void ExpectIds(const Board& board, int tags, int known, const std::string& of,
               const std::string& remedy = "") {
  if (board.first_id >= 0 && board.first_id <= known - tags) return;
  const std::string counts =
      "the board has " + std::to_string(tags) + " tags, " + of + " " + std::to_string(known);
  if (tags > known) throw std::invalid_argument("columns, rows: expected fewer tags: " + counts + remedy);
  throw BadMember("first_id", "0 to " + std::to_string(known - tags) + " (" + counts + ")", board.first_id);
}

void CheckAprilGrid(const Board& board) {
  ExpectCount("columns", board.columns, 1, "tag");
  ExpectCount("rows", board.rows, 1, "tag");
  ExpectSize("tag_size_m", board.tag_size_m, "the side of a tag's black square, m");
  ExpectSize("spacing", board.spacing, "the gap between black squares, in tag sizes");
  const TagFamilyPtr family = MakeTagFamily(board.family);
  ExpectIds(board, board.columns * board.rows, static_cast<int>(family->ncodes), board.family);
}

void CheckChessboard(const Board& board) {
  ExpectCount("columns", board.columns, kLeastCorners, "inner corners");
  ExpectCount("rows", board.rows, kLeastCorners, "inner corners");
  ExpectSize("square_size_m", board.square_size_m, "the side of a square, m");
}

void CheckCharuco(const Board& board) {
  ExpectCount("columns", board.columns, kLeastCorners, "squares");
  ExpectCount("rows", board.rows, kLeastCorners, "squares");
  ExpectSize("square_size_m", board.square_size_m, "the side of a square, m");
  ExpectSize("tag_size_m", board.tag_size_m, "the side of a marker, m");
  if (board.tag_size_m >= board.square_size_m)
    throw BadMember("tag_size_m", "a marker smaller than its square", board.tag_size_m);
  const cv::Ptr<cv::aruco::Dictionary> dictionary = ArucoDictionary(board.dictionary);
  // Every second square holds a marker. Which half does depends on OpenCV's version, by one marker.
  const int tags = (board.columns * board.rows + 1) / 2;
  const std::string larger = SmallestArucoDictionary(board.dictionary, tags - 1);
  ExpectIds(board, tags, dictionary->bytesList.rows, board.dictionary,
            larger == board.dictionary ? "" : "; " + larger + " has enough");
}

void CheckBoard(const Board& board) {
  switch (board.type) {
    case BoardType::kAprilGrid:
      return CheckAprilGrid(board);
    case BoardType::kChessboard:
      return CheckChessboard(board);
    case BoardType::kCharuco:
      return CheckCharuco(board);
  }
  throw std::invalid_argument("type: expected a type of board");
}

// Returns the distance of a corner from the first one, along a row or a column.
double CornerOffset(const Board& board, int corner) {
  if (board.type != BoardType::kAprilGrid) return corner * board.square_size_m;
  const int tag = corner / 2;
  return board.tag_size_m * (tag * (1 + board.spacing) + corner % 2);
}

}  // namespace

Eigen::Array2i BoardCornerCounts(const Board& board) {
  CheckBoard(board);
  switch (board.type) {
    case BoardType::kAprilGrid:
      return {2 * board.columns, 2 * board.rows};
    case BoardType::kCharuco:
      return {board.columns - 1, board.rows - 1};
    case BoardType::kChessboard:
      break;
  }
  return {board.columns, board.rows};
}

std::vector<Eigen::Vector3d> BoardCorners(const Board& board) {
  const Eigen::Array2i counts = BoardCornerCounts(board);
  std::vector<Eigen::Vector3d> corners;
  corners.reserve(static_cast<std::size_t>(counts.prod()));
  for (int row = 0; row < counts.y(); ++row) {
    for (int column = 0; column < counts.x(); ++column)
      corners.emplace_back(CornerOffset(board, column), CornerOffset(board, row), 0);
  }
  return corners;
}

}  // namespace luxfit
