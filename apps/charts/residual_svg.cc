#include "apps/charts/residual_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/charts/chart_axis.h"
#include "apps/charts/svg.h"

namespace luxfit {
namespace {

constexpr char kBlue[] = "#0b63ce", kRed[] = "#c62828";

// Returns 1, 2 or 5 times a power of ten, the largest that is no more than the value.
double RoundBelow(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  const double share = value / decade;
  return decade * (share >= 5 ? 5 : share >= 2 ? 2 : 1);
}

bool IsInUse(const SeenCorner& corner) { return !corner.is_outlier && corner.residual_px.allFinite(); }

std::string Vector(const ImageFrame& frame, const SeenCorner& corner, double magnification) {
  const Eigen::Vector2d from = frame.At(corner.pixel);
  const Eigen::Vector2d to = frame.At(corner.pixel + magnification * corner.residual_px);
  const char* colour = corner.is_outlier ? kRed : kBlue;
  std::string text = corner.is_outlier
                         ? SvgMark(SvgMarkShape::kCross, kRed, from.x(), from.y(), 4)
                         : SvgCircle(from.x(), from.y(), 1.1, fmt::format(" fill=\"{}\"", colour));
  if (corner.residual_px.allFinite())
    text += SvgLine(from.x(), from.y(), to.x(), to.y(),
                    fmt::format(" stroke=\"{}\" stroke-opacity=\"0.8\"", colour));
  return text;
}

// Draws a vector of a round length below the image, and says what it stands for.
std::string Scale(const ImageFrame& frame, double magnification) {
  constexpr double kLongestPx = 90;
  const double px = RoundBelow(kLongestPx / (magnification * frame.ScaleOfDrawing()));
  const double length = px * magnification * frame.ScaleOfDrawing();
  const double y = frame.BottomPx() + kFrameAxisPx + 12, x = kFrameLeftPx;
  return SvgLine(x, y, x + length, y, fmt::format(" stroke=\"{}\" stroke-width=\"2\"", kBlue)) +
         SvgText(x + length + 8, y + 4, fmt::format("{:g} px; {:g} times magnified", px, magnification)) +
         SvgMark(SvgMarkShape::kCross, kRed, x + 340, y, 4) + SvgText(x + 352, y + 4, "left out");
}

struct Bins {
  double limit_px;          // from -limit to limit
  std::vector<int> counts;  // residuals beyond are in the outermost
  int total = 0;
  double WidthPx() const { return 2 * limit_px / static_cast<double>(counts.size()); }
};

Bins BinsOf(const std::vector<SeenCorner>& corners, double noise_px) {
  constexpr int kBins = 31;
  constexpr double kSigmas = 4;
  Bins bins{kSigmas * noise_px, std::vector<int>(kBins)};
  for (const SeenCorner& corner : corners) {
    if (!IsInUse(corner)) continue;
    for (const double residual_px : corner.residual_px) {
      const int bin = static_cast<int>(std::floor((residual_px + bins.limit_px) / bins.WidthPx()));
      ++bins.counts[static_cast<std::size_t>(std::clamp(bin, 0, kBins - 1))];
      ++bins.total;
    }
  }
  return bins;
}

std::string NormalCurve(const Bins& bins, double noise_px, const ChartAxis& x, const ChartAxis& y) {
  constexpr int kSteps = 80;
  const double peak = bins.total * bins.WidthPx() / (noise_px * std::sqrt(2 * M_PI));
  std::string path;
  for (int i = 0; i <= kSteps; ++i) {
    const double at = bins.limit_px * (2.0 * i / kSteps - 1), z = at / noise_px;
    path += fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", x(at), y(peak * std::exp(-z * z / 2)));
  }
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#333\" stroke-width=\"1.5\"/>\n", path);
}

}  // namespace

double ResidualMagnification(const ImageFrame& frame, const std::vector<SeenCorner>& corners) {
  constexpr double kShareOfWidth = 0.08, kShareShorter = 0.9;
  std::vector<double> lengths_px;
  for (const SeenCorner& corner : corners) {
    if (IsInUse(corner)) lengths_px.push_back(corner.residual_px.norm());
  }
  if (lengths_px.empty()) return 1;
  const auto at = lengths_px.begin() +
                  static_cast<std::ptrdiff_t>(kShareShorter * static_cast<double>(lengths_px.size() - 1));
  std::nth_element(lengths_px.begin(), at, lengths_px.end());
  return *at > 0 ? RoundBelow(kShareOfWidth * frame.width_px / *at) : 1;
}

std::string ResidualVectorsSvg(const ImageFrame& frame, const std::vector<SeenCorner>& corners) {
  constexpr double kLegendPx = 26;
  const double magnification = ResidualMagnification(frame, corners);
  std::string body;
  for (const SeenCorner& corner : corners) body += Vector(frame, corner, magnification);
  return frame.Document(body + Scale(frame, magnification), kLegendPx);
}

std::string ResidualHistogramSvg(const std::vector<SeenCorner>& corners, double noise_px) {
  constexpr double kWidthPx = 482, kHeightPx = 210, kLeftPx = 44, kRightPx = 468, kTopPx = 12,
                   kBottomPx = 166;
  if (!(noise_px > 0)) return "";
  const Bins bins = BinsOf(corners, noise_px);
  if (bins.total == 0) return "";
  const double most = std::max(static_cast<double>(*std::max_element(bins.counts.begin(), bins.counts.end())),
                               0.4 * bins.total * bins.WidthPx() / noise_px);
  const ChartAxis x{-bins.limit_px, bins.limit_px, kLeftPx, kRightPx, false};
  const ChartAxis y{0, 1.05 * most, kBottomPx, kTopPx, false};
  std::string body;
  for (const double tick : y.Ticks())
    body +=
        SvgLine(kLeftPx, y(tick), kRightPx, y(tick), " stroke=\"#e4e4e4\"") +
        SvgText(kLeftPx - 6, y(tick) + 4, fmt::format("{:g}", tick), " text-anchor=\"end\" font-size=\"11\"");
  for (std::size_t i = 0; i < bins.counts.size(); ++i) {
    const double from = -bins.limit_px + static_cast<double>(i) * bins.WidthPx();
    body += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\" "
        "fill-opacity=\"0.55\"/>\n",
        x(from) + 0.5, y(bins.counts[i]), x(from + bins.WidthPx()) - x(from) - 1,
        kBottomPx - y(bins.counts[i]), kBlue);
  }
  for (const double tick : x.Ticks())
    body += SvgText(x(tick), kBottomPx + 16, fmt::format("{:.3g}", tick),
                    " text-anchor=\"middle\" font-size=\"11\"");
  body += NormalCurve(bins, noise_px, x, y) +
          SvgLine(kLeftPx, kBottomPx, kRightPx, kBottomPx, " stroke=\"#333\"") +
          SvgText((kLeftPx + kRightPx) / 2, kBottomPx + 36,
                  fmt::format("reprojection error per axis, px; curve: noise of {:.3f} px", noise_px),
                  " text-anchor=\"middle\"");
  return SvgDocument(kWidthPx, kHeightPx, body);
}

}  // namespace luxfit
