// What one luminaire's model is judged by: the data that speak of it, a fifth of them left out.
//
// Left out are every fifth patch, or reading where there are no photos. Scored is the sum of min(z^2, 9) over
// the rows left out, z the residual over its own sigma and one common model error; differences of two models
// are paired, group by group (facets, or readings), because residuals of one facet are no independent
// evidence.
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_LEFT_OUT_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_LEFT_OUT_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/model/fit_luminaires.h"
#include "inverse/select/group_scores.h"

namespace luxfit {

// One luminaire's own problem: the data that speak of it, cut into what is fitted and what is left out.
struct SubProblem {
  LightState state;
  int luminaire = 0;  // its index in `state`
  LightData all, fit;
  std::vector<int> group_of_row;  // of `all`: facet, or reading
  std::vector<bool> left_out;     // of `all`
  std::vector<double> value;      // of `all`, as measured
  std::vector<double>
      variance;  // of `all`, without the model's error; 0 for readings, whose scatter is the model's
  std::vector<ParameterPrior> priors;
};

// The states where the luminaire is on alone; where there are none, all, with the other luminaires held.
// Reflectances and scales are held.
SubProblem MakeSubProblem(const Room& room, const LightData& data, const LightState& start, int luminaire,
                          const std::vector<ParameterPrior>& priors, int max_elements);

// All of the data, cut likewise; state, luminaire and priors are left to the caller.
SubProblem CutAll(const Room& room, const LightData& data, int max_elements);

// One model fitted to what is not left out.
struct FittedModel {
  Luminaire luminaire;
  FreeQuantities free;
  Eigen::VectorXd predicted;  // rows of SubProblem::all
  double relative_sigma = 1;
  double effective_parts = 0;  // of its table or emission
};

struct FitEffort {
  int max_outer_iterations = 2;
  int max_inner_iterations = 8;
};

FittedModel FitModel(const Room& room, const SubProblem& problem, const Luminaire& start,
                     const FreeQuantities& free, const FitEffort& effort);

// `predicted`: rows of SubProblem::all. By group.
GroupScores ScoreGroups(const SubProblem& problem, const Eigen::VectorXd& predicted, double relative_sigma);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_LEFT_OUT_H_
