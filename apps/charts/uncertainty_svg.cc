#include "apps/charts/uncertainty_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "apps/charts/svg.h"
#include "calib/lens/projection_uncertainty.h"

namespace luxfit {
namespace {

constexpr double kImageWidthPx = 720, kMarginPx = 16, kTitlePx = 46, kLegendPx = 62;
constexpr int kCellsAcross = 40;
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

std::string HeatMap(const CalibratedCamera& camera, double scale) {
  const int rows =
      std::max(1, static_cast<int>(std::lround(static_cast<double>(kCellsAcross) * camera.camera.height_px /
                                               camera.camera.width_px)));
  const Eigen::MatrixXd sigma_px = ProjectionSigmaMap(camera.camera, camera.uncertainty, kCellsAcross, rows,
                                                      std::numeric_limits<double>::infinity());
  const double width = camera.camera.width_px * scale / kCellsAcross;
  const double height = camera.camera.height_px * scale / rows;
  std::string body;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < kCellsAcross; ++column) {
      // Slightly wider than the cell, so that no seams show.
      body +=
          fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n",
                      kMarginPx + column * width, kTitlePx + row * height, width + 0.3, height + 0.3,
                      ColourOf(sigma_px(row, column)));
    }
  }
  return body;
}

std::string Corners(const std::vector<MappedCorner>& corners, double scale) {
  std::string body;
  for (const MappedCorner& corner : corners) {
    const double x = kMarginPx + (corner.pixel.x() + 0.5) * scale,
                 y = kTitlePx + (corner.pixel.y() + 0.5) * scale;
    body += corner.is_outlier
                ? SvgLine(x - 4, y - 4, x + 4, y + 4, " stroke=\"black\" stroke-width=\"1.5\"") +
                      SvgLine(x - 4, y + 4, x + 4, y - 4, " stroke=\"black\" stroke-width=\"1.5\"")
                : SvgCircle(x, y, 1.3, " fill=\"black\" fill-opacity=\"0.55\"");
  }
  return body;
}

std::string Legend(double top) {
  constexpr int kSteps = 60;
  const double width = kImageWidthPx * 0.6;
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

std::string UncertaintySvg(const CalibratedCamera& camera, const std::vector<MappedCorner>& corners) {
  const double scale = kImageWidthPx / camera.camera.width_px;
  const double height = camera.camera.height_px * scale;
  std::string body =
      "<defs><pattern id=\"unknown\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\">"
      "<rect width=\"6\" height=\"6\" fill=\"#ddd\"/><path d=\"M0 6L6 0\" "
      "stroke=\"#888\"/></pattern></defs>\n";
  body += SvgText(kMarginPx, 20, fmt::format("{}: how uncertain a direction's pixel is (1 sigma)", camera.id),
                  " font-size=\"15\"");
  body +=
      SvgText(kMarginPx, 38,
              fmt::format("{} x {} px, {}; median {:.2g} px; above the limit over {:.1f} % of the image",
                          camera.camera.width_px, camera.camera.height_px, ToString(camera.uncertainty.kind),
                          camera.median_sigma_px, 100 * camera.uncertain_share),
              " fill=\"#555\"");
  body += HeatMap(camera, scale) + Corners(corners, scale) + Legend(kTitlePx + height + 16);
  return SvgDocument(kImageWidthPx + 2 * kMarginPx, kTitlePx + height + kLegendPx, body);
}

}  // namespace luxfit
