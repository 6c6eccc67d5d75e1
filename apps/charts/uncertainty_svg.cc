#include "apps/charts/uncertainty_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/charts/svg.h"

namespace luxfit {
namespace {

constexpr double kMarginPx = 16, kTitlePx = 46, kLegendPx = 62;
constexpr double kLeastPx = 0.01, kMostPx = 10;

// Runs from blue (certain) through pale yellow to red. Lightness changes evenly to both sides, so that the
// scale works in print and for colour-blind readers.
constexpr std::array<std::array<double, 3>, 5> kRamp = {
    {{43, 91, 168}, {120, 177, 211}, {246, 240, 195}, {240, 142, 86}, {177, 24, 43}}};

std::string ColourOf(double sigma_px) {
  if (!std::isfinite(sigma_px)) return "url(#unknown)";
  const double share =
      std::clamp(std::log(sigma_px / kLeastPx) / std::log(kMostPx / kLeastPx), 0.0, 1.0) * (kRamp.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(share), kRamp.size() - 2);
  const double t = share - static_cast<double>(low);
  std::array<int, 3> rgb{};
  for (std::size_t i = 0; i < 3; ++i)
    rgb[i] = static_cast<int>(std::lround((1 - t) * kRamp[low][i] + t * kRamp[low + 1][i]));
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

std::string HeatMap(const UncertaintyMap& map, double top) {
  const double scale = map.drawn_px / map.width_px;
  const double width = map.drawn_px / static_cast<double>(map.sigma_px.cols());
  const double height = map.height_px * scale / static_cast<double>(map.sigma_px.rows());
  const ImageRaster raster{map.width_px, map.height_px, map.sigma_px.rows(), map.sigma_px.cols()};
  std::string body =
      fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"#f4f4f4\"/>\n",
                  kMarginPx, top, map.drawn_px, map.height_px * scale);
  for (Eigen::Index row = 0; row < map.sigma_px.rows(); ++row) {
    for (Eigen::Index column = 0; column < map.sigma_px.cols(); ++column) {
      if (!map.circle.Holds(raster.MiddleOf(row, column))) continue;
      // Slightly wider than the cell, so that no seams show.
      body += fmt::format(
          "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n",
          kMarginPx + static_cast<double>(column) * width, top + static_cast<double>(row) * height,
          width + 0.3, height + 0.3, ColourOf(map.sigma_px(row, column)));
    }
  }
  return body;
}

std::string Corners(const std::vector<MappedCorner>& corners, double scale, double top) {
  std::string body;
  for (const MappedCorner& corner : corners) {
    const double x = kMarginPx + (corner.pixel.x() + 0.5) * scale, y = top + (corner.pixel.y() + 0.5) * scale;
    body += corner.is_outlier
                ? SvgLine(x - 4, y - 4, x + 4, y + 4, " stroke=\"black\" stroke-width=\"1.5\"") +
                      SvgLine(x - 4, y + 4, x + 4, y - 4, " stroke=\"black\" stroke-width=\"1.5\"")
                : SvgCircle(x, y, 1.3, " fill=\"black\" fill-opacity=\"0.55\"");
  }
  return body;
}

std::string Legend(double drawn_px, double top) {
  constexpr int kSteps = 60;
  const double width = drawn_px * 0.6;
  std::string body;
  for (int i = 0; i < kSteps; ++i) {
    const double sigma_px = kLeastPx * std::pow(kMostPx / kLeastPx, (i + 0.5) / kSteps);
    body += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"12\" fill=\"{}\"/>\n",
                        kMarginPx + i * width / kSteps, top, width / kSteps + 0.3, ColourOf(sigma_px));
  }
  for (const double tick : {0.01, 0.1, 1.0, 10.0}) {
    const double x = kMarginPx + width * std::log(tick / kLeastPx) / std::log(kMostPx / kLeastPx);
    const std::string anchor = tick == kLeastPx ? "start" : tick == kMostPx ? "end" : "middle";
    body += SvgText(x, top + 28, fmt::format("{:g} px", tick), fmt::format(" text-anchor=\"{}\"", anchor));
  }
  const double right = kMarginPx + width + 24;
  return body + SvgCircle(right, top + 6, 2, "") + SvgText(right + 10, top + 10, "corner") +
         SvgText(right + 70, top + 10, "× outlier");
}

}  // namespace

std::string UncertaintySvg(const UncertaintyMap& map, const std::vector<MappedCorner>& corners) {
  const double scale = map.drawn_px / map.width_px;
  const double top = map.title.empty() ? kMarginPx : kTitlePx, height = map.height_px * scale;
  std::string body =
      "<defs><pattern id=\"unknown\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\">"
      "<rect width=\"6\" height=\"6\" fill=\"#ddd\"/><path d=\"M0 6L6 0\" "
      "stroke=\"#888\"/></pattern></defs>\n";
  if (!map.title.empty())
    body += SvgText(kMarginPx, 20, map.title, " font-size=\"15\"") +
            SvgText(kMarginPx, 38, map.subtitle, " fill=\"#555\"");
  body += HeatMap(map, top) + Corners(corners, scale, top) + Legend(map.drawn_px, top + height + 16);
  return SvgDocument(map.drawn_px + 2 * kMarginPx, top + height + kLegendPx, body);
}

}  // namespace luxfit
