// Estimates luminaires and albedo from observed luminance and luxmeter readings by the radiosity model.
//
//   min over theta  sum_i w_i (model_i(theta) - data_i)^2 / (s_i^2 + (f data_i)^2) + priors
//
// Levenberg-Marquardt (Ceres) solves it within bounds. An outer loop refreshes what a solve holds:
// - the luminaires' visibility;
// - the robust weights w (Cauchy at robust_sigmas);
// - the model error f, a relative error common to all observations, estimated from the residuals' median
//   absolute deviation.
// Rows that a shadow edge crosses are left out: their dependence on position is not smooth.
//
// A fit with a covariance does two things more:
// - Photos' rows share errors, so they know less than their number says. Where readings, outlines or priors
//   stand beside them, the design effect multiplies the variance of the photos' rows, and the fit is repeated.
// - The error by the size of elements and patches is subtracted, by one Gauss-Newton step at the end
//   (inverse/model/internal/discretisation_bias.h).
//
// Covariance: residuals of neighbouring elements share their model error, so they are not independent. The
// estimate is cluster-robust ("sandwich"), with one cluster for each facet and state, or for each facet, whichever
// gives the larger variance. Each cluster is judged by a fit without it. Few clusters enlarge sigma as Student's t does: 1.96 sigma is the 95 % interval
// (inverse/model/internal/fit_covariance.h).
// - It contains noise, errors that differ between facets or states (model, poses, mesh, reflectance of a facet),
//   and the readings', outlines' and priors' sigmas. It also contains a third of the error by the size of
//   elements and patches.
// - It does not contain a model error that is the same everywhere.
//
// A direction of parameters that the data leave undetermined (singular value below 1e-5 of the largest, after
// scaling) has no covariance. It is listed in `undetermined` and described in `null_directions`, and the
// status is kUndetermined.
//
// Sources: Triggs et al. (2000), sec. 4 (IRLS, LM); Kish (1965), "Survey sampling" (design effect).
#ifndef LUXFIT_INVERSE_MODEL_FIT_LUMINAIRES_H_
#define LUXFIT_INVERSE_MODEL_FIT_LUMINAIRES_H_

#include <Eigen/Core>
#include <functional>
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

struct FitLuminairesOptions {
  int max_outer_iterations = 12;
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
  // Design effect of the photos' rows; 0: estimated by a fit with a covariance.
  double photo_design_effect = 0;
  // Set it where the start came from a fit to a part of the same data. relative_sigma then begins at
  // initial_relative_sigma, steps need no damping, and one round that moves nothing is enough.
  bool start_is_near = false;
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
  Eigen::VectorXd root_weight;                 // sqrt(weight) / sigma of every row
  Eigen::VectorXd reading_direct_lx;
  Eigen::VectorXd reading_sigma_lx;  // sigma of the predicted readings
  double relative_sigma = 0;         // f
  // The part of f that rows of one facet and state share: f times the root of their intra-class correlation.
  // Texture and noise of single elements are the rest, and no error of the light elsewhere. f for readings.
  double shared_relative_sigma = 0;
  double photo_design_effect = 1;  // by which the variance of photos' rows was multiplied
  double effective_parts = 0;      // effective number, for tables and uneven emission; needs covariance
  int outer_iterations = 0;
  bool IsUsable() const { return status == FitStatus::kConverged || status == FitStatus::kNotConverged; }
};

LuminaireFit FitLuminaires(const Room& room, const LightData& data, const LightState& start,
                           const std::vector<ParameterPrior>& priors = {},
                           const FitLuminairesOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_FIT_LUMINAIRES_H_
