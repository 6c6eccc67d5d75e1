#include "calib/targets/internal/boards/grid_corners.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/luminance/internal/plane_sample.h"
#include "calib/targets/internal/boards/homography.h"
#include "calib/targets/internal/boards/plane_lens.h"
#include "calib/targets/internal/boards/saddle.h"
#include "calib/targets/internal/tags/tag_family.h"

namespace luxfit {
namespace {

constexpr double kDetectorSigmaPx = 1;
constexpr int kPixelsAtFirst = 600, kPixels = 1000;  // that a tag's fit uses: a board has many tags

constexpr std::array<std::array<double, 2>, 4> kSquare = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

// Returns a place in tag sizes: `along` from the corner into the tag, both ways.
Eigen::Vector2d FromCorner(std::size_t corner, double along_x, double along_y) {
  const double x = kSquare[corner][0], y = kSquare[corner][1];
  return {x + (x > 0 ? -along_x : along_x), y + (y > 0 ? -along_y : along_y)};
}

}  // namespace

GridCornerMeasurer::GridCornerMeasurer(const ImagePlane& grey, const Board& board, int border_bits)
    : grey_(grey),
      spacing_(board.spacing),
      first_id_(board.first_id),
      lens_(LensOfPlane(static_cast<int>(grey.cols()), static_cast<int>(grey.rows()), {}, {})) {
  const TagFamilyPtr family = MakeTagFamily(board.family);
  border_ = CellsOf(*family, board.first_id, border_bits).border;
  refine_.family = board.family;
  refine_.border_bits = border_bits;
  refine_.max_shift_cells = 1;  // the start comes from a reduced photo
  refine_.max_pixels = kPixelsAtFirst;
}

GridCornerMeasurer GridCornerMeasurer::Tuned(const TagGrid& grid, const std::vector<SeenTag>& tags) const {
  GridCornerMeasurer tuned = *this;
  std::vector<SeenTag> plain;
  std::vector<Eigen::Vector2d> places_m, pixels;
  for (const SeenTag& tag : tags) {
    const auto pixel_from_tag = UnitSquareTo(tag.corners_px);
    if (!pixel_from_tag) continue;
    const std::array<bool, 4> is_plain = PlainCorners(*pixel_from_tag);
    if (std::count(is_plain.begin(), is_plain.end(), true) == 4) plain.push_back(tag);
    for (std::size_t k = 0; k < 4; ++k) {
      if (!(tag.sigma_px[k] > 0)) continue;
      places_m.push_back(grid[static_cast<std::size_t>(tag.number)].corners_m[k]);
      pixels.push_back(tag.corners_px[k]);
    }
  }
  if (plain.empty()) return tuned;
  tuned.lens_ = LensOfPlane(lens_.width_px, lens_.height_px, places_m, pixels);
  tuned.exponent_ = tuned.BestExponent(plain);
  tuned.refine_.max_pixels = kPixels;
  return tuned;
}

// Returns nothing where the photo does not show the fields about the corner.
std::optional<bool> GridCornerMeasurer::IsSaddle(const Eigen::Matrix3d& pixel_from_tag,
                                                 std::size_t corner) const {
  const double gap = spacing_ / 2, in = border_ / 2;
  const auto at = [&](double x, double y) {
    return SampleBilinear(grey_, MapPoint(pixel_from_tag, FromCorner(corner, x, y)));
  };
  const double black = at(in, in), white = (at(-gap, in) + at(in, -gap)) / 2, across = at(-gap, -gap);
  if (!std::isfinite(black + white + across) || !(white > black)) return std::nullopt;
  return across < (black + white) / 2;
}

void GridCornerMeasurer::MeasureSaddle(const Eigen::Matrix3d& pixel_from_tag, std::size_t corner,
                                       SeenTag& tag) const {
  const Eigen::Vector2d place(kSquare[corner][0], kSquare[corner][1]);
  const auto saddle =
      RefineSaddle(grey_, tag.corners_px[corner], pixel_from_tag, place, std::min(border_, spacing_));
  if (!saddle) return;
  tag.corners_px[corner] = saddle->pixel;
  tag.sigma_px[corner] = saddle->sigma_px;
}

std::optional<TagDetection> GridCornerMeasurer::FitTag(const SeenTag& tag, double exponent, double floor_px,
                                                       int max_pixels) const {
  Eigen::Array2d low = tag.corners_px[0], high = low;
  for (const Eigen::Vector2d& corner : tag.corners_px) {
    low = low.min(corner.array());
    high = high.max(corner.array());
  }
  constexpr double kRim = 0.3;  // in tag extents, for its white rim
  const Eigen::Array2d rim = kRim * (high - low) + 2;
  const Eigen::Array2i size(static_cast<int>(grey_.cols()), static_cast<int>(grey_.rows()));
  const Eigen::Array2i begin = (low - rim).floor().cast<int>().max(0);
  const Eigen::Array2i end = ((high + rim).ceil().cast<int>() + 1).min(size);
  if ((end <= begin).any()) return std::nullopt;
  ImagePlane about = grey_.block(begin.y(), begin.x(), end.y() - begin.y(), end.x() - begin.x());
  if (exponent != 1) about = about.max(0.0f).pow(static_cast<float>(exponent));
  TagDetection detection;
  detection.id = first_id_ + tag.number;
  detection.corners_px = tag.corners_px;
  for (Eigen::Vector2d& corner : detection.corners_px) corner -= begin.cast<double>().matrix();
  detection.side_px = MeanSidePx(tag.corners_px);
  detection.corner_sigma_px = kDetectorSigmaPx;
  RefineTagCornersOptions options = refine_;
  options.min_corner_sigma_px = floor_px;
  options.max_pixels = max_pixels;
  Camera camera = lens_;
  camera.width_px = static_cast<int>(about.cols());
  camera.height_px = static_cast<int>(about.rows());
  camera.cx_px -= begin.x();
  camera.cy_px -= begin.y();
  TagDetection refined = RefineTagCorners(about, camera, {detection}, options).front();
  if (refined.corner_sigma_px == kDetectorSigmaPx) return std::nullopt;  // returned as it came
  for (Eigen::Vector2d& corner : refined.corners_px) corner += begin.cast<double>().matrix();
  return refined;
}

std::array<bool, 4> GridCornerMeasurer::PlainCorners(const Eigen::Matrix3d& pixel_from_tag) const {
  std::array<bool, 4> is_plain{};
  for (std::size_t k = 0; k < 4; ++k) is_plain[k] = !IsSaddle(pixel_from_tag, k).value_or(true);
  return is_plain;
}

double GridCornerMeasurer::BestExponent(const std::vector<SeenTag>& tags) const {
  constexpr std::size_t kTags = 3;
  const std::size_t stride = std::max<std::size_t>(1, tags.size() / kTags);
  double best = 1, least = std::numeric_limits<double>::infinity();
  for (const double exponent : {1.0, 1.7, 2.2}) {
    // The fit's own sigmas grow with the part of the photo that the model does not explain.
    double sum = 0;
    int fitted = 0;
    for (std::size_t i = stride / 2; i < tags.size(); i += stride) {
      const auto fit = FitTag(tags[i], exponent, 0, kPixelsAtFirst);
      if (!fit) continue;
      sum += std::log(fit->corner_sigma_px);
      ++fitted;
    }
    if (fitted == 0 || sum / fitted >= least) continue;
    least = sum / fitted;
    best = exponent;
  }
  return best;
}

void GridCornerMeasurer::MeasurePlain(const std::array<bool, 4>& is_plain, SeenTag& tag) const {
  const auto fit = FitTag(tag, exponent_, refine_.min_corner_sigma_px, refine_.max_pixels);
  if (!fit) return;
  for (std::size_t k = 0; k < 4; ++k) {
    if (!is_plain[k]) continue;
    tag.corners_px[k] = fit->corners_px[k];
    tag.sigma_px[k] = fit->corner_sigma_px;
  }
}

std::optional<SeenTag> GridCornerMeasurer::Measure(const SeenTag& tag) const {
  SeenTag measured = tag;
  measured.sigma_px = {0, 0, 0, 0};  // clears an earlier measurement
  const auto pixel_from_tag = UnitSquareTo(tag.corners_px);
  if (!pixel_from_tag) return std::nullopt;
  for (std::size_t k = 0; k < 4; ++k) {
    if (IsSaddle(*pixel_from_tag, k).value_or(false)) MeasureSaddle(*pixel_from_tag, k, measured);
  }
  const std::array<bool, 4> is_plain = PlainCorners(*pixel_from_tag);
  if (std::find(is_plain.begin(), is_plain.end(), true) != is_plain.end()) MeasurePlain(is_plain, measured);
  const bool is_any = std::any_of(measured.sigma_px.begin(), measured.sigma_px.end(),
                                  [](double sigma_px) { return sigma_px > 0; });
  return is_any ? std::optional<SeenTag>(measured) : std::nullopt;
}

}  // namespace luxfit
