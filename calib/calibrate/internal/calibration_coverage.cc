#include "calib/calibrate/internal/calibration_coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace luxfit {
namespace {

constexpr int kCells = 6;
constexpr int kThirds = 3;
constexpr double kDegPerRad = 180 / M_PI;
constexpr double kLeastTiltDeg = 10;
constexpr double kOneDistance = 1.2;  // ratio of farthest to nearest: below it, boards are at one distance

int CellOf(double pixel, int size_px) {
  return std::clamp(static_cast<int>(std::floor((pixel + 0.5) * kCells / size_px)), 0, kCells - 1);
}

std::string Joined(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i)
    text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
  return text;
}

using Cells = Eigen::Array<bool, kCells, kCells>;

// Marks the cells that can hold a corner: those of the circle, and those that do.
Cells CellsThatSee(const CalibrationCamera& camera, const ImageCircle& circle,
                   const Eigen::MatrixXi& counts) {
  const ImageRaster raster{camera.width_px, camera.height_px, kCells, kCells};
  Cells cells;
  for (int row = 0; row < kCells; ++row) {
    for (int column = 0; column < kCells; ++column)
      cells(row, column) = counts(row, column) > 0 || circle.Holds(raster.MiddleOf(row, column));
  }
  return cells;
}

// Marks the ninths of the image that can hold a corner, and hold none.
Eigen::Array<bool, kThirds, kThirds> EmptyThirds(const Eigen::MatrixXi& counts, const Cells& cells) {
  Eigen::Array<bool, kThirds, kThirds> empty;
  constexpr Eigen::Index kSide = kCells / kThirds;
  for (Eigen::Index row = 0; row < kThirds; ++row) {
    for (Eigen::Index column = 0; column < kThirds; ++column)
      empty(row, column) = counts.block(kSide * row, kSide * column, kSide, kSide).sum() == 0 &&
                           cells.block(kSide * row, kSide * column, kSide, kSide).any();
  }
  return empty;
}

std::vector<std::string> Lacks(const CalibrationCoverage& coverage, const Cells& cells) {
  std::vector<std::string> lacks;
  const std::string empty = ThirdsInWords(EmptyThirds(coverage.corner_counts, cells));
  if (!empty.empty()) lacks.push_back("no corner in " + empty + " of the image");
  if (coverage.is_flat && coverage.max_tilt_deg < kLeastTiltDeg)
    lacks.push_back(
        fmt::format("the board was never tilted more than {:.0f} degrees", std::ceil(coverage.max_tilt_deg)));
  if (coverage.is_flat && coverage.images > 1 && coverage.farthest_m < kOneDistance * coverage.nearest_m)
    lacks.push_back("all boards are at one distance");
  return lacks;
}

}  // namespace

std::string ThirdsInWords(const Eigen::Array<bool, 3, 3>& marked) {
  const std::array<std::string, 3> rows = {"upper", "middle", "lower"}, columns = {"left", "middle", "right"};
  if (marked.all()) return "every third";
  Eigen::Array<bool, 3, 3> left = marked;
  std::vector<std::string> words;
  for (int k = 0; k < kThirds; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (marked.row(k).all()) words.push_back("the " + rows[i] + " third");
    if (marked.col(k).all()) words.push_back("the " + columns[i] + " third");
    if (marked.row(k).all()) left.row(k).setConstant(false);
    if (marked.col(k).all()) left.col(k).setConstant(false);
  }
  for (int row = 0; row < kThirds; ++row) {
    for (int column = 0; column < kThirds; ++column) {
      if (!left(row, column)) continue;
      const std::string& across = columns[static_cast<std::size_t>(column)];
      words.push_back(row == 1 && column == 1
                          ? "the middle third"
                          : "the " + rows[static_cast<std::size_t>(row)] + " " + across + " third");
    }
  }
  return Joined(words);
}

CalibrationCoverage CoverageOf(const CalibrationTarget& target, const CalibrationCamera& camera,
                               const ImageCircle& circle, const std::vector<CoveringImage>& images) {
  CalibrationCoverage coverage;
  coverage.corner_counts.setZero(kCells, kCells);
  coverage.is_flat = std::all_of(target.points.begin(), target.points.end(),
                                 [](const Eigen::Vector3d& p) { return p.z() == 0; });
  coverage.nearest_m = std::numeric_limits<double>::infinity();
  for (const CoveringImage& image : images) {
    if (image.corners.empty()) continue;
    ++coverage.images;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const BoardCorner& corner : image.corners) {
      coverage.corner_counts(CellOf(corner.pixel.y(), camera.height_px),
                             CellOf(corner.pixel.x(), camera.width_px)) += 1;
      middle += target.points[static_cast<std::size_t>(corner.index)];
    }
    middle /= static_cast<double>(image.corners.size());
    const double distance_m = (image.cam_from_target * middle).norm();
    coverage.nearest_m = std::min(coverage.nearest_m, distance_m);
    coverage.farthest_m = std::max(coverage.farthest_m, distance_m);
    const double cosine = std::abs(image.cam_from_target.linear()(2, 2));
    if (coverage.is_flat)
      coverage.max_tilt_deg = std::max(coverage.max_tilt_deg, kDegPerRad * std::acos(std::min(1.0, cosine)));
  }
  if (coverage.images == 0) coverage.nearest_m = 0;
  const Cells cells = CellsThatSee(camera, circle, coverage.corner_counts);
  if (cells.any())
    coverage.covered_share = static_cast<double>((coverage.corner_counts.array() > 0).count()) /
                             static_cast<double>(cells.count());
  coverage.lacks = Lacks(coverage, cells);
  return coverage;
}

}  // namespace luxfit
