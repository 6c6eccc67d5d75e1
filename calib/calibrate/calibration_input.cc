#include "calib/calibrate/calibration_input.h"

#include <array>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

namespace luxfit {
namespace {

void CheckTarget(const CalibrationTarget& target) {
  for (const Eigen::Vector3d& point : target.points) {
    if (!point.allFinite()) throw std::invalid_argument("calibration: a target's point is not finite");
  }
  if (!target.IsGrid()) return;
  const auto count = static_cast<std::size_t>(target.columns) * static_cast<std::size_t>(target.rows);
  if (target.columns < 2 || target.rows < 2 || target.points.size() != count || !(target.spacing_m > 0))
    throw std::invalid_argument(
        "calibration: a grid of at least 2 x 2 points needs all of them and their spacing");
}

void CheckImage(const CalibrationInput& input, const CalibrationImage& image) {
  if (image.camera < 0 || image.camera >= static_cast<int>(input.cameras.size()))
    throw std::invalid_argument("calibration: " + image.name + ": no such camera");
  std::set<int> seen;
  for (const BoardCorner& corner : image.corners) {
    if (corner.index < 0 || corner.index >= static_cast<int>(input.target.points.size()))
      throw std::invalid_argument("calibration: " + image.name + ": no such point of the target");
    if (!corner.pixel.allFinite() || !(corner.sigma_px >= 0) || !std::isfinite(corner.sigma_px))
      throw std::invalid_argument("calibration: " + image.name + ": a corner is not finite");
    if (!seen.insert(corner.index).second)
      throw std::invalid_argument("calibration: " + image.name + ": a point twice");
  }
}

}  // namespace

CalibrationTarget TargetOf(const Board& board) {
  CalibrationTarget target;
  target.points = BoardCorners(board);
  if (board.type == BoardType::kAprilGrid) return target;
  const Eigen::Array2i counts = BoardCornerCounts(board);
  target.columns = counts.x();
  target.rows = counts.y();
  target.spacing_m = board.square_size_m;
  return target;
}

CalibrationTarget TargetOf(const std::vector<SurveyedTag>& survey) {
  CalibrationTarget target;
  target.points.reserve(4 * survey.size());
  for (const SurveyedTag& tag : survey) {
    for (const Eigen::Vector3d& corner : TagCornersInWorld(tag)) target.points.push_back(corner);
  }
  return target;
}

void CheckCalibrationInput(const CalibrationInput& input) {
  CheckTarget(input.target);
  for (const CalibrationCamera& camera : input.cameras) {
    if (camera.width_px < 1 || camera.height_px < 1)
      throw std::invalid_argument("calibration: camera " + camera.id + ": the image's size is missing");
  }
  std::set<std::pair<int, int>> taken;
  for (const CalibrationImage& image : input.images) {
    CheckImage(input, image);
    if (!taken.insert({image.set, image.camera}).second)
      throw std::invalid_argument("calibration: " + image.name + ": a second image of its camera in one set");
  }
}

}  // namespace luxfit
