// What may be refined of a luminaire beyond its simple model, and what came of it
// (inverse/choose/internal/refine_luminaire.h tells how).
#ifndef LUXFIT_INVERSE_CHOOSE_REFINEMENT_H_
#define LUXFIT_INVERSE_CHOOSE_REFINEMENT_H_

#include <string>
#include <vector>

namespace luxfit {

enum class RefinementKind { kHeading, kAim, kTable, kEmission };

struct OpenRefinements {
  bool heading = false;
  bool aim = false;
  bool table = false;
  bool emission = false;
  bool table_asked_for = false;  // a table whatever the criterion says
};

struct RefineOptions {
  double good_enough = 0.01;  // model error below which table and emission are not tried
  double node_step_deg = 7.5;
  int max_outer_iterations = 3;
  int max_inner_iterations = 10;
};

struct Refinement {
  int luminaire = 0;
  RefinementKind kind = RefinementKind::kTable;
  std::vector<std::string> among;            // the first: as it was (but for headings)
  std::vector<double> score;                 // mean of min(z^2, 9) on what was left out
  std::vector<double> effective_parameters;  // of table or emission
  double standard_error = 0;                 // of the best one's difference from the first
  int chosen = 0;
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_REFINEMENT_H_
