// Determines whether readings alone tell direct light from light that the walls reflect.
//
//   share = sum_i D_i / sum_i E_i        D: direct part of reading i, E: all of it, over the readings fitted
//
// Reflectances that no photo shows explain the same readings as the lobe and size of a luminaire do. Where
// the walls are far from the readings, a wider lobe is as good as brighter walls. The function finds the
// interval of shares that the readings admit.
//
// Every open distribution and shape is fitted with the reflectances free. A candidate is admissible where its
// mean squared normalised residual is within one standard error of the best one's. It is also admissible
// where its rms residual is within 15 % of the best: model errors of that kind cannot be told apart. The
// interval covers each admissible candidate's share +- 1.96 sigma.
//
// The sigma of a share comes from the cluster-robust covariance, because neighbouring residuals share their
// model error. The clusters are blocks of a state's readings, in a grid of 4 cells along each side of their
// box. The share is determined where the interval reaches no farther than a tenth of it to either side.
//
// Sources: own; Cameron and Miller (2015) (clusters); Marschner (1998), "Inverse Rendering for Computer
// Graphics", ch. 6 (the ambiguity).
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_PROFILE_DIRECT_SHARE_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_PROFILE_DIRECT_SHARE_H_

#include <vector>

#include "inverse/choose/direct_share.h"
#include "inverse/choose/internal/choose_model.h"
#include "inverse/model/fit_luminaires.h"

namespace luxfit {

// `fit`: a fit to readings with free reflectances. `open`: as for ChooseLuminaireModels.
DirectShare ProfileDirectShare(const Room& room, const LightData& data, const LuminaireFit& fit,
                               const std::vector<OpenChoice>& open,
                               const std::vector<ParameterPrior>& priors);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_PROFILE_DIRECT_SHARE_H_
