#include "inverse/model/internal/measured_indirect.h"

#include <map>
#include <numeric>
#include <utility>

#include "inverse/model/internal/superposed_light.h"

namespace luxfit {
namespace {

constexpr float kPi = 3.14159265F;

struct AreaMean {
  double sum = 0, weight = 0;
  void Add(double value, double w) { sum += w * value, weight += w; }
  float value() const { return static_cast<float>(sum / weight); }
};

// Returns patches x states from the observed elements. An unseen patch takes its facet's, material's or all's
// mean.
Eigen::MatrixXf PatchLuminance(const Room& room, const LightData& data) {
  const auto states = static_cast<Eigen::Index>(data.dimming.size());
  const auto patches = static_cast<Eigen::Index>(room.patches.patches.size());
  std::map<std::pair<int, int>, AreaMean> of_facet, of_material, of_patch;
  std::vector<AreaMean> of_all(data.dimming.size());
  const auto add = [&](int index, int state, double relative_luminance) {
    const Element& element = room.patches.elements[static_cast<size_t>(index)];
    const Patch& patch = room.patches.patches[static_cast<size_t>(element.patch)];
    if (element.area_m2 <= 0) return;
    for (AreaMean* mean : {&of_patch[{element.patch, state}], &of_facet[{patch.facet, state}],
                           &of_material[{patch.material, state}], &of_all[static_cast<size_t>(state)]})
      mean->Add(relative_luminance, element.area_m2);
  };
  for (const Observation& o : data.observations) add(o.element, o.state, o.relative_luminance);
  // The brightest part of a surface reflects most, and is what a photo overexposes.
  for (const SuperposedLight& light : SuperposeStates(data))
    add(light.element, light.state, light.relative_luminance);
  Eigen::MatrixXf luminance = Eigen::MatrixXf::Zero(patches, states);
  for (int p = 0; p < static_cast<int>(patches); ++p) {
    const Patch& patch = room.patches.patches[static_cast<size_t>(p)];
    for (int s = 0; s < static_cast<int>(states); ++s) {
      const AreaMean& all = of_all[static_cast<size_t>(s)];
      if (all.weight == 0) continue;  // no photo shows this state
      const AreaMean* nearest = &all;
      if (const auto found = of_material.find({patch.material, s}); found != of_material.end())
        nearest = &found->second;
      if (const auto found = of_facet.find({patch.facet, s}); found != of_facet.end())
        nearest = &found->second;
      if (const auto found = of_patch.find({p, s}); found != of_patch.end()) nearest = &found->second;
      luminance(p, s) = nearest->value();
    }
  }
  return luminance;
}

// Returns elements x states, for white elements.
Eigen::MatrixXf ModelledIndirect(const Room& room, const LightData& data, const LightState& light) {
  std::vector<int> elements(room.patches.elements.size());
  std::iota(elements.begin(), elements.end(), 0);
  const Receivers receivers = MakeReceivers(room, elements, {});
  const Illuminance lit =
      ComputeIlluminance(room, receivers, ComputeVisibility(room, receivers, light.luminaires, 2),
                         light.luminaires, light.albedo);
  return (static_cast<float>(light.camera_scale) / kPi) *
         ((lit.total - lit.direct) * LumensByState(data, light.luminaires));
}

LightData WithIndirect(const LightData& data, const Eigen::MatrixXf& at_elements) {
  LightData with = data;
  with.readings.clear();
  with.indirect_is_held = true;
  for (Observation& o : with.observations)
    o.relative_indirect = static_cast<double>(at_elements(o.element, o.state));
  return with;
}

}  // namespace

LightData WithMeasuredIndirect(const Room& room, const LightData& data) {
  return WithIndirect(data, IndirectAtElements(room, PatchLuminance(room, data)));
}

LightData WithModelledIndirect(const Room& room, const LightData& data, const LightState& light) {
  return WithIndirect(data, ModelledIndirect(room, data, light));
}

}  // namespace luxfit
