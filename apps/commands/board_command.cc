#include "apps/commands/board_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include "apps/print/board_sheets.h"
#include "apps/session/session_files.h"
#include "apps/stages/calibrate/board_text.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/suggest.h"
#include "calib/targets/board.h"
#include "calib/targets/board_search.h"

namespace luxfit {
namespace {

constexpr double kStepM = 0.0005;  // chosen sizes are multiples of this

BoardType TypeFrom(const std::string& name) {
  if (name == "aprilgrid") return BoardType::kAprilGrid;
  if (name == "chessboard") return BoardType::kChessboard;
  if (name == "charuco") return BoardType::kCharuco;
  throw std::runtime_error("TYPE: " + ExpectedOneOf({"aprilgrid", "chessboard", "charuco", "tags"}, name));
}

// Returns the name of the flag that sets a member of Board or BoardStyle, for messages that name the member.
std::string WithFlagNames(std::string message, const std::string& type) {
  if (type == "charuco" && message.rfind("tag_size_m", 0) == 0)
    return "--marker-size" + message.substr(std::string("tag_size_m").size());
  constexpr std::array<std::pair<const char*, const char*>, 10> kFlags = {
      {{"tag_size_m", "--tag-size"},
       {"square_size_m", "--square-size"},
       {"columns", "--columns"},
       {"rows", "--rows"},
       {"spacing", "--spacing"},
       {"first_id", "--first-id"},
       {"dictionary", "--dictionary"},
       {"tag family", "--family"},
       {"has_corner_squares", "--corner-squares"},
       {"tag id", "--ids"}}};
  for (const auto& [member, flag] : kFlags) {
    if (message.rfind(member, 0) == 0) return flag + message.substr(std::string(member).size());
  }
  return message;
}

double RoundedDown(double size_m) { return kStepM * std::floor(size_m / kStepM + 1e-6); }

Board BoardFrom(const BoardCommandOptions& options) {
  Board board;
  board.type = TypeFrom(options.type);
  constexpr std::array<std::array<int, 2>, 3> kDefaultCounts = {{{5, 7}, {9, 6}, {6, 9}}};
  const auto& counts = kDefaultCounts[static_cast<std::size_t>(board.type)];
  board.columns = options.columns > 0 ? options.columns : counts[0];
  board.rows = options.rows > 0 ? options.rows : counts[1];
  board.tag_size_m = options.tag_size_m;
  board.spacing = options.spacing;
  board.square_size_m = options.square_size_m;
  board.first_id = options.first_id;
  board.family = options.family;
  board.dictionary = options.dictionary;
  return board;
}

// Returns the one length from which all others follow.
void SetScale(double size_m, const BoardCommandOptions& options, Board& board) {
  (board.type == BoardType::kAprilGrid ? board.tag_size_m : board.square_size_m) = size_m;
  if (board.type != BoardType::kCharuco) return;
  board.tag_size_m =
      options.marker_size_m > 0 ? options.marker_size_m : RoundedDown(kPrintedMarkerShare * size_m);
}

// Returns the largest size with which `needed_mm` fits on the paper. `needed_mm` grows with the size.
double LargestSizeM(const Paper& paper, const std::function<Eigen::Vector2d(double)>& needed_mm) {
  double low = 0, high = RoundedDown(paper.size_mm.maxCoeff() * 1e-3);
  while (high - low > 1.5 * kStepM) {
    const double middle = RoundedDown((low + high) / 2);
    (Fitting(paper, needed_mm(middle)) ? low : high) = middle;
  }
  if (low <= 0)
    throw std::runtime_error("--paper: expected room for the board, got " + paper.name +
                             "; give a larger one");
  return low;
}

// Parses "0-11,20" into a list.
std::vector<int> IdsFrom(const std::string& text) {
  constexpr int kMostIds = 2000;
  std::vector<int> ids;
  const auto bad = [&] {
    return std::runtime_error("--ids: expected ids and ranges such as 0-11,20, got " + Quoted(text));
  };
  std::size_t at = 0;
  while (at <= text.size()) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string part = text.substr(at, end - at);
    int first = 0, last = 0;
    char rest = 0;
    const int read = std::sscanf(part.c_str(), "%d-%d%c", &first, &last, &rest);
    const bool is_single = !part.empty() && part.find_first_not_of("0123456789") == std::string::npos;
    if (is_single && read == 1) last = first;
    if (!(is_single ? read == 1 : read == 2) || first < 0 || last < first || last - first >= kMostIds)
      throw bad();
    for (int id = first; id <= last; ++id) ids.push_back(id);
    at = end + 1;
  }
  return ids;
}

void Write(const BoardCommandOptions& options, const std::vector<PrintPage>& pages,
           const std::string& title) {
  if (ExtensionOf(options.file) == ".pdf") return WriteText(options.file, PagesPdf(pages, title));
  if (pages.size() > 1)
    throw std::runtime_error(
        fmt::format("--out: expected a .pdf for {} pages, got {}; or give fewer ids or a larger --paper",
                    pages.size(), Quoted(options.file)));
  WriteText(options.file, PageSvg(pages.front()));
}

void WriteBoard(const BoardCommandOptions& options, const Paper& paper) {
  Board board = BoardFrom(options);
  const BoardStyle style{options.border_bits, options.has_corner_squares};
  double size_m = board.type == BoardType::kAprilGrid ? options.tag_size_m : options.square_size_m;
  if (size_m == 0) {
    size_m = LargestSizeM(paper, [&](double at_m) {
      Board trial = board;
      SetScale(at_m, options, trial);
      return SheetSizeMm(DrawBoard(trial, style));
    });
  }
  SetScale(size_m, options, board);
  const std::string line = BoardLine(board);
  Write(options, {BoardSheet(DrawBoard(board, style), paper, "luxfit " + line)}, line);
  fmt::print("{}\n", line);
}

void WriteTags(const BoardCommandOptions& options, const Paper& paper) {
  const std::vector<int> ids = IdsFrom(options.ids);
  double size_m = options.tag_size_m;
  if (size_m == 0) {
    constexpr double kFootAndLabelMm = 9;
    size_m = LargestSizeM(paper, [&](double at_m) {
      return Eigen::Vector2d(SheetSizeMm(DrawSingleTag(options.family, ids.front(), at_m)) +
                             Eigen::Vector2d(0, kFootAndLabelMm));
    });
  }
  const std::vector<PrintPage> pages = TagSheets(options.family, ids, size_m, paper);
  Write(options, pages, fmt::format("luxfit room tags {} {}", options.family, options.ids));
  fmt::print(
      "[tags]\nfamily = \"{}\"\nmap = \"tags.json\"   # for each tag: {{\"id\": {}, \"size_m\": {:g}, "
      "\"center_m\": [x, y, z], \"normal\": [out of the wall], \"up\": [along the arrow]}}\n",
      options.family, ids.front(), size_m);
}

}  // namespace

int BoardCommand(const BoardCommandOptions& options) {
  const std::string extension = ExtensionOf(options.file);
  if (extension != ".svg" && extension != ".pdf")
    throw std::runtime_error("--out: expected a file name ending in .svg or .pdf, got " +
                             Quoted(options.file));
  const Paper paper = PaperFrom(options.paper);
  try {
    options.type == "tags" ? WriteTags(options, paper) : WriteBoard(options, paper);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(WithFlagNames(error.what(), options.type));
  }
  return 0;
}

}  // namespace luxfit
