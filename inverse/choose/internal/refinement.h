// Describes what may be refined in a luminaire beyond its simple model, and the outcome.
//
// inverse/choose/internal/refine_luminaire.h explains the method.
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_REFINEMENT_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_REFINEMENT_H_

#include <string>
#include <vector>

namespace luxfit {

enum class RefinementKind { kHeading, kAim, kTable, kEmission };

struct OpenRefinements {
  bool heading = false;
  bool aim = false;
  bool table = false;
  bool emission = false;
  bool table_asked_for = false;  // true: estimates a table whatever the criterion says
};

struct Refinement {
  int luminaire = 0;
  RefinementKind kind = RefinementKind::kTable;
  std::vector<std::string> among;            // the first is the luminaire as it was (except for headings)
  std::vector<double> score;                 // mean of min(z^2, 9) on data left out
  std::vector<double> effective_parameters;  // for table or emission
  double standard_error = 0;                 // standard error of the best one's difference from the first
  int chosen = 0;
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_REFINEMENT_H_
