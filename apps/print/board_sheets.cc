#include "apps/print/board_sheets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "calib/targets/tags.h"

namespace luxfit {
namespace {

constexpr double kRimMm = 6;     // margin that printers cannot print on
constexpr double kFootMm = 12;   // scale bar and caption
constexpr double kTextMm = 2.8;  // font
constexpr double kBarMm = 100;   // scale bar, where the page is wide enough
constexpr double kBarTextMm = 55;
constexpr double kLabelMm = 9;  // below a tag: its text and arrow
constexpr double kMmPerM = 1000;

Eigen::Vector2d SizeMm(const BoardDrawing& drawing) {
  return kMmPerM * (drawing.max_m - drawing.min_m + Eigen::Vector2d::Constant(2 * drawing.margin_m));
}

// Moves the drawing so that the corner of its white margin is at `at_mm`.
void Place(const BoardDrawing& drawing, const Eigen::Vector2d& at_mm, PrintPage& page) {
  const Eigen::Vector2d origin_m = drawing.min_m - Eigen::Vector2d::Constant(drawing.margin_m);
  for (const BlackRectangle& r : drawing.black)
    page.black.push_back({at_mm + kMmPerM * (r.min_m - origin_m), at_mm + kMmPerM * (r.max_m - origin_m)});
}

void AddFoot(const std::string& caption, PrintPage& page) {
  const double bar_mm = page.size_mm.x() >= kBarMm + kBarTextMm + 2 * kRimMm ? kBarMm : 50;
  const double y_mm = page.size_mm.y() - kRimMm - 5;
  page.lines.push_back({{kRimMm, y_mm}, {kRimMm + bar_mm, y_mm}});
  for (int i = 0; i <= static_cast<int>(bar_mm / 10); ++i) {
    const double x_mm = kRimMm + 10 * i;
    const bool is_end = i == 0 || i == static_cast<int>(bar_mm / 10);
    page.lines.push_back({{x_mm, y_mm - (is_end ? 2.5 : 1.2)}, {x_mm, y_mm}});
  }
  page.texts.push_back(
      {{kRimMm + bar_mm + 2, y_mm}, kTextMm, fmt::format("{:g} mm: measure it; print at 100 %", bar_mm)});
  page.texts.push_back({{kRimMm, page.size_mm.y() - kRimMm}, kTextMm, caption});
}

Paper ExpectFit(const Paper& paper, const Eigen::Vector2d& needed_mm, const std::string& what) {
  if (const auto fitting = Fitting(paper, needed_mm)) return *fitting;
  const std::string named = SmallestPaperFor(needed_mm);
  throw std::runtime_error(fmt::format(
      "--paper: expected at least {:.0f} x {:.0f} mm for {}, got {}; {}make it smaller",
      std::ceil(needed_mm.x()), std::ceil(needed_mm.y()), what, paper.name,
      named.empty()
          ? fmt::format("give --paper {:.0f}x{:.0f}, or ", std::ceil(needed_mm.x()), std::ceil(needed_mm.y()))
          : "it fits on " + named + ", or "));
}

// Draws an arrow to the top of the page, `height_mm` high, with its foot at `at_mm`.
void AddArrow(const Eigen::Vector2d& at_mm, double height_mm, PrintPage& page) {
  const Eigen::Vector2d tip_mm = at_mm - Eigen::Vector2d(0, height_mm);
  const double wing_mm = height_mm / 3;
  page.lines.push_back({at_mm, tip_mm});
  page.lines.push_back({tip_mm, tip_mm + Eigen::Vector2d(-wing_mm, wing_mm)});
  page.lines.push_back({tip_mm, tip_mm + Eigen::Vector2d(wing_mm, wing_mm)});
}

void PlaceTag(const std::string& family, int id, double size_m, const Eigen::Vector2d& at_mm,
              PrintPage& page) {
  const BoardDrawing drawing = DrawSingleTag(family, id, size_m);
  Place(drawing, at_mm, page);
  const double base_mm = at_mm.y() + SizeMm(drawing).y() + kLabelMm - 3;
  AddArrow({at_mm.x() + 2.5, base_mm}, 5, page);
  page.texts.push_back({{at_mm.x() + 6, base_mm - 0.5}, kTextMm + 0.7, fmt::format("id {}", id)});
  // A narrow tag carries its size below its id.
  page.texts.push_back(
      {{at_mm.x() + 6, base_mm + 2.5}, kTextMm - 0.5, fmt::format("{}, {:g} mm", family, kMmPerM * size_m)});
}

}  // namespace

Eigen::Vector2d SheetSizeMm(const BoardDrawing& drawing) {
  return SizeMm(drawing) + Eigen::Vector2d(2 * kRimMm, 2 * kRimMm + kFootMm);
}

PrintPage BoardSheet(const BoardDrawing& drawing, const Paper& paper, const std::string& caption) {
  PrintPage page;
  page.size_mm = ExpectFit(paper, SheetSizeMm(drawing), "this board").size_mm;
  const Eigen::Vector2d free_mm = page.size_mm - SizeMm(drawing) - Eigen::Vector2d(0, kFootMm);
  Place(drawing, free_mm / 2, page);
  AddFoot(caption, page);
  return page;
}

std::vector<PrintPage> TagSheets(const std::string& family, const std::vector<int>& ids, double size_m,
                                 const Paper& paper) {
  if (ids.empty()) return {};
  const BoardDrawing first = DrawSingleTag(family, ids.front(), size_m);
  constexpr double kLabelWidthMm = 32;
  // The tag also needs a white margin where another one or the label follows.
  const Eigen::Vector2d cell_mm(std::max(SizeMm(first).x(), kLabelWidthMm), SizeMm(first).y() + kLabelMm);
  const Eigen::Vector2d rims_mm(2 * kRimMm, 2 * kRimMm + kFootMm);
  const Paper fitting = ExpectFit(paper, cell_mm + rims_mm, "a tag of this size");
  const auto count = [&](const Eigen::Vector2d& size_mm) {
    return ((size_mm - rims_mm).array() / cell_mm.array() + 1e-6).floor().cast<int>().eval();
  };
  // Takes the orientation of the paper that holds more.
  Eigen::Vector2d size_mm = fitting.size_mm;
  if (count(size_mm.reverse()).prod() > count(size_mm).prod()) size_mm = size_mm.reverse().eval();
  const Eigen::Array2i grid = count(size_mm);
  const Eigen::Vector2d gap_mm =
      ((size_mm - rims_mm).array() - cell_mm.array() * grid.cast<double>()) / grid.cast<double>();
  std::vector<PrintPage> pages;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const int place = static_cast<int>(i) % grid.prod();
    if (place == 0) {
      pages.push_back({size_mm, {}, {}, {}});
      AddFoot(fmt::format("luxfit room tags: {}, {} {:g} mm (size_m = {:g})", family, TagSquareWords(family),
                          kMmPerM * size_m, size_m),
              pages.back());
    }
    const Eigen::Vector2d at_mm =
        Eigen::Vector2d::Constant(kRimMm) +
        (Eigen::Array2d(place % grid.x(), place / grid.x()) * (cell_mm + gap_mm).array()).matrix() +
        gap_mm / 2;
    PlaceTag(family, ids[i], size_m, at_mm, pages.back());
  }
  return pages;
}

}  // namespace luxfit
