// Finds paper by name or size.
//
// Throws std::runtime_error("--paper: expected ..., got ...").
#ifndef LUXFIT_APPS_PRINT_PAPER_H_
#define LUXFIT_APPS_PRINT_PAPER_H_

#include <Eigen/Core>
#include <optional>
#include <string>

namespace luxfit {

struct Paper {
  std::string name;  // "A4 (210 x 297 mm)"
  Eigen::Vector2d size_mm;
};

// Reads A0 to A5, letter, legal, tabloid (upright), or WIDTHxHEIGHT in mm.
Paper PaperFrom(const std::string& text);

// Returns the paper, turned if necessary, so that `needed_mm` fits: upright where both orientations fit,
// nothing where neither does.
std::optional<Paper> Fitting(const Paper& paper, const Eigen::Vector2d& needed_mm);

// Returns the smallest named paper on which `needed_mm` fits, "" where none is large enough.
std::string SmallestPaperFor(const Eigen::Vector2d& needed_mm);

}  // namespace luxfit

#endif  // LUXFIT_APPS_PRINT_PAPER_H_
