#include "apps/charts/rig_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/charts/chart_axis.h"
#include "apps/charts/svg.h"
#include "apps/charts/xy_chart_svg.h"

namespace luxfit {
namespace {

constexpr double kWidthPx = 482, kLeftPx = 48, kRightPx = 468, kTopPx = 14;
constexpr double kTallestPx = 430, kAxisPx = 40, kDimensionPx = 28;
constexpr double kDrawnMmPerM = 1000;

Eigen::Vector3d MiddleOf(const std::array<Eigen::Vector3d, 4>& board) {
  return (board[0] + board[1] + board[2] + board[3]) / 4;
}

// Returns the length at which fields of view are drawn: a part of the way to the boards, else of the rig's
// size.
double FieldLengthM(const DrawnRig& rig) {
  constexpr double kPartOfWay = 0.35, kLeastM = 0.02;
  double length_m = kLeastM;
  for (const DrawnCamera& camera : rig.cameras)
    length_m = std::max(length_m, camera.rig_from_cam.translation().norm() / 2);
  if (rig.boards.empty()) return length_m;
  double nearest_m = MiddleOf(rig.boards.front()).norm();
  for (const auto& board : rig.boards) nearest_m = std::min(nearest_m, MiddleOf(board).norm());
  return kPartOfWay * nearest_m;
}

std::array<Eigen::Vector3d, 4> FieldCorners(const DrawnCamera& camera, double length_m) {
  std::array<Eigen::Vector3d, 4> corners;
  for (std::size_t k = 0; k < corners.size(); ++k)
    corners[k] = camera.rig_from_cam * Eigen::Vector3d(length_m * camera.corner_directions[k]);
  return corners;
}

// Maps metres in the rig's frame to pixels of the picture.
class Drawing {
 public:
  Drawing(const DrawnRig& rig, RigView view) : view_(view), field_length_m_(FieldLengthM(rig)) {
    Eigen::AlignedBox2d box;
    const auto extend = [&](const Eigen::Vector3d& p) {
      if (p.allFinite()) box.extend(OnPage(p));
    };
    for (const DrawnCamera& camera : rig.cameras) {
      extend(camera.rig_from_cam.translation());
      for (const Eigen::Vector3d& corner : FieldCorners(camera, field_length_m_)) extend(corner);
    }
    for (const auto& board : rig.boards) {
      for (const Eigen::Vector3d& corner : board) extend(corner);
    }
    const Eigen::Vector2d room = Eigen::Vector2d::Constant(std::max(0.06 * box.sizes().maxCoeff(), 0.01));
    box_ = {box.min() - room, box.max() + room};
    px_per_m_ = std::min((kRightPx - kLeftPx) / box_.sizes().x(), kTallestPx / box_.sizes().y());
  }

  Eigen::Vector2d At(const Eigen::Vector3d& p) const {
    const Eigen::Vector2d from_min = OnPage(p) - box_.min();
    return Eigen::Vector2d(kLeftPx, kTopPx) + px_per_m_ * from_min;
  }
  double RightPx() const { return kLeftPx + px_per_m_ * box_.sizes().x(); }
  double BottomPx() const { return kTopPx + px_per_m_ * box_.sizes().y(); }
  double field_length_m() const { return field_length_m_; }

  std::string Axes() const;

 private:
  // Returns right and down on the page, m.
  Eigen::Vector2d OnPage(const Eigen::Vector3d& p) const {
    return view_ == RigView::kPlan ? Eigen::Vector2d(p.x(), -p.z()) : Eigen::Vector2d(p.z(), p.y());
  }

