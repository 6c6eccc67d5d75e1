#include "apps/charts/svg.h"

#include <fmt/format.h>

#include "forward/room/one_line.h"

namespace luxfit {

std::string XmlEscaped(const std::string& text) {
  std::string escaped;
  for (const char c : OneLine(text)) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string SvgDocument(double width_px, double height_px, const std::string& body) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" "
      "font-size=\"13\">\n<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"white\"/>\n{2}</svg>\n",
      width_px, height_px, body);
}

std::string SvgText(double x_px, double y_px, const std::string& text, const std::string& attributes) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n", x_px, y_px, attributes,
                     XmlEscaped(text));
}

std::string SvgLine(double x1_px, double y1_px, double x2_px, double y2_px, const std::string& attributes) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"{}/>\n", x1_px, y1_px,
                     x2_px, y2_px, attributes);
}

std::string SvgCircle(double x_px, double y_px, double radius_px, const std::string& attributes) {
  return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"{}/>\n", x_px, y_px, radius_px,
                     attributes);
}

std::string SvgMark(SvgMarkShape shape, const std::string& colour, double x_px, double y_px,
                    double radius_px) {
  const double x = x_px, y = y_px, r = radius_px;
  const std::string fill = fmt::format(" fill=\"{}\" fill-opacity=\"0.75\"", colour);
  std::string path;
  switch (shape) {
    case SvgMarkShape::kDisc:
      return SvgCircle(x, y, r, fill);
    case SvgMarkShape::kSquare:
      path = fmt::format("M{0:.1f} {1:.1f}h{2:.1f}v{2:.1f}h{3:.1f}z", x - r, y - r, 2 * r, -2 * r);
      break;
    case SvgMarkShape::kDiamond:
      path = fmt::format("M{0:.1f} {1:.1f}l{2:.1f} {2:.1f}l{3:.1f} {2:.1f}l{3:.1f} {3:.1f}z", x, y - 1.3 * r,
                         1.3 * r, -1.3 * r);
      break;
    case SvgMarkShape::kTriangle:
      path = fmt::format("M{:.1f} {:.1f}l{:.1f} {:.1f}h{:.1f}z", x, y - 1.2 * r, 1.2 * r, 2.2 * r, -2.4 * r);
      break;
    case SvgMarkShape::kCross:
      path = fmt::format("M{0:.1f} {1:.1f}l{2:.1f} {2:.1f}m0 {3:.1f}l{3:.1f} {2:.1f}", x - r, y - r, 2 * r,
                         -2 * r);
      return fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"2\" fill=\"none\"/>\n", path, colour);
  }
  return fmt::format("<path d=\"{}\"{}/>\n", path, fill);
}

}  // namespace luxfit
