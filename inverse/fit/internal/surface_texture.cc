#include "inverse/fit/internal/surface_texture.h"

#include <fmt/format.h>

#include <string>

namespace luxfit {

bool IsTextured(const LuminaireFit& fit) {
  return fit.material_texture_sigma.size() > 0 && fit.material_texture_sigma.maxCoeff() >= kTextured;
}

LightData WithoutTexture(const Room& room, LightData data, const LuminaireFit& fit,
                         const std::vector<ParameterPrior>& priors) {
  if (!IsTextured(fit)) return data;
  FitLuminairesOptions options;  // one step, for the texture of all elements
  options.covariance = false;
  options.start_is_near = true;
  options.initial_relative_sigma = fit.relative_sigma;
  options.max_outer_iterations = 1;
  const LuminaireFit all = FitLuminaires(room, data, fit.state, priors, options);
  for (size_t i = 0; i < data.observations.size() && all.texture.size() > 0; ++i) {
    Observation& o = data.observations[i];
    if (all.material_texture_sigma[room.patches.PatchOf(o.element).material] < kTextured) continue;
    const double factor = 1 / (1 + all.texture[static_cast<Eigen::Index>(i)]);
    o.relative_luminance *= factor;
    o.relative_ambient *= factor;
    o.relative_rgb *= factor;
    o.variance *= factor * factor;
  }
  return data;
}

void RecordTexture(const Room& room, const LuminaireFit& fit, Findings& findings) {
  std::string textured;
  for (Eigen::Index m = 0; m < fit.material_texture_sigma.size(); ++m) {
    const double sigma = fit.material_texture_sigma[m];
    if (sigma < kTextured) continue;
    textured += fmt::format("{}{} {:.0f} %", textured.empty() ? "" : ", ",
                            room.scene.materials[static_cast<size_t>(m)], 100 * sigma);
  }
  if (fit.material_texture_sigma.size() == 0) return;
  findings.choices.push_back(
      {"texture of surfaces",
       textured.empty() ? "none" : textured,
       {"none", "a reflectance for each element"},
       textured.empty()
           ? fmt::format("no material's elements vary by {:.0f} % in all states alike", 100 * kTextured)
           : "elements depart from their material's mean in all states alike, by so much (1 sigma)"});
}

}  // namespace luxfit
