// Makes the pieces of SVG that the pictures of the program share: the document, text, and escaped names.
#ifndef LUXFIT_APPS_CHARTS_SVG_H_
#define LUXFIT_APPS_CHARTS_SVG_H_

#include <string>

namespace luxfit {

// Makes a white page of that many pixels; `body` is drawn on it.
std::string SvgDocument(double width_px, double height_px, const std::string& body);

// `attributes` are written as in XML: " fill=\"red\"", or nothing.
std::string SvgText(double x_px, double y_px, const std::string& text, const std::string& attributes = "");

std::string SvgLine(double x1_px, double y1_px, double x2_px, double y2_px, const std::string& attributes);

std::string SvgCircle(double x_px, double y_px, double radius_px, const std::string& attributes);

enum class SvgMarkShape { kDisc, kSquare, kDiamond, kTriangle, kCross };
// Draws a point of a chart, about 2 radius_px wide and slightly transparent.
std::string SvgMark(SvgMarkShape shape, const std::string& colour, double x_px, double y_px,
                    double radius_px);

// Escapes &, <, > and quotes, so that any text can stand in the file.
std::string XmlEscaped(const std::string& text);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CHARTS_SVG_H_