  RigView view_;
  double field_length_m_, px_per_m_ = 1;
  Eigen::AlignedBox2d box_;  // on the page, m
};

std::string Drawing::Axes() const {
  const bool is_plan = view_ == RigView::kPlan;
  const std::string grid = " stroke=\"#e8e8e8\"", small = " font-size=\"11\" fill=\"#555\"";
  const double up = is_plan ? -1 : 1;
  const ChartAxis x{kDrawnMmPerM * box_.min().x(), kDrawnMmPerM * box_.max().x(), kLeftPx, RightPx(), false};
  ChartAxis y{kDrawnMmPerM * box_.min().y(), kDrawnMmPerM * box_.max().y(), kTopPx, BottomPx(), false};
  std::string text;
  for (const double tick : x.Ticks())
    text += SvgLine(x(tick), kTopPx, x(tick), BottomPx(), grid) +
            SvgText(x(tick), BottomPx() + 15, fmt::format("{:g}", tick), " text-anchor=\"middle\"" + small);
  for (const double tick : y.Ticks())
    text += SvgLine(kLeftPx, y(tick), RightPx(), y(tick), grid) +
            SvgText(kLeftPx - 6, y(tick) + 4, fmt::format("{:g}", tick == 0 ? 0 : up * tick),
                    " text-anchor=\"end\"" + small);
  return text + SvgText((kLeftPx + RightPx()) / 2, BottomPx() + 32,
                        is_plan ? "x to the right, z (forward) upwards; mm"
                                : "z (forward) to the right, y downwards; mm",
                        " text-anchor=\"middle\"" + small);
}

std::string Polygon(const Drawing& drawing, const std::array<Eigen::Vector3d, 4>& corners,
                    const std::string& attributes) {
  std::string points;
  for (const Eigen::Vector3d& corner : corners) {
    if (!corner.allFinite()) return "";
    const Eigen::Vector2d at = drawing.At(corner);
    points += fmt::format("{:.1f},{:.1f} ", at.x(), at.y());
  }
  return fmt::format("<polygon points=\"{}\"{}/>\n", points, attributes);
}

std::string CameraShape(const Drawing& drawing, const DrawnCamera& camera, const std::string& colour) {
  const Eigen::Vector2d centre = drawing.At(camera.rig_from_cam.translation());
  const std::string stroke = fmt::format(" stroke=\"{}\" stroke-width=\"1.3\"", colour);
  const auto corners = FieldCorners(camera, drawing.field_length_m());
  std::string text =
      Polygon(drawing, corners, fmt::format(" fill=\"{}\" fill-opacity=\"0.10\"{}", colour, stroke));
  for (const Eigen::Vector3d& corner : corners) {
    if (!corner.allFinite()) continue;
    const Eigen::Vector2d at = drawing.At(corner);
    text += SvgLine(centre.x(), centre.y(), at.x(), at.y(), stroke);
  }
  return text + SvgCircle(centre.x(), centre.y(), 3.5, fmt::format(" fill=\"{}\"", colour));
}

// Draws a line with ends between two points, and its length above it.
std::string Dimension(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const std::string& label) {
  constexpr double kEndPx = 4, kCharacterPx = 7;
  const std::string stroke = " stroke=\"#222\"";
  const double half = std::min(kCharacterPx * static_cast<double>(label.size()), kWidthPx) / 2;
  return SvgLine(from.x(), from.y(), to.x(), to.y(), stroke) +
         SvgLine(from.x(), from.y() - kEndPx, from.x(), from.y() + kEndPx, stroke) +
         SvgLine(to.x(), to.y() - kEndPx, to.x(), to.y() + kEndPx, stroke) +
         SvgText(std::clamp((from.x() + to.x()) / 2, half, kWidthPx - half), from.y() - 6, label,
                 " text-anchor=\"middle\"");
}

// Draws a dimension below the axes, in line with two places of the drawing.
std::string DimensionBelow(const Drawing& drawing, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                           int line, const std::string& label) {
  const double y = drawing.BottomPx() + kAxisPx + kDimensionPx * (line + 0.8);
  return Dimension({drawing.At(a).x(), y}, {drawing.At(b).x(), y}, label);
}

std::vector<std::string> PlanDimensions(const DrawnRig& rig, const Drawing& drawing) {
  std::vector<std::string> dimensions;
  const Eigen::Vector3d first = rig.cameras.front().rig_from_cam.translation();
  for (std::size_t c = 1; c < rig.cameras.size(); ++c) {
    const Eigen::Vector3d place = rig.cameras[c].rig_from_cam.translation();
    dimensions.push_back(
        DimensionBelow(drawing, first, place, static_cast<int>(dimensions.size()),
                       fmt::format("{} to {}: {:.1f} mm", rig.cameras.front().name, rig.cameras[c].name,
                                   kDrawnMmPerM * (place - first).norm())));
  }
  return dimensions;
}

std::vector<std::string> SideDimensions(const DrawnRig& rig, const Drawing& drawing) {
  if (rig.boards.empty()) return {};
  std::vector<Eigen::Vector3d> middles;
  std::transform(rig.boards.begin(), rig.boards.end(), std::back_inserter(middles), MiddleOf);
  const auto [nearest, farthest] = std::minmax_element(
      middles.begin(), middles.end(),
      [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.norm() < b.norm(); });
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  return {DimensionBelow(drawing, origin, *nearest, 0,
                         fmt::format("nearest board: {:.0f} mm", kDrawnMmPerM * nearest->norm())),
          DimensionBelow(drawing, origin, *farthest, 1,
                         fmt::format("farthest board: {:.0f} mm", kDrawnMmPerM * farthest->norm()))};
}

// Writes the names below the cameras, and one below the other where cameras are close together.
std::string Names(const DrawnRig& rig, const Drawing& drawing) {
  constexpr double kBelowPx = 17, kLinePx = 14, kApartPx = 60;
  std::vector<Eigen::Vector2d> taken;
  std::string text;
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    Eigen::Vector2d at = drawing.At(rig.cameras[c].rig_from_cam.translation()) + Eigen::Vector2d(0, kBelowPx);
    for (const Eigen::Vector2d& other : taken) {
      if (std::abs(at.x() - other.x()) < kApartPx && std::abs(at.y() - other.y()) < kLinePx)
        at.y() = other.y() + kLinePx;
    }
    taken.push_back(at);
    text += SvgText(at.x(), at.y(), rig.cameras[c].name,
                    fmt::format(" text-anchor=\"middle\" fill=\"{}\" stroke=\"white\" stroke-width=\"3\" "
                                "paint-order=\"stroke\"",
                                XyStyleAt(c).colour));
  }
  return text;
}

}  // namespace

std::string RigSvg(const DrawnRig& rig, RigView view) {
  const Drawing drawing(rig, view);
  std::string body = drawing.Axes();
  for (const auto& board : rig.boards)
    body +=
        Polygon(drawing, board, " fill=\"#888\" fill-opacity=\"0.10\" stroke=\"#777\" stroke-width=\"0.8\"");
  for (std::size_t c = 0; c < rig.cameras.size(); ++c)
    body += CameraShape(drawing, rig.cameras[c], XyStyleAt(c).colour);
  const std::vector<std::string> dimensions =
      view == RigView::kPlan ? PlanDimensions(rig, drawing) : SideDimensions(rig, drawing);
  for (const std::string& dimension : dimensions) body += dimension;
  return SvgDocument(kWidthPx,
                     drawing.BottomPx() + kAxisPx + kDimensionPx * static_cast<double>(dimensions.size()) + 6,
                     body + Names(rig, drawing));
}

}  // namespace luxfit
