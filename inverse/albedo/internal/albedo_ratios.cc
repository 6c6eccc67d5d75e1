#include "inverse/albedo/internal/albedo_ratios.h"

#include <cmath>
#include <numeric>
#include <stdexcept>

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

// Returns the exitance of every element in every state, in lm/m2: measured, else modelled.
Eigen::MatrixXf ElementExitance(const Room& room, const LightData& data, const LightState& state,
                                const Eigen::MatrixXf& total_lx) {
  Eigen::MatrixXf exitance = total_lx;
  for (Eigen::Index e = 0; e < exitance.rows(); ++e) {
    const Patch& patch = room.patches.PatchOf(static_cast<int>(e));
    exitance.row(e) *= static_cast<float>(state.albedo[patch.material]);
  }
  for (const Observation& o : data.observations)
    exitance(o.element, o.state) = static_cast<float>(M_PI * o.relative_luminance / state.camera_scale);
  return exitance;
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

}  // namespace

std::vector<AlbedoRatio> AlbedoRatios(const Room& room, const LightData& data, const LightState& light,
                                      bool interreflection) {
  if (room.sparse ||
      room.form_factors.element_to_patch.rows() != static_cast<Eigen::Index>(room.patches.elements.size()))
    throw std::invalid_argument("EstimatePatchAlbedo: expected a room with dense form factors");
  if (light.albedo.size() != static_cast<Eigen::Index>(room.scene.materials.size()))
    throw std::invalid_argument("EstimatePatchAlbedo: expected one albedo a material");
  const ElementLight at = LightOfElements(room, light);
  const Eigen::MatrixXf lumens = LumensByState(data, light.luminaires);
  Eigen::MatrixXf incident_lx = at.light.direct * lumens;
  if (interreflection) {
    const Eigen::MatrixXf exitance = ElementExitance(room, data, light, at.light.total * lumens);
    incident_lx += Product(room.form_factors.element_to_patch, PatchMean(room.patches, exitance));
  }
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

}  // namespace luxfit
