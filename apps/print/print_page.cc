#include "apps/print/print_page.h"

#include <cairo-pdf.h>
#include <cairo.h>
#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#include "apps/charts/svg.h"

namespace luxfit {
namespace {

constexpr double kPointsPerMm = 72 / 25.4;
constexpr double kLineMm = 0.2;

cairo_status_t Append(void* text, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void DrawPage(cairo_t* cairo, const PrintPage& page) {
  cairo_scale(cairo, kPointsPerMm, kPointsPerMm);
  cairo_set_source_rgb(cairo, 0, 0, 0);
  for (const PrintRectangle& r : page.black) {
    const Eigen::Vector2d size_mm = r.max_mm - r.min_mm;
    cairo_rectangle(cairo, r.min_mm.x(), r.min_mm.y(), size_mm.x(), size_mm.y());
  }
  cairo_fill(cairo);
  cairo_set_line_width(cairo, kLineMm);
  for (const PrintLine& line : page.lines) {
    cairo_move_to(cairo, line.from_mm.x(), line.from_mm.y());
    cairo_line_to(cairo, line.to_mm.x(), line.to_mm.y());
  }
  cairo_stroke(cairo);
  cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  for (const PrintText& text : page.texts) {
    cairo_set_font_size(cairo, text.height_mm);
    cairo_move_to(cairo, text.at_mm.x(), text.at_mm.y());
    cairo_show_text(cairo, text.text.c_str());
  }
}

}  // namespace

std::string PageSvg(const PrintPage& page) {
  fmt::memory_buffer out;
  const auto to = fmt::appender(out);
  fmt::format_to(
      to,
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}mm\" height=\"{1:g}mm\" viewBox=\"0 0 "
      "{0:g} {1:g}\" font-family=\"sans-serif\">\n<rect width=\"{0:g}\" height=\"{1:g}\" "
      "fill=\"white\"/>\n<path d=\"",
      page.size_mm.x(), page.size_mm.y());
  for (const PrintRectangle& r : page.black)
    fmt::format_to(to, "M{:.7g} {:.7g}H{:.7g}V{:.7g}H{:.7g}Z\n", r.min_mm.x(), r.min_mm.y(), r.max_mm.x(),
                   r.max_mm.y(), r.min_mm.x());
  fmt::format_to(to, "\"/>\n<g stroke=\"black\" stroke-width=\"{:g}\">\n", kLineMm);
  for (const PrintLine& line : page.lines)
    fmt::format_to(to, "<line x1=\"{:.5g}\" y1=\"{:.5g}\" x2=\"{:.5g}\" y2=\"{:.5g}\"/>\n", line.from_mm.x(),
                   line.from_mm.y(), line.to_mm.x(), line.to_mm.y());
  fmt::format_to(to, "</g>\n");
  for (const PrintText& text : page.texts)
    fmt::format_to(to, "<text x=\"{:.5g}\" y=\"{:.5g}\" font-size=\"{:g}\">{}</text>\n", text.at_mm.x(),
                   text.at_mm.y(), text.height_mm, XmlEscaped(text.text));
  fmt::format_to(to, "</svg>\n");
  return fmt::to_string(out);
}

std::string PagesPdf(const std::vector<PrintPage>& pages, const std::string& title) {
  std::string bytes;
  const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(
      cairo_pdf_surface_create_for_stream(Append, &bytes, 1, 1), cairo_surface_destroy);
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, title.c_str());
  for (const PrintPage& page : pages) {
    cairo_pdf_surface_set_size(surface.get(), page.size_mm.x() * kPointsPerMm,
                               page.size_mm.y() * kPointsPerMm);
    const std::unique_ptr<cairo_t, void (*)(cairo_t*)> cairo(cairo_create(surface.get()), cairo_destroy);
    DrawPage(cairo.get(), page);
    cairo_show_page(cairo.get());
  }
  cairo_surface_finish(surface.get());
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS)
    throw std::invalid_argument(std::string("PagesPdf: ") +
                                cairo_status_to_string(cairo_surface_status(surface.get())));
  return bytes;
}

}  // namespace luxfit
