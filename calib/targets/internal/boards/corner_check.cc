#include "calib/targets/internal/boards/corner_check.h"

#include <algorithm>
#include <cmath>

#include "calib/lens/camera.h"
#include "calib/luminance/median.h"
#include "calib/targets/internal/boards/homography.h"
#include "calib/targets/internal/boards/plane_lens.h"

namespace luxfit {
namespace {

constexpr std::size_t kNeighbours = 10;
constexpr double kLeastStrayPx = 0.3, kMedians = 6;

struct Placed {
  Eigen::Vector2d place_m;
  int tag = 0;  // same for the corners of one tag
};

// Returns the places of the corners, by corner number.
std::vector<Placed> PlacesOf(const Board& board) {
  const Eigen::Array2i counts = BoardCornerCounts(board);
  std::vector<Placed> places;
  int number = 0;
  for (const Eigen::Vector3d& corner : BoardCorners(board)) {
    const int column = number % counts.x(), row = number / counts.x();
    const bool has_tags = board.type == BoardType::kAprilGrid;
    places.push_back({corner.head<2>(), has_tags ? (row / 2) * counts.x() + column / 2 : number});
    ++number;
  }
  return places;
}

// Returns the distance of a corner from where its neighbours predict it; 0 where there are too few of them.
double StrayPx(const std::vector<Placed>& places, const std::vector<BoardCorner>& corners, std::size_t i) {
  const Placed& own = places[static_cast<std::size_t>(corners[i].index)];
  std::vector<std::pair<double, std::size_t>> others;
  for (std::size_t j = 0; j < corners.size(); ++j) {
    const Placed& other = places[static_cast<std::size_t>(corners[j].index)];
    if (other.tag != own.tag) others.emplace_back((other.place_m - own.place_m).squaredNorm(), j);
  }
  const std::size_t count = std::min(kNeighbours, others.size());
  if (count < 6) return 0;
  std::partial_sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(count), others.end());
  std::vector<Eigen::Vector2d> from, to;
  for (std::size_t k = 0; k < count; ++k) {
    const BoardCorner& other = corners[others[k].second];
    from.push_back(places[static_cast<std::size_t>(other.index)].place_m);
    to.push_back(other.pixel);
  }
  const auto homography = FitHomography(from, to);
  const double stray_px = homography ? (MapPoint(*homography, own.place_m) - corners[i].pixel).norm() : 0;
  return std::isfinite(stray_px) ? stray_px : 0;
}

// Returns the corners as a lens without distortion would show them.
std::vector<BoardCorner> WithoutLens(const std::vector<Placed>& places, int width_px, int height_px,
                                     std::vector<BoardCorner> corners) {
  std::vector<Eigen::Vector2d> places_m, pixels;
  for (const BoardCorner& corner : corners) {
    places_m.push_back(places[static_cast<std::size_t>(corner.index)].place_m);
    pixels.push_back(corner.pixel);
  }
  const Camera lens = LensOfPlane(width_px, height_px, places_m, pixels);
  for (BoardCorner& corner : corners) corner.pixel = Straightened(lens, corner.pixel);
  return corners;
}

}  // namespace

std::vector<BoardCorner> WithoutStrayCorners(const Board& board, int width_px, int height_px,
                                             std::vector<BoardCorner> corners) {
  const std::vector<Placed> places = PlacesOf(board);
  std::vector<BoardCorner> straight = WithoutLens(places, width_px, height_px, corners);
  const std::size_t least = corners.size() / 2;
  while (corners.size() > least) {
    std::vector<double> strays_px(straight.size());
    for (std::size_t i = 0; i < straight.size(); ++i) strays_px[i] = StrayPx(places, straight, i);
    const auto worst = std::max_element(strays_px.begin(), strays_px.end());
    if (!(*worst > kLeastStrayPx + kMedians * Median(strays_px))) break;
    corners.erase(corners.begin() + (worst - strays_px.begin()));
    straight.erase(straight.begin() + (worst - strays_px.begin()));
  }
  return corners;
}

}  // namespace luxfit
