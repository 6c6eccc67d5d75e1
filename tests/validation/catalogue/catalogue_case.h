// Lists ways in which a session fails in real life: each the shipped office with one thing wrong, and what is required of
// `luxfit run` then.
//
//   kSolved    right, exit 0
//   kNamed     a warning, or the error of a session that is refused, names the cause
//   kRefused   exit 2, and the error names the cause
//
// Never a wrong result without a word. Sources of the cases: docs/stability.md.
#ifndef LUXFIT_TESTS_VALIDATION_CATALOGUE_CATALOGUE_CASE_H_
#define LUXFIT_TESTS_VALIDATION_CATALOGUE_CATALOGUE_CASE_H_

#include <functional>
#include <string>
#include <vector>

#include "tests/support/apps/office_copy.h"

namespace luxfit {

enum class Required { kSolved, kNamed, kRefused };

struct CatalogueCase {
  std::string group, name;
  Required required;
  std::vector<std::string> causes;  // codes of warnings, or words of the error, each of which names the cause
  std::function<void(const support::OfficeCopy&)> make;
  std::string daylight = {};  // luminaire whose light stands in for daylight, and is not sought
};

std::vector<CatalogueCase> RegistrationCases();
std::vector<CatalogueCase> PhotometryCases();
std::vector<CatalogueCase> LuminaireCases();
std::vector<CatalogueCase> GeometryCases();
std::vector<CatalogueCase> LuxmeterCases();

}  // namespace luxfit

#endif  // LUXFIT_TESTS_VALIDATION_CATALOGUE_CATALOGUE_CASE_H_
