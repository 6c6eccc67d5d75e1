#include "inverse/choose/internal/detail/choose_colour.h"

#include <utility>

#include "inverse/model/internal/intervals/parameter_shift.h"

namespace luxfit {
namespace {

constexpr double kGreyTint = 0.01;  // a smaller one is the noise of its estimate

// Returns no tints where all surfaces are grey.
Eigen::Matrix3Xd TintOf(const Eigen::Vector3d& luminance_weights, const Eigen::Matrix3Xd& rgb) {
  Eigen::Matrix3Xd tint = Eigen::Matrix3Xd::Ones(3, rgb.cols());
  for (Eigen::Index m = 0; m < rgb.cols(); ++m) {
    const double mean = luminance_weights.dot(rgb.col(m));
    if (mean > 0) tint.col(m) = rgb.col(m).cwiseMax(0) / mean;
  }
  if ((tint.array() - 1).abs().maxCoeff() < kGreyTint) return {};
  return tint;
}

}  // namespace

ColourChoice ChooseColour(const Room& room, const LightData& data, const LuminaireFit& fit,
                          const Eigen::Matrix3Xd& albedo_rgb, const std::vector<ParameterPrior>& priors) {
  ColourChoice choice{fit};
  if (data.observations.empty() || room.sparse || !fit.IsUsable() || fit.covariance.size() == 0)
    return choice;
  LightState state = fit.state;
  state.tint = TintOf(data.luminance_weights, albedo_rgb);
  if (state.tint.size() == 0) return choice;
  FitLuminairesOptions options;
  options.covariance = false;
  options.start_is_near = options.steps_by_direct_light = true;
  options.frozen = fit.frozen;
  options.photo_design_effect = fit.photo_design_effect;
  options.initial_relative_sigma = fit.relative_sigma;
  options.has_texture = fit.material_texture_sigma.sum() > 0;  // as in `fit`
  LuminaireFit coloured = FitLuminaires(room, data, state, priors, options);
  if (!coloured.IsUsable()) return choice;
  choice.is_compared = true;
  // Tilts and headings count from where the luminaires of `fit` point.
  const Eigen::VectorXd moved =
      PackParameters(coloured.state, fit.parameters) - PackParameters(fit.state, fit.parameters);
  const LargestShift largest = LargestShiftOf(fit, moved);
  choice.effect_sigmas = largest.sigmas;
  choice.moved_most = largest.parameter;
  choice.is_used = choice.effect_sigmas > kWorthSigmas;
  if (choice.is_used) choice.fit = std::move(coloured);
  return choice;
}

}  // namespace luxfit
