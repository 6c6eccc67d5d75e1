// Estimates luminaires and albedo from observed luminance and luxmeter readings by the radiosity model.
//
//   min over theta  sum_i w_i (model_i(theta) - data_i)^2 / (s_i^2 + (f data_i)^2) + priors
//
// Levenberg-Marquardt (Ceres) solves it within bounds. An outer loop refreshes what a solve holds:
// - the luminaires' visibility;
// - the robust weights w (Cauchy at robust_sigmas);
// - the model error f, a relative error common to all observations, estimated from the residuals' median
//   absolute deviation;
// - the texture t of elements, which all states share and which the fit eliminates, with a variance for each
//   material (inverse/model/internal/weights/element_texture.h).
// Errors of camera poses are eliminated likewise, from the rows of outlines.
// Rows that a shadow edge or a point's horizon (internal/point_horizon.h) crosses are left out: they are not smooth.
//
// A fit with a covariance does two things more:
// - Photos' rows share errors, so they know less than their number says. Where readings, outlines or priors
//   stand beside them, the design effect multiplies the variance of the photos' rows, and the fit is repeated.
// - The error by the size of elements and patches is subtracted, by one Gauss-Newton step at the end
//   (inverse/model/internal/discretisation_bias.h).
//
// Covariance: residuals of neighbouring elements share their model error, so they are not independent. The
// estimate is cluster-robust ("sandwich"), with one cluster for each facet and state, or for each facet, whichever
// gives the larger variance. Each cluster is judged by a fit without it. Few clusters enlarge sigma as Student's
// t does: 1.96 sigma is the 95 % interval (inverse/model/internal/intervals/fit_covariance.h). A bootstrap over the same
// clusters checks it: the larger variance counts (inverse/model/internal/intervals/cluster_bootstrap.h).
// - It contains noise, errors that differ between facets or states (model, poses, mesh, reflectance of a facet),
//   and the readings', outlines' and priors' sigmas. It also contains a third of the error by the size of
//   elements and patches.
// - Where a reflectance is free that only indirect light tells, it contains what the surfaces lack of being even
//   and diffuse (inverse/model/internal/weights/indirect_error.h).
// - It does not contain a model error that is the same everywhere.
//
// A direction of parameters that the data leave undetermined (singular value below 1e-5 of the largest, after
// scaling) has no covariance. It is listed in `undetermined` and described in `null_directions`, and the
// status is kUndetermined.
//
// LightData::checkpoint is called before each round: what it throws leaves FitLuminaires.
//
// Sources: Triggs et al. (2000), sec. 4 (IRLS, LM); Kish (1965), "Survey sampling" (design effect).
#ifndef LUXFIT_INVERSE_MODEL_FIT_LUMINAIRES_H_
#define LUXFIT_INVERSE_MODEL_FIT_LUMINAIRES_H_

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "inverse/model/light_state.h"

namespace luxfit {

enum class FitStatus { kConverged, kNotConverged, kUndetermined, kNoData };

// Holds knowledge of one parameter from outside the data, in the parameter's own unit.
struct ParameterPrior {
  ParameterKind kind = ParameterKind::kLuminaire;
  int index = 0;
  LuminaireQuantity quantity = LuminaireQuantity::kPositionX;
  double mean = 0;
  double sigma = 1;
};

// Describes the fit as a round of the outer loop ends.
struct FitRound {
  int round = 0;              // of this fit, from 1
  double relative_sigma = 0;  // f: how far the model departs from the data, relative
  const LightState& state;
};

struct FitLuminairesOptions {
  int max_outer_iterations = 12;  // 0: weighs the rows at the start and moves nothing
  int max_inner_iterations = 12;
  double initial_relative_sigma =
      0.05;                          // f at the start: generous, so that a rough start is not all outliers
  double min_relative_sigma = 2e-3;  // a smaller f would trust the forward model beyond its validation
  double robust_sigmas = 3.0;
  double position_tolerance_m = 5e-4;  // the outer loop ends when nothing moves farther
  int visibility_order = 3;            // points along each side of a luminaire tested for occlusion
  bool covariance = true;
  // Whether a fit with a covariance subtracts what the size of elements and patches leaves out.
  bool subtracts_discretisation = true;
  // Whether elements may depart from their material (inverse/model/internal/weights/element_texture.h). Far from the
  // truth, what all states miss alike is the luminaires' fault.
  bool has_texture = true;
  // Design effect of the photos' rows; 0: estimated by a fit with a covariance.
  double photo_design_effect = 0;
  // Set it where the start came from a fit to a part of the same data. relative_sigma then begins at
  // initial_relative_sigma, steps need no damping, and one round that moves nothing is enough.
  bool start_is_near = false;
  // Whether the rounds' derivatives by luminaires' parameters leave out reflected light. They cost a fraction, and the
  // fit ends beside the minimum by what reflected light would change in the weight of residuals: for fits whose result
  // is a start. The covariance is exact.
  bool steps_by_direct_light = false;
  std::shared_ptr<const FrozenLight> frozen = {};      // of an earlier fit in the same room; null: none
  std::function<void(const FitRound&)> on_round = {};  // empty: no calls
};

// Holds in words a combination of parameters that the data leave undetermined.
struct NullDirection {
  std::vector<ParameterId> parameters;  // parameters that take part, the strongest first
  std::string meaning, remedy;          // a sentence each, without a full stop
};

struct LuminaireFit {
  FitStatus status = FitStatus::kNoData;
  std::string message;
  LightState state;
  std::vector<Parameter> parameters;
  Eigen::MatrixXd covariance;                  // parameters x parameters
  std::vector<ParameterId> undetermined;       // parameters in directions without information
  std::vector<NullDirection> null_directions;  // those directions, in words
  std::vector<ParameterId> at_bound;           // parameters that stopped at a bound
  Eigen::VectorXd predicted;                   // every row: observations, then readings
  Eigen::VectorXd weight;                      // robust weight of every row, 0: left out
  // Hold the target of the last equations, and their root weights (inverse/model/internal/weights/row_weights.h).
  Eigen::VectorXd target, root_weight;
  // Departure of the row's element from its material's reflectance, relative, and the sigma it was allowed; 0
  // where there is none (inverse/model/internal/weights/element_texture.h).
  Eigen::VectorXd texture, texture_sigma;
  Eigen::VectorXd material_texture_sigma;  // by material, 0: plain
  // Reflectance of patches over their material's, in the exchange of light; empty: 1.
  Eigen::VectorXd patch_factor;
  // Readings x luminaires, as dimmed in their states; empty: not predicted (inverse/fit/internal/judge/predict_readings.h).
  Eigen::MatrixXd reading_direct_lx;
  Eigen::VectorXd reading_sigma_lx;  // sigma of the predicted readings
  double relative_sigma = 0;         // f
  // The part of f that rows of one facet and state share: f times the root of their intra-class correlation.
  // Texture and noise of single elements are the rest, and no error of the light elsewhere. f for readings.
  double shared_relative_sigma = 0;
  double photo_design_effect = 1;  // by which the variance of photos' rows was multiplied
  double effective_parts = 0;      // effective number, for tables and uneven emission; needs covariance
  int outer_iterations = 0;
  std::shared_ptr<const FrozenLight> frozen;  // for a fit that starts here
  bool IsUsable() const { return status == FitStatus::kConverged || status == FitStatus::kNotConverged; }
};

LuminaireFit FitLuminaires(const Room& room, const LightData& data, const LightState& start,
                           const std::vector<ParameterPrior>& priors = {},
                           const FitLuminairesOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_FIT_LUMINAIRES_H_
