// Predicts each row of a converged fit by the data of the other folds.
//
//   theta_f = theta - (H - H_f)^-1 (g - g_f),   g = J^T W r + priors,   H = J^T W J + priors
//
// theta_f is the Gauss-Newton step from the fit to all rows towards the fit without fold f, which is exact
// for a linear model. A step that does not lower the squares of the other folds is halved. Where it gains much
// less than a linear model would, further steps follow. The prediction is the model itself at theta_f.
// Weights, texture, model error and visibility are those of the whole fit. Errors of poses count view by view.
//
// Source: Stone (1974), "Cross-validatory choice and assessment of statistical predictions"; Giordano et al.
// (2019), "A Swiss army infinitesimal jackknife" (the step in place of a refit).
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_CROSS_VALIDATION_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_CROSS_VALIDATION_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/model/fit_luminaires.h"

namespace luxfit {

struct LeftOutPrediction {
  Eigen::VectorXd value;          // each row, by the data of the other folds
  std::vector<bool> is_smooth;    // rows that no shadow edge crosses
  double relative_sigma = 1;      // model error of the fit
  Eigen::VectorXd texture_sigma;  // by material (inverse/model/internal/weights/element_texture.h)
};

// `fold_of_row`: the fold of every row of the light model, from 0.
LeftOutPrediction PredictLeftOut(const Room& room, const LightData& data, const LuminaireFit& fit,
                                 const std::vector<ParameterPrior>& priors,
                                 const std::vector<int>& fold_of_row);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_CROSS_VALIDATION_H_
