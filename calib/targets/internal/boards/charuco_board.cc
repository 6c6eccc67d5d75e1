#include "calib/targets/internal/boards/charuco_board.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "calib/targets/internal/boards/aruco_dictionary.h"
#include "calib/targets/internal/boards/checker_corner.h"
#include "calib/targets/internal/boards/homography.h"
#include "calib/targets/internal/tags/find_tags.h"
#include "calib/targets/internal/tags/tag_grid.h"

namespace luxfit {
namespace {

// Longer sides of the photo in which markers are searched for. The second is used only where the first shows
// less than half of them.
constexpr std::array<int, 2> kCharucoLongestPx = {1600, 3200};
constexpr std::size_t kNearPoints = 12;
constexpr double kReachSquares = 2.5;
// Bound a board that is searched for: fewer markers may agree by chance, nobody prints more columns.
constexpr std::size_t kLeastMarkers = 4;
constexpr double kLeastAgreeingMarkers = 0.6;  // share of the markers found
constexpr int kLeastSquares = 3, kMostSquares = 30;

// Holds the squares that carry markers: those whose column + row is odd (the top-left square is black, as
// everywhere since OpenCV 4.7) or even (OpenCV 4.6 where the number of rows is even).
struct CharucoLayout {
  TagGrid markers;
  std::vector<Eigen::Vector2i> squares;  // by marker: column, row
  int parity = 1;
};

CharucoLayout LayoutOf(const Board& board, int parity) {
  CharucoLayout layout;
  layout.parity = parity;
  const double square_m = board.square_size_m, margin_m = (square_m - board.tag_size_m) / 2;
  for (int row = 0; row < board.rows; ++row) {
    for (int column = 0; column < board.columns; ++column) {
      if ((column + row) % 2 != parity) continue;
      const Eigen::Vector2d a((column - 1) * square_m + margin_m, (row - 1) * square_m + margin_m);
      const double size_m = board.tag_size_m;
      GridTag marker;
      marker.corners_m = {a, a + Eigen::Vector2d(size_m, 0), a + Eigen::Vector2d(size_m, size_m),
                          a + Eigen::Vector2d(0, size_m)};
      layout.markers.push_back(marker);
      layout.squares.emplace_back(column, row);
    }
  }
  return layout;
}

struct SeenCharuco {
  CharucoLayout layout;
  std::vector<SeenTag> markers;
};

// Returns those of the markers found that lie where the board has them, by the parity for which these are more.
SeenCharuco AgreeingMarkers(const std::vector<FoundTag>& found, const Board& board) {
  SeenCharuco best;
  for (const int parity : {1, 0}) {
    SeenCharuco seen{LayoutOf(board, parity), {}};
    std::vector<SeenTag> of_board;
    for (const FoundTag& tag : found) {
      const int number = tag.id - board.first_id;
      if (number >= 0 && number < static_cast<int>(seen.layout.markers.size()))
        of_board.push_back({number, tag.corners_px});
    }
    seen.markers = AgreeingTags(seen.layout.markers, of_board, FramesOf(of_board));
    if (seen.markers.size() > best.markers.size()) best = std::move(seen);
  }
  return best;
}

SeenCharuco FindMarkers(const ImagePlane& grey, const Board& board) {
  const auto dictionary = ArucoDictionary(board.dictionary);
  SeenCharuco best;
  for (const int longest_px : kCharucoLongestPx) {
    const ReducedPhoto photo = ReducePhoto(grey, longest_px);
    SeenCharuco seen = AgreeingMarkers(FindTags(photo, dictionary, 1), board);
    if (seen.markers.size() > best.markers.size()) best = std::move(seen);
    if (photo.scale == 1 || (!best.markers.empty() && 2 * best.markers.size() >= best.layout.markers.size()))
      break;
  }
  return best;
}

// Holds all that is known so far about the board's place in the photo: corners of found markers, and measured
// inner corners.
class CharucoTracer {
 public:
  CharucoTracer(const ImagePlane& grey, const Board& board, const SeenCharuco& seen)
      : grey_(grey),
        board_(board),
        layout_(seen.layout),
        dictionary_(ArucoDictionary(board.dictionary)),
        is_marker_seen_(seen.layout.markers.size(), false) {
    for (const SeenTag& marker : seen.markers) {
      const GridTag& tag = layout_.markers[static_cast<std::size_t>(marker.number)];
      places_m_.insert(places_m_.end(), tag.corners_m.begin(), tag.corners_m.end());
      pixels_.insert(pixels_.end(), marker.corners_px.begin(), marker.corners_px.end());
      is_marker_seen_[static_cast<std::size_t>(marker.number)] = true;
    }
  }

  // Measures corners beside seen markers, and searches for markers beside measured corners, until neither
  // adds any.
  const std::map<int, Saddle>& Trace() {
    while (MeasureCorners() && LookForMarkers()) {
    }
    return corners_;
  }

 private:
  std::optional<Eigen::Matrix3d> PixelFromBoardNear(const Eigen::Vector2d& place_m) const {
    std::vector<std::size_t> order(places_m_.size());
    std::iota(order.begin(), order.end(), 0);
    const auto distance = [&](std::size_t i) { return (places_m_[i] - place_m).squaredNorm(); };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
    std::vector<Eigen::Vector2d> from, to;
    for (std::size_t k = 0; k < std::min(kNearPoints, order.size()); ++k) {
      if (distance(order[k]) > std::pow(kReachSquares * board_.square_size_m, 2)) break;
      from.push_back(places_m_[order[k]]);
      to.push_back(pixels_[order[k]]);
    }
    return FitHomography(from, to);
  }

