#include "inverse/albedo/internal/reflectance_sigma.h"

#include "inverse/model/fit_uncertainty.h"

namespace luxfit {

Eigen::VectorXd SigmaOfReflectances(const Room& room, const LuminaireFit& fit) {
  const FitUncertainty uncertainty = UncertaintyOf(fit);
  Eigen::VectorXd relative = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(room.scene.materials.size()));
  for (Eigen::Index m = 0; m < relative.size(); ++m) {
    const double sigma =
        uncertainty.Sigma({ParameterKind::kAlbedo, room.scene.materials[static_cast<size_t>(m)]});
    if (sigma > 0) relative[m] = sigma / fit.state.albedo[m];
  }
  return relative;
}

}  // namespace luxfit
