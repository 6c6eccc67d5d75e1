#include "apps/print/paper.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "apps/text/suggest.h"

namespace luxfit {
namespace {

struct NamedSize {
  const char* name;
  double width_mm, height_mm;
};
// Sizes of ISO 216 and ANSI/ASME Y14.1, smallest first.
constexpr std::array<NamedSize, 9> kSizes = {{{"A5", 148, 210},
                                              {"A4", 210, 297},
                                              {"letter", 215.9, 279.4},
                                              {"legal", 215.9, 355.6},
                                              {"tabloid", 279.4, 431.8},
                                              {"A3", 297, 420},
                                              {"A2", 420, 594},
                                              {"A1", 594, 841},
                                              {"A0", 841, 1189}}};
constexpr double kLargestMm = 5000;

Paper Named(const std::string& name, double width_mm, double height_mm) {
  return {fmt::format("{} ({:g} x {:g} mm)", name, width_mm, height_mm), {width_mm, height_mm}};
}

bool FitsOn(const Eigen::Vector2d& paper_mm, const Eigen::Vector2d& needed_mm) {
  return (needed_mm.array() <= paper_mm.array() + 1e-6).all();
}

}  // namespace

Paper PaperFrom(const std::string& text) {
  for (const NamedSize& size : kSizes) {
    if (Lowercase(text) == Lowercase(size.name)) return Named(size.name, size.width_mm, size.height_mm);
  }
  double width_mm = 0, height_mm = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%lfx%lf%c", &width_mm, &height_mm, &rest) == 2 && width_mm > 0 &&
      height_mm > 0 && width_mm <= kLargestMm && height_mm <= kLargestMm)
    return Named("custom", width_mm, height_mm);
  std::vector<std::string> names;
  names.reserve(kSizes.size());
  for (const NamedSize& size : kSizes) names.emplace_back(size.name);
  throw std::runtime_error("--paper: " + ExpectedOneOf(names, text) + ", or a size in mm: 500x700");
}

std::optional<Paper> Fitting(const Paper& paper, const Eigen::Vector2d& needed_mm) {
  if (FitsOn(paper.size_mm, needed_mm)) return paper;
  Paper turned = paper;
  turned.size_mm = paper.size_mm.reverse();
  if (FitsOn(turned.size_mm, needed_mm)) return turned;
  return std::nullopt;
}

std::string SmallestPaperFor(const Eigen::Vector2d& needed_mm) {
  for (const NamedSize& size : kSizes) {
    const Paper paper = Named(size.name, size.width_mm, size.height_mm);
    if (Fitting(paper, needed_mm)) return paper.name;
  }
  return "";
}

}  // namespace luxfit