  void MeasureCorner(int column, int row) {
    const int across = board_.columns - 1, index = row * across + column;
    if (column < 0 || row < 0 || column >= across || row >= board_.rows - 1) return;
    if (corners_.count(index) > 0) return;
    CheckerCorner corner;
    corner.place_m = board_.square_size_m * Eigen::Vector2d(column, row);
    corner.is_top_left_black = (column + row) % 2 != layout_.parity;
    corner.clear_m = (board_.square_size_m - board_.tag_size_m) / 2;
    const auto homography = PixelFromBoardNear(corner.place_m);
    if (!homography) return;
    const auto saddle = MeasureCheckerCorner(grey_, *homography, corner);
    if (!saddle) return;
    corners_.emplace(index, *saddle);
    places_m_.push_back(corner.place_m);
    pixels_.push_back(saddle->pixel);
  }

  // Returns whether any new one was found.
  bool MeasureCorners() {
    const std::size_t before = corners_.size();
    for (std::size_t i = 0; i < is_marker_seen_.size(); ++i) {
      if (!is_marker_seen_[i]) continue;
      const Eigen::Vector2i square = layout_.squares[i];
      for (const int down : {-1, 0}) {
        for (const int right : {-1, 0}) MeasureCorner(square.x() + right, square.y() + down);
      }
    }
    return corners_.size() > before;
  }

  bool LookForMarkers() {
    bool found = false;
    for (std::size_t i = 0; i < is_marker_seen_.size(); ++i) {
      if (is_marker_seen_[i]) continue;
      const std::array<Eigen::Vector2d, 4>& corners_m = layout_.markers[i].corners_m;
      const auto homography = PixelFromBoardNear((corners_m[0] + corners_m[2]) / 2);
      if (!homography) continue;
      std::array<Eigen::Vector2d, 4> corners_px;
      for (std::size_t k = 0; k < 4; ++k) corners_px[k] = MapPoint(*homography, corners_m[k]);
      const auto pixel_from_tag = UnitSquareTo(corners_px);
      const int id = board_.first_id + static_cast<int>(i);
      if (!pixel_from_tag || !ShowsTag(grey_, *pixel_from_tag, CellsOf(*dictionary_, id))) continue;
      is_marker_seen_[i] = true;
      found = true;
    }
    return found;
  }

  const ImagePlane& grey_;
  const Board& board_;
  const CharucoLayout& layout_;
  cv::Ptr<cv::aruco::Dictionary> dictionary_;
  std::vector<bool> is_marker_seen_;
  std::vector<Eigen::Vector2d> places_m_, pixels_;
  std::map<int, Saddle> corners_;
};

struct SearchedCharuco {
  Board board;
  std::size_t agreeing = 0;  // markers
};

// Returns the board of the number of columns for which most of the markers agree, with as many rows as these need. Too few
// markers, or markers of which too few agree, give none.
SearchedCharuco SearchMarkerColumns(const std::vector<FoundTag>& found, Board board) {
  SearchedCharuco best;
  if (found.size() < kLeastMarkers) return best;
  int highest = 0;
  for (const FoundTag& tag : found) highest = std::max(highest, tag.id - board.first_id);
  for (board.columns = kLeastSquares; board.columns <= kMostSquares; ++board.columns) {
    board.rows = 2 * (highest + 1) / (board.columns - 1) + 2;  // surely enough
    const SeenCharuco seen = AgreeingMarkers(found, board);
    if (seen.markers.size() <= best.agreeing || seen.markers.size() < kLeastMarkers ||
        static_cast<double>(seen.markers.size()) < kLeastAgreeingMarkers * static_cast<double>(found.size()))
      continue;
    best = {board, seen.markers.size()};
    best.board.rows = 0;
    for (const SeenTag& marker : seen.markers)
      best.board.rows =
          std::max(best.board.rows, seen.layout.squares[static_cast<std::size_t>(marker.number)].y() + 1);
  }
  return best;
}

}  // namespace

BoardDetection DetectCharuco(const ImagePlane& grey, const Board& board) {
  BoardDetection detection;
  const SeenCharuco seen = FindMarkers(grey, board);
  if (seen.markers.empty()) {
    detection.message = "no marker of the board was found (" + board.dictionary + ")";
    return detection;
  }
  CharucoTracer tracer(grey, board, seen);
  for (const auto& [index, saddle] : tracer.Trace())
    detection.corners.push_back({index, saddle.pixel, saddle.sigma_px});
  const int all = BoardCornerCounts(board).prod();
  if (static_cast<int>(detection.corners.size()) < all)
    detection.message = std::to_string(detection.corners.size()) + " of " + std::to_string(all) +
                        " corners were found; the others are hidden, outside the photo or too small";
  return detection;
}

std::optional<Board> SearchCharuco(const ImagePlane& grey, const Board& expected) {
  const ReducedPhoto photo = ReducePhoto(grey, kCharucoLongestPx.front());
  SearchedCharuco best;
  for (const std::string& dictionary : LargestArucoDictionaries()) {
    Board board = expected;
    board.dictionary = dictionary;
    const std::vector<FoundTag> found = FindTags(photo, ArucoDictionary(dictionary), 1);
    SearchedCharuco searched = SearchMarkerColumns(found, board);
    if (searched.agreeing > best.agreeing) best = std::move(searched);
  }
  if (best.agreeing == 0) return {};
  const int last_id = best.board.first_id + (best.board.columns * best.board.rows + 1) / 2 - 1;
  best.board.dictionary = SmallestArucoDictionary(best.board.dictionary, last_id);
  const bool has_all = ArucoDictionary(expected.dictionary)->bytesList.rows > last_id;
  if (has_all && SmallestArucoDictionary(expected.dictionary, last_id) == best.board.dictionary)
    best.board.dictionary = expected.dictionary;
  return best.board;
}

}  // namespace luxfit
