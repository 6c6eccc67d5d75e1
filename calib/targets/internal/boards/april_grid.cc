#include "calib/targets/internal/boards/april_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "calib/luminance/median.h"
#include "calib/targets/internal/boards/aruco_dictionary.h"
#include "calib/targets/internal/boards/grid_corners.h"
#include "calib/targets/internal/boards/homography.h"
#include "calib/targets/internal/boards/plane_lens.h"
#include "calib/targets/internal/tags/find_tags.h"
#include "calib/targets/internal/tags/tag_family.h"
#include "calib/targets/internal/tags/tag_grid.h"
#include "calib/targets/tags.h"

namespace luxfit {
namespace {

// Longer sides of the photo in which tags are searched for. The second is used only where the first shows
// less than half of the board.
constexpr std::array<int, 2> kLongestPx = {1600, 3200};
constexpr double kMostSpacingError = 0.04;  // tag sizes
constexpr std::size_t kLeastGaps = 4;       // least count for a measured spacing
constexpr double kLeastAgreeing = 0.6;      // share of the tags found
// Bound a grid that is searched for: fewer tags may agree by chance, nobody prints more columns.
constexpr std::size_t kLeastTags = 4;
constexpr int kMostColumns = 20;

// Returns OpenCV's dictionary of a family; empty where OpenCV has none.
cv::Ptr<cv::aruco::Dictionary> DictionaryOf(const std::string& family) {
  if (family == "tag36h11") return PredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11);
  if (family == "tag36h10") return PredefinedDictionary(cv::aruco::DICT_APRILTAG_36h10);
  if (family == "tag25h9") return PredefinedDictionary(cv::aruco::DICT_APRILTAG_25h9);
  if (family == "tag16h5") return PredefinedDictionary(cv::aruco::DICT_APRILTAG_16h5);
  return {};
}

// Describes how ids and tags are placed on a printed grid: the first id at any corner, rows first, tags
// turned by any number of quarters.
struct Numbering {
  bool is_from_bottom = true, is_from_left = true;
  std::size_t turn = 0;  // corner of its square on the board at which the tag's own top-left lies
};

TagGrid Layout(const Board& board, const Numbering& numbering) {
  const std::vector<Eigen::Vector3d> corners = BoardCorners(board);
  const int tags = board.rows * board.columns;
  TagGrid grid;
  grid.reserve(static_cast<std::size_t>(tags));
  for (int i = 0; i < tags; ++i) {
    const int along = i % board.columns, up = i / board.columns, across = 2 * board.columns;
    const int row = numbering.is_from_bottom ? board.rows - 1 - up : up;
    const int column = numbering.is_from_left ? along : board.columns - 1 - along;
    const int first = 2 * row * across + 2 * column;
    const std::array<int, 4> square = {first, first + 1, first + across + 1, first + across};
    GridTag tag;
    for (std::size_t k = 0; k < 4; ++k) {
      tag.corner_index[k] = square[(k + numbering.turn) % 4];
      tag.corners_m[k] = corners[static_cast<std::size_t>(tag.corner_index[k])].head<2>();
    }
    grid.push_back(tag);
  }
  return grid;
}

struct SeenGrid {
  TagGrid grid;
  std::vector<SeenTag> tags;
  int border_bits = 1;
  std::size_t found = 0;  // tags with ids of the board, at any place
};

std::vector<SeenTag> TagsOfBoard(const std::vector<FoundTag>& found, const Board& board) {
  std::vector<SeenTag> tags;
  for (const FoundTag& tag : found) {
    const int number = tag.id - board.first_id;
    if (number >= 0 && number < board.rows * board.columns) tags.push_back({number, tag.corners_px});
  }
  return tags;
}

// Returns the numbering in which most tags agree; Kalibr's where no other does better.
SeenGrid BestLayout(const std::vector<SeenTag>& found, const Board& board) {
  SeenGrid best;
  const std::vector<TagFrame> frames = FramesOf(found);
  for (std::size_t turn = 0; turn < 4; ++turn) {
    for (const bool is_from_left : {true, false}) {
      for (const bool is_from_bottom : {true, false}) {
        const TagGrid grid = Layout(board, {is_from_bottom, is_from_left, turn});
        std::vector<SeenTag> agreeing = AgreeingTags(grid, found, frames);
        if (agreeing.size() > best.tags.size()) best = {grid, std::move(agreeing), 1, found.size()};
      }
    }
  }
  return best;
}

std::vector<FoundTag> FindByDetector(const ImagePlane& grey, const std::string& family) {
  DetectTagsOptions options;
  options.family = family;
  std::vector<FoundTag> found;
  for (const TagDetection& tag : DetectTags(grey, options)) found.push_back({tag.id, tag.corners_px});
  return found;
}

std::vector<FoundTag> FindTurned(const ReducedPhoto& photo, const cv::Ptr<cv::aruco::Dictionary>& dictionary,
                                 int border_bits) {
  std::vector<FoundTag> found = FindTags(photo, dictionary, border_bits);
  // OpenCV draws AprilTags turned by 180 degrees.
  for (FoundTag& tag : found)
    std::rotate(tag.corners_px.begin(), tag.corners_px.begin() + 2, tag.corners_px.end());
  return found;
}

SeenGrid FindGrid(const ImagePlane& grey, const Board& board) {
  const cv::Ptr<cv::aruco::Dictionary> dictionary = DictionaryOf(board.family);
  if (!dictionary) return BestLayout(TagsOfBoard(FindByDetector(grey, board.family), board), board);
  SeenGrid best;
  for (const int longest_px : kLongestPx) {
    const ReducedPhoto photo = ReducePhoto(grey, longest_px);
    for (const int border_bits : {1, 2}) {
      if (!best.tags.empty() && best.border_bits != border_bits) continue;
      SeenGrid seen = BestLayout(TagsOfBoard(FindTurned(photo, dictionary, border_bits), board), board);
      seen.border_bits = border_bits;
      if (seen.tags.size() > best.tags.size()) best = std::move(seen);
    }
    if (2 * best.tags.size() >= best.grid.size() && !best.grid.empty()) break;
    if (photo.scale == 1) break;
  }
  return best;
}

// Returns the gap between black squares as the photo shows it, in tag sizes; NaN where too few neighbours are
// seen.
double MeasuredSpacing(const SeenGrid& seen, const Board& board) {
  std::vector<double> gaps;
  const double pitch_m = board.tag_size_m * (1 + board.spacing);
  for (const SeenTag& a : seen.tags) {
    const auto tag_from_pixel =
        FitHomography({a.corners_px.begin(), a.corners_px.end()}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    if (!tag_from_pixel) continue;
    for (const SeenTag& b : seen.tags) {
      const auto& at = seen.grid[static_cast<std::size_t>(a.number)].corners_m;
      const auto& bt = seen.grid[static_cast<std::size_t>(b.number)].corners_m;
      if (std::abs((at[0] - bt[0]).norm() - pitch_m) > 0.1 * pitch_m) continue;
      Eigen::Vector2d away = Eigen::Vector2d::Zero();
      for (std::size_t k = 0; k < 4; ++k) away += MapPoint(*tag_from_pixel, b.corners_px[k]) / 4;
      gaps.push_back((away - Eigen::Vector2d(0.5, 0.5)).norm() - 1);
    }
  }
  if (gaps.size() < kLeastGaps) return std::numeric_limits<double>::quiet_NaN();
  return Quantile(std::move(gaps), 0.5);
}

std::string WhyNotThisBoard(const SeenGrid& seen, const Board& board) {
  const std::string grid = std::to_string(board.columns) + " x " + std::to_string(board.rows);
  if (seen.tags.empty())
    return "no tag of the board was found (" + board.family + ", ids " + std::to_string(board.first_id) +
           " to " + std::to_string(board.first_id + board.columns * board.rows - 1) + ")";
  if (seen.found >= kLeastTags &&
      static_cast<double>(seen.tags.size()) < kLeastAgreeing * static_cast<double>(seen.found))
    return std::to_string(seen.found) + " tags were found, but only " + std::to_string(seen.tags.size()) +
           " where a grid of " + grid + " has them; check columns, rows and first_id";
  return "";
}

// Says why the photo contradicts the board's spacing; empty where it does not. Distortion makes large tags
// look further apart, or nearer, than they are, so it is removed first.
std::string WhyNotThisSpacing(const ImagePlane& grey, const SeenGrid& seen, const Board& board) {
  std::vector<Eigen::Vector2d> places_m, pixels;
  for (const SeenTag& tag : seen.tags) {
    const GridTag& on_board = seen.grid[static_cast<std::size_t>(tag.number)];
    places_m.insert(places_m.end(), on_board.corners_m.begin(), on_board.corners_m.end());
    pixels.insert(pixels.end(), tag.corners_px.begin(), tag.corners_px.end());
  }
  const Camera lens =
      LensOfPlane(static_cast<int>(grey.cols()), static_cast<int>(grey.rows()), places_m, pixels);
  SeenGrid straight = seen;
  for (SeenTag& tag : straight.tags) {
    for (Eigen::Vector2d& corner : tag.corners_px) corner = Straightened(lens, corner);
  }
  const double spacing = MeasuredSpacing(straight, board);
  if (std::abs(spacing - board.spacing) > kMostSpacingError)
    return fmt::format("the gaps between tags measure {:.3g} tag sizes, the board says {:.3g}; check spacing",
                       spacing, board.spacing);
  return "";
}

std::vector<TagCells> AllCells(const Board& board, int border_bits) {
  const TagFamilyPtr family = MakeTagFamily(board.family);
  const int tags = board.rows * board.columns;
  std::vector<TagCells> cells;
  cells.reserve(static_cast<std::size_t>(tags));
  for (int i = 0; i < tags; ++i) cells.push_back(CellsOf(*family, board.first_id + i, border_bits));
  return cells;
}

std::string MissingTags(const SeenGrid& seen, const Board& board) {
  std::vector<bool> is_seen(seen.grid.size(), false);
  for (const SeenTag& tag : seen.tags) is_seen[static_cast<std::size_t>(tag.number)] = true;
  std::string ids;
  for (std::size_t i = 0; i < is_seen.size(); ++i) {
    if (!is_seen[i]) ids += (ids.empty() ? "" : ", ") + std::to_string(board.first_id + static_cast<int>(i));
  }
  if (ids.empty()) return "";
  return std::to_string(seen.tags.size()) + " of " + std::to_string(seen.grid.size()) +
         " tags were found; hidden, outside the photo or too small: " + ids;
}

struct SearchedGrid {
  Board board;
  std::size_t agreeing = 0;  // tags
};

void KeepBetter(SearchedGrid other, SearchedGrid& best) {
  if (other.agreeing > best.agreeing) best = std::move(other);
}

// Returns the grid of the number of columns in which most of the tags agree, with as many rows as these tags need. Too few
// tags, or tags of which too few agree, give none.
SearchedGrid SearchColumns(const std::vector<FoundTag>& found, Board board) {
  SearchedGrid best;
  const int known = static_cast<int>(MakeTagFamily(board.family)->ncodes) - board.first_id;
  int highest = -1;
  for (const FoundTag& tag : found) highest = std::max(highest, tag.id - board.first_id);
  for (board.columns = 1; board.columns <= kMostColumns; ++board.columns) {
    board.rows = highest / board.columns + 1;
    if (highest < 0 || board.rows * board.columns > known) continue;
    const SeenGrid seen = BestLayout(TagsOfBoard(found, board), board);
    if (seen.tags.size() < kLeastTags ||
        static_cast<double>(seen.tags.size()) < kLeastAgreeing * static_cast<double>(found.size()))
      continue;
    KeepBetter({board, seen.tags.size()}, best);
  }
  return best;
}

std::vector<SeenTag> Measured(const GridCornerMeasurer& measurer, const std::vector<SeenTag>& tags) {
  std::vector<SeenTag> measured;
  for (const SeenTag& tag : tags) {
    if (const auto its = measurer.Measure(tag)) measured.push_back(*its);
  }
  return measured;
}

}  // namespace

BoardDetection DetectAprilGrid(const ImagePlane& grey, const Board& board) {
  BoardDetection detection;
  SeenGrid seen = FindGrid(grey, board);
  detection.message = WhyNotThisBoard(seen, board);
  if (!detection.message.empty()) return detection;
  const GridCornerMeasurer first(grey, board, seen.border_bits);
  seen.tags = Measured(first, seen.tags);
  detection.message = seen.tags.empty()
                          ? "tags were found, but their corners are too small or blurred to be measured"
                          : WhyNotThisSpacing(grey, seen, board);
  if (!detection.message.empty()) return detection;
  const GridCornerMeasurer tuned = first.Tuned(seen.grid, seen.tags);
  seen.tags = Measured(tuned, seen.tags);
  const auto measure = [&](const SeenTag& tag) { return tuned.Measure(tag); };
  seen.tags =
      WithPredictedTags(grey, seen.grid, AllCells(board, seen.border_bits), std::move(seen.tags), measure);
  for (const SeenTag& tag : seen.tags) {
    const GridTag& on_board = seen.grid[static_cast<std::size_t>(tag.number)];
    for (std::size_t k = 0; k < 4; ++k) {
      if (tag.sigma_px[k] > 0)
        detection.corners.push_back({on_board.corner_index[k], tag.corners_px[k], tag.sigma_px[k]});
    }
  }
  std::sort(detection.corners.begin(), detection.corners.end(),
            [](const BoardCorner& a, const BoardCorner& b) { return a.index < b.index; });
  detection.message = MissingTags(seen, board);
  return detection;
}

std::optional<Board> SearchAprilGrid(const ImagePlane& grey, const Board& expected) {
  const ReducedPhoto photo = ReducePhoto(grey, kLongestPx.front());
  SearchedGrid best;
  for (const char* family : {"tag36h11", "tag36h10", "tag25h9", "tag16h5"}) {
    const cv::Ptr<cv::aruco::Dictionary> dictionary = DictionaryOf(family);
    Board board = expected;
    board.family = family;
    for (const int border_bits : {1, 2})
      KeepBetter(SearchColumns(FindTurned(photo, dictionary, border_bits), board), best);
  }
  if (best.agreeing == 0) return {};
  return best.board;
}

}  // namespace luxfit
