// Finds which board a photo shows that does not show the expected one: other counts, another dictionary or family, another
// kind.
//
// Counts of markers and tags follow from the ids that lie where a grid of so many columns has them. The highest of these
// ids gives the rows, so a board that reaches out of the photo may have more. Counts of a chessboard are those of the
// largest grid of corners. Sizes cannot be seen: they are the expected board's; of another kind, they follow from its
// first size as `luxfit board` prints that kind.
#ifndef LUXFIT_CALIB_TARGETS_BOARD_SEARCH_H_
#define LUXFIT_CALIB_TARGETS_BOARD_SEARCH_H_

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "calib/targets/board.h"

namespace luxfit {

// Proportions of boards as `luxfit board` prints them.
constexpr double kPrintedMarkerShare = 0.7;  // side of a charuco's marker, in squares
constexpr double kPrintedTagGap = 0.3;       // gap between an aprilgrid's tags, in tag sizes

// Returns the board that the photo shows, the expected one included; nothing where it shows none. Throws
// std::invalid_argument as BoardCorners does.
std::optional<Board> SearchBoard(const ImagePlane& grey, const Board& expected);

// Returns the larger ones of OpenCV's dictionaries that begin with the markers of this one: photos of these markers do not
// tell which of them drew the board.
std::vector<std::string> DictionariesAlike(const std::string& dictionary);

struct ShownBoard {
  Board board;
  std::size_t photos = 0;  // of it
};

// Returns the board that most photos show. Markers and tags seen in part have fewer rows: boards that differ in rows alone
// are one, of the most rows. Returns nothing where no photo shows a board.
std::optional<ShownBoard> MostShown(const std::vector<std::optional<Board>>& found);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_TARGETS_BOARD_SEARCH_H_
