// Refines one luminaire beyond the simple models, step by step, each step only where the data support it.
//
//   heading   of a given photometry without rotational symmetry: fitted from 0, 90, 180 and 270 degrees
//   aim       of a given photometry: as given or straight down, or free
//   table     a rotationally symmetric table of intensities over gamma, every 7.5 degrees
//             (forward/luminaire/luminaire_parts.h), smooth by second differences
//             (inverse/model/internal/part_smoothness.h) of a strength that is tried in factors of 3; with
//             the shape as it is, or as a point; to 90 degrees where the lobe ends there, and once to 180
//             where something above the luminaire was measured
//   emission  a rectangle of cells that emit unevenly, 2 x 2 to 8 x 8, until two in a row bring nothing
//
// Each candidate is fitted to the data that concern the luminaire and scored by cross-validation
// (inverse/choose/internal/left_out.h). Each step keeps the candidate with the fewest effective parameters
// within one standard error of the best. Aims and cells must gain a quarter of the score, too: they absorb what the mesh
// lacks, and predict what is left out of it. A table is one for all directions, and views of what the mesh lacks take no
// part (inverse/observe/surface_labels.h). The step is taken only if it lowers the score by more than that.
//
// Table and emission are tried only where the model error is above 1 %: a luxmeter could not show a
// smaller effect. A few steps towards one table or emission come first: where they gain less than half of what must be
// gained, the other candidates are not fitted. Tables end where a softer one is no better. All headings have as many
// parameters, so the lowest score alone chooses.
//
// Sources: Breiman, Friedman, Olshen, Stone (1984), sec. 3.4 (one-standard-error rule); Eilers and Marx
// (1996) (smoothness by differences).
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_REFINE_LUMINAIRE_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_REFINE_LUMINAIRE_H_

#include <vector>

#include "inverse/choose/internal/left_out.h"
#include "inverse/choose/internal/refinement.h"

namespace luxfit {

struct RefinedLuminaire {
  std::vector<Luminaire> members;  // as SubProblem::members
  FreeQuantities free;
  bool changed = false;
  std::vector<Refinement> steps;
};

// Refines the members of problem.state from its present model. Returns it unchanged where
// nothing could be left out.
RefinedLuminaire RefineLuminaire(const Room& room, const SubProblem& problem, const OpenRefinements& open);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_REFINE_LUMINAIRE_H_
