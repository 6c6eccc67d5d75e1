// Collects the data that judge the model of one luminaire, or of a type, and scores models by cross-validation.
//
// The data are cut into five folds of whole blocks of neighbouring places (inverse/select/internal/
// spatial_blocks.h): patches, or readings where there are no photos. Each model is fitted to all data until
// it converges. Each fold is then predicted by the other four (inverse/model/internal/cross_validation.h).
//
// The score is the sum of min(z^2, 9) over all rows, z the residual over its own sigma and one common model
// error: the smallest of the models compared. What an element's rows share by its texture is whitened. Rows that a shadow edge crosses in any of these models count
// for none, because no fit uses them; a model that would leave few rows in that way has no say in it. Differences of two models are paired block by block, because
// residuals of neighbours are not independent. A few facets would be too few groups: what one wall of six tells alone lies one
// standard error from nothing, however sure it is.
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_LEFT_OUT_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_LEFT_OUT_H_

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "inverse/model/fit_luminaires.h"
#include "inverse/model/internal/cross_validation.h"
#include "inverse/select/one_standard_error.h"

namespace luxfit {

// Leaves out one patch in every five in a row, where a fixed state is judged and nothing is fitted again.
inline bool IsLeftOut(int patch) { return patch % 5 == 2; }

// Holds the problem of one luminaire, or of several of a type: the data that concern them, cut into folds.
struct SubProblem {
  LightState state;
  int luminaire = 0;            // its index in `state`; the first of several
  std::vector<int> members{0};  // of the type, by index in `state`
  LightData data;
  std::vector<int> group_of_row;  // block of places, or view of an outline
  std::vector<int> fold_of_row;
  std::vector<int> element_of_row, material_of_row;  // of photos' rows, which come first
  std::vector<double> value;                         // measured
  std::vector<double> variance;                      // without model error
  std::vector<ParameterPrior> priors;

  // Returns whether there are data to leave out.
  bool CanJudge() const;
};

// Returns the problem over the states where no other luminaires are on. Where there are none, it takes all
// states and holds the others: with photos whose indirect light is held, as light that is known (held_luminaires.h), so that
// its state has the members alone. Several luminaires are of one type: LightState::first_of_type ties them. Scales are
// held. With photos and measured indirect light,
// reflectances are fitted beside the luminaire, so that they carry no other model's errors; otherwise they
// are held. Of the observed elements, at most `max_elements` are taken evenly.
SubProblem MakeSubProblem(const Room& room, const LightData& data, const LightState& start,
                          const std::vector<int>& luminaires, const std::vector<ParameterPrior>& priors,
                          int max_elements = 2500);

// Returns those of the priors that concern the problem of these luminaires, by its own indices.
std::vector<ParameterPrior> PriorsOfProblem(const SubProblem& problem, const std::vector<int>& luminaires,
                                            const std::vector<ParameterPrior>& priors);

// Returns all of the data, cut likewise. The caller sets state, luminaire and priors.
SubProblem CutAll(const Room& room, const LightData& data, int max_elements);

// Holds one model fitted to the data of a problem.
struct FittedModel {
  Luminaire luminaire;
  std::vector<Luminaire> members;  // `luminaire` and the others of its type, as SubProblem::members
  FreeQuantities free;
  LeftOutPrediction left_out;
  double effective_parts = 0;  // for its table or emission
};

struct FitEffort {
  int max_outer_iterations = 8;  // models are compared where they have converged
  int max_inner_iterations = 8;
};

// `start`: the model of all members; its place and flux are those of the first.
FittedModel FitModel(const Room& room, const SubProblem& problem, const Luminaire& start,
                     const FreeQuantities& free, const FitEffort& effort = {});

// Returns what a state predicts of the left-out data of a problem, fitted as it is: luminaires need not be of
// one type.
FittedModel FitState(const Room& room, const SubProblem& problem, const LightState& start,
                     const FitEffort& effort = {});

// Returns which models leave at least half as many of the photos' rows smooth as the one of them that leaves most. Others
// have moved the luminaire to where most places see it in part, a corner or the inside of a surface, and explain little.
std::vector<bool> LeaveMostRowsSmooth(const SubProblem& problem,
                                      const std::vector<const LeftOutPrediction*>& models);

// Returns the scores of models by group, one for each model, over the same rows and with one model error: those of the
// models that leave most rows smooth.
std::vector<GroupScores> ScoreTogether(const SubProblem& problem,
                                       const std::vector<const LeftOutPrediction*>& models);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_LEFT_OUT_H_
