#include "apps/charts/coverage_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/charts/svg.h"

namespace luxfit {
namespace {

std::string Cell(const ImageFrame& frame, const Eigen::MatrixXi& counts, const ImageCircle& circle,
                 Eigen::Index row, Eigen::Index column) {
  constexpr double kDarkest = 0.55;
  const double width = kFrameWidthPx / static_cast<double>(counts.cols());
  const double height = (frame.BottomPx() - kFrameTopPx) / static_cast<double>(counts.rows());
  const double x = kFrameLeftPx + static_cast<double>(column) * width;
  const double y = kFrameTopPx + static_cast<double>(row) * height;
  const ImageRaster raster{frame.width_px, frame.height_px, counts.rows(), counts.cols()};
  const bool is_lacking = counts(row, column) == 0 && circle.Holds(raster.MiddleOf(row, column));
  const int count = counts(row, column), most = counts.maxCoeff();
  const std::string fill = is_lacking ? "fill=\"url(#no-corner)\""
                                      : fmt::format("fill=\"#0b63ce\" fill-opacity=\"{:.2f}\"",
                                                    kDarkest * std::sqrt(1.0 * count / std::max(1, most)));
  return fmt::format(
             "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" {} stroke=\"#ccc\"/>\n", x,
             y, width, height, fill) +
         SvgText(x + width - 4, y + height - 4, fmt::format("{}", count),
                 " font-size=\"11\" text-anchor=\"end\" stroke=\"white\" stroke-width=\"3\" "
                 "paint-order=\"stroke\"");
}

}  // namespace

std::string CoverageSvg(const ImageFrame& frame, const Eigen::MatrixXi& counts, const ImageCircle& circle,
                        const std::vector<Eigen::Vector2d>& corners) {
  std::string cells =
      "<defs><pattern id=\"no-corner\" width=\"7\" height=\"7\" patternUnits=\"userSpaceOnUse\">"
      "<rect width=\"7\" height=\"7\" fill=\"#fbe7e7\"/><path d=\"M0 7L7 0\" "
      "stroke=\"#d88\"/></pattern></defs>\n";
  for (Eigen::Index row = 0; row < counts.rows(); ++row) {
    for (Eigen::Index column = 0; column < counts.cols(); ++column)
      cells += Cell(frame, counts, circle, row, column);
  }
  std::string dots;
  for (const Eigen::Vector2d& corner : corners) {
    const Eigen::Vector2d at = frame.At(corner);
    dots += SvgCircle(at.x(), at.y(), 1.3, " fill=\"#123\" fill-opacity=\"0.6\"");
  }
  return frame.Document(cells + dots);
}

}  // namespace luxfit
