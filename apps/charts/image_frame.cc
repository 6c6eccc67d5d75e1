#include "apps/charts/image_frame.h"

#include <fmt/format.h>

#include "apps/charts/chart_axis.h"
#include "apps/charts/svg.h"

namespace luxfit {

double ImageFrame::ScaleOfDrawing() const { return kFrameWidthPx / width_px; }

Eigen::Vector2d ImageFrame::At(const Eigen::Vector2d& pixel) const {
  return Eigen::Vector2d(kFrameLeftPx, kFrameTopPx) +
         ScaleOfDrawing() * (pixel + Eigen::Vector2d::Constant(0.5));
}

double ImageFrame::BottomPx() const { return kFrameTopPx + ScaleOfDrawing() * height_px; }

std::string ImageFrame::Axes() const {
  constexpr double kTickPx = 4;
  const std::string stroke = " stroke=\"#777\"", small = " font-size=\"11\" fill=\"#555\"";
  const double right = kFrameLeftPx + kFrameWidthPx, bottom = BottomPx();
  std::string text =
      fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\"{}/>\n",
                  kFrameLeftPx, kFrameTopPx, kFrameWidthPx, bottom - kFrameTopPx, stroke);
  const ChartAxis x{0, static_cast<double>(width_px), kFrameLeftPx, right, false};
  for (const double tick : x.Ticks())
    text += SvgLine(x(tick), bottom, x(tick), bottom + kTickPx, stroke) +
            SvgText(x(tick), bottom + 16, fmt::format("{:g}", tick), " text-anchor=\"middle\"" + small);
  const ChartAxis y{0, static_cast<double>(height_px), kFrameTopPx, bottom, false};
  for (const double tick : y.Ticks())
    text += SvgLine(kFrameLeftPx - kTickPx, y(tick), kFrameLeftPx, y(tick), stroke) +
            SvgText(kFrameLeftPx - 7, y(tick) + 4, fmt::format("{:g}", tick), " text-anchor=\"end\"" + small);
  return text;
}

std::string ImageFrame::Document(const std::string& body, double legend_px) const {
  return SvgDocument(kFrameLeftPx + kFrameWidthPx + 14, BottomPx() + kFrameAxisPx + legend_px, body + Axes());
}

}  // namespace luxfit
