// Paper by name or size.
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

// A0 to A5, letter, legal, tabloid (upright), or WIDTHxHEIGHT in mm.
Paper PaperFrom(const std::string& text);

// The paper, turned if need be, so that `needed_mm` fits; upright where both do; nothing where neither does.
std::optional<Paper> Fitting(const Paper& paper, const Eigen::Vector2d& needed_mm);

// The smallest named paper on which `needed_mm` fits, "" for none.
std::string SmallestPaperFor(const Eigen::Vector2d& needed_mm);

}  // namespace luxfit

#endif  // LUXFIT_APPS_PRINT_PAPER_H_
