#include "apps/stages/calibrate/shown_board.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "apps/stages/calibrate/board_text.h"
#include "apps/text/input_error.h"
#include "apps/text/suggest.h"
#include "calib/photo_files/image.h"
#include "calib/targets/board_search.h"

namespace luxfit {
namespace {

constexpr std::size_t kMostSearched = 12;  // a second each at most

// Returns the names of images that show less than half of the board.
std::vector<std::string> ImagesWithoutBoard(const CalibrationInput& input) {
  std::vector<std::string> without;
  for (const CalibrationImage& image : input.images) {
    if (2 * image.corners.size() < input.target.points.size()) without.push_back(image.name);
  }
  return without;
}

// Returns that many of the images, evenly spread over all.
std::vector<std::string> SomeOf(const std::vector<std::string>& images) {
  std::vector<std::string> some;
  const std::size_t count = std::min(images.size(), kMostSearched);
  for (std::size_t i = 0; i < count; ++i) some.push_back(images[i * images.size() / count]);
  return some;
}

std::vector<std::optional<Board>> BoardsOf(const std::vector<std::string>& images, const Board& expected,
                                           const Eigen::Vector3d& weights) {
  std::vector<std::optional<Board>> found(images.size());
  tbb::parallel_for(std::size_t{0}, images.size(), [&](std::size_t i) {
    found[i] = SearchBoard(GreyOf(ReadPhoto(images[i]), weights), expected);
  });
  return found;
}

// Names the dictionary, and the larger ones that begin with its markers: the one that drew the board is among them.
std::string DictionaryInWords(const std::string& dictionary) {
  const std::vector<std::string> alike = DictionariesAlike(dictionary);
  if (alike.empty()) return dictionary;
  return fmt::format("{} ({} may have drawn it too)", dictionary, ListNames(alike));
}

std::string InWords(const Board& board) {
  switch (board.type) {
    case BoardType::kChessboard:
      return fmt::format("a chessboard of {}x{} inner corners", board.columns, board.rows);
    case BoardType::kCharuco:
      return fmt::format("a ChArUco board of {}x{} squares with markers of {}", board.columns, board.rows,
                         DictionaryInWords(board.dictionary));
    case BoardType::kAprilGrid:
      break;
  }
  return fmt::format("an AprilGrid of {}x{} tags of {}", board.columns, board.rows, board.family);
}

}  // namespace

void ExpectBoardShown(const Session& session, const CalibrationGroup& group) {
  const int first = group.cameras.front();
  const SessionCamera& camera = session.cameras[static_cast<std::size_t>(first)];
  if (!camera.board || !camera.calibration_corners.empty()) return;
  const std::vector<std::string> without = ImagesWithoutBoard(group.input);
  if (2 * without.size() <= group.input.images.size()) return;
  const std::vector<std::string> searched = SomeOf(without);
  const auto shown = MostShown(BoardsOf(searched, *camera.board, camera.luminance_weights));
  if (!shown || 2 * shown->photos <= searched.size()) return;
  const std::string argument = BoardArgument(shown->board), expected = BoardArgument(*camera.board);
  if (argument == expected) return;
  const std::string got =
      fmt::format("expected photos of {}, got {} in {} of {} photos that were looked at; ", expected,
                  InWords(shown->board), shown->photos, searched.size());
  if (session.path.empty()) throw InputError({"--board", 0}, "", got + "write --board " + argument);
  throw InputError({session.path, camera.line}, fmt::format("camera[{}].board", first),
                   got + "write " + BoardLine(shown->board));
}

}  // namespace luxfit
