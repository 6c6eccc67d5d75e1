#include "apps/report/calibration/calibration_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "apps/charts/coverage_svg.h"
#include "apps/charts/image_frame.h"
#include "apps/charts/residual_svg.h"
#include "apps/charts/rig_svg.h"
#include "apps/charts/uncertainty_svg.h"
#include "apps/report/html.h"

namespace luxfit {
namespace {

constexpr std::size_t kWorstPhotos = 3;

// Returns the photos of a camera that are in use, the one with the largest error first.
std::vector<RecordedImage> WorstFirst(const RecordedGroup& group, const std::string& camera) {
  std::vector<RecordedImage> images;
  std::copy_if(
      group.images.begin(), group.images.end(), std::back_inserter(images),
      [&](const RecordedImage& image) { return image.camera == camera && image.outliers < image.corners; });
  std::stable_sort(images.begin(), images.end(),
                   [](const RecordedImage& a, const RecordedImage& b) { return a.rms_px > b.rms_px; });
  return images;
}

std::string WorstPhotos(const RecordedGroup& group, const std::string& camera) {
  std::string text;
  const std::vector<RecordedImage> images = WorstFirst(group, camera);
  for (std::size_t i = 0; i < std::min(kWorstPhotos, images.size()); ++i)
    text += fmt::format("{}{} ({:.3f} px)", i == 0 ? "" : ", ", images[i].file, images[i].rms_px);
  return text;
}

std::string Residuals(const RecordedGroup& group, const RecordedCamera& camera) {
  const ImageFrame frame{camera.width_px, camera.height_px};
  const auto outliers = std::count_if(camera.corners.begin(), camera.corners.end(),
                                      [](const SeenCorner& corner) { return corner.is_outlier; });
  const std::string vectors = HtmlFigure(
      ResidualVectorsSvg(frame, camera.corners),
      fmt::format(
          "{}: from where each corner was seen towards where the lens predicts it, {:g} times magnified. {} "
          "corners, {} of them left out.",
          camera.id, ResidualMagnification(frame, camera.corners), camera.corners.size(), outliers));
  const std::string histogram = ResidualHistogramSvg(camera.corners, group.noise_px);
  std::string html = HtmlHeading(3, camera.id);
  html += HtmlParagraph("Largest rms per axis: " + WorstPhotos(group, camera.id) + ".");
  return html +
         HtmlSideBySide(vectors +
                        (histogram.empty()
                             ? ""
                             : HtmlFigure(histogram, fmt::format("{}: both components of the corners in "
                                                                 "use. A good fit follows the curve.",
                                                                 camera.id))));
}

std::string Coverage(const RecordedCamera& camera) {
  std::vector<Eigen::Vector2d> corners;
  for (const SeenCorner& corner : camera.corners) {
    if (!corner.is_outlier) corners.push_back(corner.pixel);
  }
  std::string lacks;
  for (const std::string& lack : camera.lacks) lacks += (lacks.empty() ? "" : "; ") + lack;
  std::string caption = fmt::format(
      "{}: corners in {:.0f} % of the cells{}; the number of each cell is in it. Boards from {:.0f} to "
      "{:.0f} "
      "mm "
      "away",
      camera.id, 100 * camera.covered_share, camera.circle.IsWholePicture() ? "" : " within the image circle",
      1000 * camera.nearest_m, 1000 * camera.farthest_m);
  if (std::isfinite(camera.max_tilt_deg))
    caption += fmt::format(", tilted up to {:.0f} degrees", camera.max_tilt_deg);
  caption += lacks.empty() ? ". No third of the image is without corners." : ". Lacks: " + lacks + ".";
  return HtmlFigure(
      CoverageSvg({camera.width_px, camera.height_px}, camera.corner_counts, camera.circle, corners),
      caption);
}

std::string RangeText(double range_m) {
  return std::isfinite(range_m)
             ? fmt::format("points {:.0f} mm away, the usual distance of the target", 1000 * range_m)
             : "directions, points far away";
}

// Returns the least and the largest sigma within the image circle.
std::string SigmasText(const UncertaintyMap& map) {
  const Eigen::MatrixXd& sigma_px = map.sigma_px;
  const ImageRaster raster{map.width_px, map.height_px, sigma_px.rows(), sigma_px.cols()};
  double least_px = std::numeric_limits<double>::infinity(), most_px = 0;
  for (Eigen::Index row = 0; row < raster.rows; ++row) {
    for (Eigen::Index column = 0; column < raster.columns; ++column) {
      if (!map.circle.Holds(raster.MiddleOf(row, column))) continue;
      if (!std::isfinite(sigma_px(row, column))) return "; hatched where it is not determined";
      least_px = std::min(least_px, sigma_px(row, column));
      most_px = std::max(most_px, sigma_px(row, column));
    }
  }
  return fmt::format(": {:.2g} to {:.2g} px", least_px, most_px) +
         (map.circle.IsWholePicture() ? "" : " within the image circle");
}

std::string Uncertainty(const RecordedCamera& camera) {
  std::string figures;
  for (const RecordedMap& recorded : camera.maps) {
    UncertaintyMap map;
    map.width_px = camera.width_px;
    map.height_px = camera.height_px;
    map.sigma_px = recorded.sigma_px;
    map.circle = camera.circle;
    map.drawn_px = kFrameWidthPx;
    std::vector<MappedCorner> corners;
    for (const SeenCorner& corner : camera.corners) corners.push_back({corner.pixel, corner.is_outlier});
    figures +=
        HtmlFigure(UncertaintySvg(map, corners), fmt::format("{}: sigma of the pixel, {}{}.", camera.id,
                                                             RangeText(recorded.range_m), SigmasText(map)));
  }
  return figures;
}

// Returns the boards in the rig's frame: one of each set, for its images share one pose of the board.
std::vector<std::array<Eigen::Vector3d, 4>> BoardsOf(const RecordedGroup& group) {
  std::vector<std::array<Eigen::Vector3d, 4>> boards;
  const Eigen::Vector3d low = group.target.min(), high = group.target.max();
  if (low.z() != high.z()) return boards;  // tags of a room
  std::set<int> drawn;
  for (const RecordedImage& image : group.images) {
    const auto camera = std::find_if(group.cameras.begin(), group.cameras.end(),
                                     [&](const RecordedCamera& c) { return c.id == image.camera; });
    if (camera == group.cameras.end() || image.outliers == image.corners || !drawn.insert(image.set).second)
      continue;
    const Eigen::Isometry3d rig_from_target = camera->cam_from_rig.inverse() * image.cam_from_target;
    boards.push_back({rig_from_target * low, rig_from_target * Eigen::Vector3d(high.x(), low.y(), low.z()),
                      rig_from_target * high, rig_from_target * Eigen::Vector3d(low.x(), high.y(), low.z())});
  }
  return boards;
}

std::string RigPictures(const RecordedGroup& group) {
  DrawnRig rig;
  for (const RecordedCamera& camera : group.cameras)
    rig.cameras.push_back({camera.id, camera.cam_from_rig.inverse(), camera.corner_directions});
  rig.boards = BoardsOf(group);
  const std::string boards =
      rig.boards.empty() ? "" : fmt::format(" Grey: the corners' area of the {} boards.", rig.boards.size());
  return HtmlSideBySide(
      HtmlFigure(RigSvg(rig, RigView::kPlan),
                 fmt::format("Plan: {}, seen from above, in the frame of {}.{}", CameraNames(group),
                             group.cameras.front().id, boards)) +
      HtmlFigure(RigSvg(rig, RigView::kSide),
                 fmt::format("Side: the same, seen from the right of {}.", group.cameras.front().id)));
}

}  // namespace

std::string ResidualSection(const CalibrationRecord& record) {
  std::string html;
  for (const RecordedGroup& group : record.groups) {
    for (const RecordedCamera& camera : group.cameras) html += Residuals(group, camera);
  }
  return HtmlSection(
      "residuals", "Residuals",
      "Reprojection errors, predicted less seen. Vectors that point the same way in a part of the image mean "
      "that the lens model does not fit there.",
      html);
}

std::string CoverageSection(const CalibrationRecord& record) {
  std::string figures;
  for (const RecordedGroup& group : record.groups) {
    for (const RecordedCamera& camera : group.cameras) figures += Coverage(camera);
  }
  return HtmlSection(
      "coverage", "Coverage",
      "Where the corners in use fell in the images. A lens is known only there: cells without a corner are "
      "hatched in red, where the lens gives an image.",
      HtmlSideBySide(figures));
}

std::string UncertaintySection(const CalibrationRecord& record) {
  std::string html;
  for (const RecordedGroup& group : record.groups) {
    for (const RecordedCamera& camera : group.cameras) html += HtmlSideBySide(Uncertainty(camera));
  }
  return HtmlSection(
      "uncertainty", "Uncertainty of projections",
      "How far the pixel of a point is off by the noise of the corners: one sigma in the worst direction, "
      "from "
      "the covariance of the calibration. An error of the lens model or of the board is not in it.",
      html);
}

std::string RigSection(const CalibrationRecord& record) {
  std::string html;
  for (const RecordedGroup& group : record.groups) {
    if (!group.cameras.empty()) html += RigPictures(group);
  }
  return HtmlSection("rig", "Cameras and boards",
                     "To scale. Fields of view are drawn for a part of their length.", html);
}

}  // namespace luxfit
