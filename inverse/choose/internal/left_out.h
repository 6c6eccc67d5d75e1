// Collects the data that judge one luminaire's model, with a fifth left out, and scores models on that fifth.
//
// Every fifth patch is left out, or every fifth reading where there are no photos. The score is the sum of
// min(z^2, 9) over the rows left out, z the residual over its own sigma and one common model error.
// Differences of two models are paired group by group (facets, or readings), because residuals of one facet
// are not independent.
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_LEFT_OUT_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_LEFT_OUT_H_

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "inverse/model/fit_luminaires.h"
#include "inverse/select/one_standard_error.h"

namespace luxfit {

// Leaves out one group in every five in a row, so that every part of the room keeps most of its data.
inline bool IsLeftOut(int group) { return group % 5 == 2; }

// Holds one luminaire's own problem: the data that concern it, cut into a fitted and a left-out part.
struct SubProblem {
  LightState state;
  int luminaire = 0;  // its index in `state`
  LightData all, fit;
  std::vector<int> group_of_row;  // rows of `all`: facet, or reading
  std::vector<bool> left_out;     // rows of `all`
  std::vector<double> value;      // rows of `all`, measured
  std::vector<double>
      variance;  // rows of `all`, without model error; 0 for readings: the model error is their scatter
  std::vector<ParameterPrior> priors;

  // Returns whether anything is left out that can judge a model.
  bool CanJudge() const { return std::find(left_out.begin(), left_out.end(), true) != left_out.end(); }
};

// Returns the problem over the states where the luminaire is on alone. Where there are none, it takes all
// states and holds the other luminaires. Reflectances and scales are held. Of the observed elements, at most
// `max_elements` are taken evenly.
SubProblem MakeSubProblem(const Room& room, const LightData& data, const LightState& start, int luminaire,
                          const std::vector<ParameterPrior>& priors, int max_elements = 2500);

// Returns all of the data, cut likewise. The caller sets state, luminaire and priors.
SubProblem CutAll(const Room& room, const LightData& data, int max_elements);

// Holds one model fitted to the data that are not left out.
struct FittedModel {
  Luminaire luminaire;
  FreeQuantities free;
  Eigen::VectorXd predicted;  // rows of SubProblem::all
  double relative_sigma = 1;
  double effective_parts = 0;  // for its table or emission
};

struct FitEffort {
  int max_outer_iterations = 2;  // from a converged start: visibility and weights are refreshed once
  int max_inner_iterations = 8;
};

FittedModel FitModel(const Room& room, const SubProblem& problem, const Luminaire& start,
                     const FreeQuantities& free, const FitEffort& effort = {});

// Returns the scores by group. `predicted`: rows of SubProblem::all.
GroupScores ScoreGroups(const SubProblem& problem, const Eigen::VectorXd& predicted, double relative_sigma);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_LEFT_OUT_H_
