// Do readings alone tell light that comes straight from light that comes by the walls?
//
//   share = sum_i D_i / sum_i E_i        D: direct part of reading i, E: all of it, over the readings fitted
//
// Reflectances that no photo shows and the lobe and size of a luminaire explain the same readings: where the
// walls are far from the readings, a wider lobe is as good as brighter walls. Asked is how far the share may
// go. Every distribution and shape that is open is fitted with the reflectances free. Admissible are those
// whose mean squared normalised residual is within one standard error of the best one's, or whose rms
// residual is within 15 % of the best: a model error of that kind cannot be told from another. The interval
// covers each admissible candidate's share +- 1.96 sigma.
//
// Sigma of a share: by the cluster-robust covariance with blocks of readings as clusters (a state's readings
// in a grid of 4 cells a side of their box), because the residuals of neighbours share their model error.
// Determined: the interval reaches no further than `tolerance` of the share to either side.
//
// Source: house; Cameron and Miller (2015) (clusters); for the ambiguity, Marschner (1998), "Inverse
// Rendering for Computer Graphics", ch. 6.
#ifndef LUXFIT_INVERSE_CHOOSE_DIRECT_SHARE_H_
#define LUXFIT_INVERSE_CHOOSE_DIRECT_SHARE_H_

#include <string>
#include <vector>

#include "inverse/choose/choose_model.h"
#include "inverse/model/fit_luminaires.h"

namespace luxfit {

struct DirectShareCandidate {
  std::string name;
  double share = 0, sigma = 0;
  double rms = 0;  // of residuals over sigma, of one model error for all candidates
  bool is_admissible = false;
};

struct DirectShare {
  double share = 0;             // of the fit
  double lower = 0, upper = 1;  // 95 %
  bool is_determined = false;
  std::vector<DirectShareCandidate> candidates;  // the fit first
};

struct DirectShareOptions {
  double tolerance = 0.1;
  double start_size_m = 0.3;
};

// `fit`: of readings, with reflectances free; `open`: as for ChooseLuminaireModels.
DirectShare ProfileDirectShare(const Room& room, const LightData& data, const LuminaireFit& fit,
                               const std::vector<OpenChoice>& open, const std::vector<ParameterPrior>& priors,
                               const DirectShareOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_DIRECT_SHARE_H_
