#include "inverse/model/internal/discretisation_bias.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "forward/direct/direct_light.h"
#include "forward/light/illuminance.h"

namespace luxfit {
namespace {

// Returns the element's mean less the value at its centre, per lumen of each luminaire.
Eigen::VectorXd MeanLessCentre(const Room& room, const Element& element,
                               const std::vector<Luminaire>& luminaires) {
  Eigen::VectorXd difference = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(luminaires.size()));
  const std::vector<Eigen::Vector3d> probes = ProbesOf(element, room.patches.IsTriangle(element.patch));
  for (size_t k = 0; k < luminaires.size(); ++k) {
    // Rows at a shadow's edge are left out of fits: an element sees all of a luminaire, or nothing.
    if (VisibleFraction(room.rays, luminaires[k], element.center, element.normal, 1) <= 0) continue;
    double mean = 0;
    for (const Eigen::Vector3d& probe : probes)
      mean += DirectIlluminancePerLumen(luminaires[k], probe, element.normal).lx_per_lm;
    mean /= static_cast<double>(probes.size());
    const double centre = DirectIlluminancePerLumen(luminaires[k], element.center, element.normal).lx_per_lm;
    difference[static_cast<Eigen::Index>(k)] = 4.0 / 3 * (mean - centre);
  }
  return difference;
}

// Holds evenly taken elements, ascending, and how many elements each stands for.
struct Taken {
  std::vector<int> elements;
  double each = 1;
};
Taken TakeEvenly(const std::vector<Observation>& observations, int most) {
  std::vector<int> observed;
  observed.reserve(observations.size());
  for (const Observation& o : observations) observed.push_back(o.element);
  std::sort(observed.begin(), observed.end());
  observed.erase(std::unique(observed.begin(), observed.end()), observed.end());
  const size_t count = observed.size(), wanted = std::min(count, static_cast<size_t>(std::max(1, most)));
  Taken taken;
  taken.elements.reserve(wanted);
  for (size_t i = 0; i < wanted; ++i) taken.elements.push_back(observed[i * count / wanted]);
  taken.each = wanted > 0 ? static_cast<double>(count) / static_cast<double>(wanted) : 1;
  return taken;
}

// Returns elements x luminaires, per lumen.
Eigen::MatrixXd DirectBias(const Room& room, const std::vector<int>& elements,
                           const std::vector<Luminaire>& luminaires) {
  Eigen::MatrixXd bias(static_cast<Eigen::Index>(elements.size()),
                       static_cast<Eigen::Index>(luminaires.size()));
  tbb::parallel_for(size_t{0}, elements.size(), [&](size_t i) {
    const Element& element = room.patches.elements[static_cast<size_t>(elements[i])];
    bias.row(static_cast<Eigen::Index>(i)) = MeanLessCentre(room, element, luminaires).transpose();
  });
  return bias;
}

Eigen::MatrixXd IndirectBias(const Room& room, const std::vector<int>& elements, const LightState& state) {
  constexpr int kRays = 1024, kVisibilityOrder = 2;
  std::vector<Sensor> sensors;
  sensors.reserve(elements.size());
  for (const int e : elements) {
    const Element& element = room.patches.elements[static_cast<size_t>(e)];
    sensors.push_back({element.center, element.normal, {}});
  }
  const Receivers receivers = MakeReceivers(room, elements, sensors, kRays);
  const LuminaireVisibility visibility =
      ComputeVisibility(room, receivers, state.luminaires, kVisibilityOrder);
  const Illuminance light = ComputeIlluminance(room, receivers, visibility, state.luminaires, state.albedo);
  const Eigen::MatrixXd indirect = (light.total - light.direct).cast<double>();
  const auto n = static_cast<Eigen::Index>(elements.size());
  return indirect.bottomRows(n) - indirect.topRows(n);
}

// Adds the effect of `bias` (taken elements x luminaires) to each observation.
void AddTo(const Room& room, const LightData& data, const LightState& state, const Taken& taken,
           const Eigen::MatrixXd& bias, Eigen::VectorXd& sum) {
  for (size_t i = 0; i < data.observations.size(); ++i) {
    const Observation& o = data.observations[i];
    const auto place = std::lower_bound(taken.elements.begin(), taken.elements.end(), o.element);
    if (place == taken.elements.end() || *place != o.element) continue;
    const double rho = state.albedo[room.patches.PatchOf(o.element).material];
    const Eigen::VectorXd& dimming = data.dimming[static_cast<size_t>(o.state)];
    double lx = 0;
    for (Eigen::Index k = 0; k < dimming.size(); ++k)
      lx += dimming[k] * state.luminaires[static_cast<size_t>(k)].flux_lm *
            bias(place - taken.elements.begin(), k);
    sum[static_cast<Eigen::Index>(i)] += taken.each * state.camera_scale * rho / M_PI * lx;
  }
}

}  // namespace

Eigen::VectorXd DiscretisationBias(const Room& room, const LightData& data, const LightState& state,
                                   int max_elements) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(data.observations.size()));
  const Taken direct = TakeEvenly(data.observations, max_elements);
  AddTo(room, data, state, direct, DirectBias(room, direct.elements, state.luminaires), sum);
  if (data.indirect_is_held || room.sparse) return sum;
  const Taken indirect = TakeEvenly(data.observations, max_elements / 8);
  AddTo(room, data, state, indirect, IndirectBias(room, indirect.elements, state), sum);
  return sum;
}

}  // namespace luxfit
