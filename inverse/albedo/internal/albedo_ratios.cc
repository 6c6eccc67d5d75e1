#include "inverse/albedo/internal/albedo_ratios.h"

#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "forward/factors/form_factors.h"

namespace luxfit {
namespace {

// Share of a state's light at a place below which a luminaire's shadow edge does not exclude the place.
constexpr double kLeastShare = 0.02;

// Holds the light at every element, elements x luminaires in lx per lm, and the visible shares.
struct ElementLight {
  Illuminance light;
  Eigen::MatrixXf visible;
};

ElementLight LightOfElements(const Room& room, const LightState& state) {
  std::vector<int> elements(room.patches.elements.size());
  std::iota(elements.begin(), elements.end(), 0);
  const Receivers receivers = MakeReceivers(room, elements, {});
  LuminaireVisibility visibility = ComputeVisibility(room, receivers, state.luminaires);
  Illuminance light = ComputeIlluminance(room, receivers, visibility, state.luminaires, state.albedo);
  return {std::move(light), std::move(visibility.receivers)};
}

// Returns the exitance of every element in every state, in lm/m2: measured, else modelled. `tint`: by material, what is
// measured over luminance.
template <typename Measured>
Eigen::MatrixXf ElementExitance(const Room& room, const LightData& data, const LightState& state,
                                const Eigen::MatrixXf& total_lx, const Measured& measured,
                                const Eigen::VectorXd& tint) {
  Eigen::MatrixXf exitance = total_lx;
  for (Eigen::Index e = 0; e < exitance.rows(); ++e) {
    const Patch& patch = room.patches.PatchOf(static_cast<int>(e));
    exitance.row(e) *= static_cast<float>(state.albedo[patch.material] * tint[patch.material]);
  }
  for (const Observation& o : data.observations)
    exitance(o.element, o.state) = static_cast<float>(M_PI * measured(o) / state.camera_scale);
  return exitance;
}

double LuminanceOf(const Observation& o) { return o.relative_luminance; }

// Returns the light of a channel over luminance that photos show of each material, 1 where they show none.
template <typename Measured>
Eigen::VectorXd ShownTint(const Room& room, const LightData& data, const Measured& measured) {
  const auto materials = static_cast<Eigen::Index>(room.scene.materials.size());
  Eigen::VectorXd channel = Eigen::VectorXd::Zero(materials), luminance = channel;
  for (const Observation& o : data.observations) {
    channel[room.patches.PatchOf(o.element).material] += measured(o);
    luminance[room.patches.PatchOf(o.element).material] += LuminanceOf(o);
  }
  return (luminance.array() > 0 && channel.array() > 0).select(channel.cwiseQuotient(luminance), 1);
}

// Returns the light that reaches elements from others, elements x states.
template <typename Measured>
Eigen::MatrixXf IndirectLx(const Room& room, const LightData& data, const LightState& state,
                           const Eigen::MatrixXf& total_lx, const Measured& measured) {
  return Product(room.form_factors.element_to_patch,
                 PatchMean(room.patches, ElementExitance(room, data, state, total_lx, measured,
                                                         ShownTint(room, data, measured))));
}

bool OnShadowEdge(const ElementLight& at, const Eigen::MatrixXf& lumens, const Observation& o,
                  double total_lx) {
  for (Eigen::Index k = 0; k < lumens.rows(); ++k) {
    const float visible = at.visible(o.element, k);
    const double direct_lx = at.light.direct(o.element, k) * lumens(k, o.state);
    if (visible > 0.001F && visible < 0.999F && direct_lx > kLeastShare * total_lx) return true;
  }
  return false;
}

void ExpectDense(const Room& room, const LightState& light) {
  if (room.sparse ||
      room.form_factors.element_to_patch.rows() != static_cast<Eigen::Index>(room.patches.elements.size()))
    throw std::invalid_argument("EstimatePatchAlbedo: expected a room with dense form factors");
  if (light.albedo.size() != static_cast<Eigen::Index>(room.scene.materials.size()))
    throw std::invalid_argument("EstimatePatchAlbedo: expected one albedo a material");
}

std::vector<AlbedoRatio> RatiosTo(const Room& room, const LightData& data, const LightState& light,
                                  const ElementLight& at, const Eigen::MatrixXf& lumens,
                                  const Eigen::MatrixXf& incident_lx) {
  std::vector<AlbedoRatio> ratios;
  ratios.reserve(data.observations.size());
  for (const Observation& o : data.observations) {
    const double lx = incident_lx(o.element, o.state);
    if (!(lx > 0) || !(o.relative_luminance > 0) || OnShadowEdge(at, lumens, o, lx)) continue;
    const int patch = room.patches.elements[static_cast<size_t>(o.element)].patch;
    const Patch& p = room.patches.patches[static_cast<size_t>(patch)];
    ratios.push_back({o.element, patch, p.facet, p.material, o.state,
                      M_PI * o.relative_luminance / (light.camera_scale * lx),
                      std::sqrt(o.variance) / o.relative_luminance});
  }
  return ratios;
}

}  // namespace

std::vector<AlbedoRatio> AlbedoRatios(const Room& room, const LightData& data, const LightState& light,
                                      bool interreflection) {
  ExpectDense(room, light);
  const ElementLight at = LightOfElements(room, light);
  const Eigen::MatrixXf lumens = LumensByState(data, light.luminaires);
  Eigen::MatrixXf incident_lx = at.light.direct * lumens;
  if (interreflection) incident_lx += IndirectLx(room, data, light, at.light.total * lumens, LuminanceOf);
  return RatiosTo(room, data, light, at, lumens, incident_lx);
}

std::vector<AlbedoRatio> ColourRatios(const Room& room, const LightData& data, const LightState& light) {
  ExpectDense(room, light);
  const ElementLight at = LightOfElements(room, light);
  const Eigen::MatrixXf lumens = LumensByState(data, light.luminaires);
  const Eigen::MatrixXf direct_lx = at.light.direct * lumens, total_lx = at.light.total * lumens;
  const auto incident_of = [&](const auto& measured) {
    return Eigen::MatrixXf(direct_lx + IndirectLx(room, data, light, total_lx, measured));
  };
  std::vector<AlbedoRatio> ratios = RatiosTo(room, data, light, at, lumens, incident_of(LuminanceOf));
  std::map<std::pair<int, int>, const Observation*> seen;
  for (const Observation& o : data.observations) seen[{o.element, o.state}] = &o;
  for (int c = 0; c < 3; ++c) {
    const Eigen::MatrixXf lx = incident_of([c](const Observation& o) { return o.relative_rgb[c]; });
    for (AlbedoRatio& ratio : ratios) {
      const double value = seen[{ratio.element, ratio.state}]->relative_rgb[c];
      ratio.rgb[c] = value > 0 ? M_PI * value / (light.camera_scale * lx(ratio.element, ratio.state)) : NAN;
    }
  }
  return ratios;
}

}  // namespace luxfit
