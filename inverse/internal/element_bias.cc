#include "inverse/internal/element_bias.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

#include "forward/direct_light.h"

namespace luxfit {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Per lumen of each luminaire: mean over the element less the value at its centre.
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

}  // namespace

Eigen::VectorXd ElementBias(const Room& room, const LightData& data, const LightState& state,
                            int max_elements) {
  std::vector<int> observed;
  observed.reserve(data.observations.size());
  for (const Observation& o : data.observations) observed.push_back(o.element);
  std::sort(observed.begin(), observed.end());
  observed.erase(std::unique(observed.begin(), observed.end()), observed.end());
  const size_t stride = std::max<size_t>(1, observed.size() / static_cast<size_t>(std::max(1, max_elements)));
  std::vector<int> taken;
  taken.reserve(observed.size() / stride + 1);
  for (size_t i = 0; i < observed.size(); i += stride) taken.push_back(observed[i]);
  std::vector<Eigen::VectorXd> difference(taken.size());
  tbb::parallel_for(size_t{0}, taken.size(), [&](size_t i) {
    const Element& element = room.patches.elements[static_cast<size_t>(taken[i])];
    difference[i] = MeanLessCentre(room, element, state.luminaires);
  });
  Eigen::VectorXd bias = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(data.observations.size()));
  for (size_t i = 0; i < data.observations.size(); ++i) {
    const Observation& o = data.observations[i];
    const auto place = std::lower_bound(taken.begin(), taken.end(), o.element);
    if (place == taken.end() || *place != o.element) continue;
    const int patch = room.patches.elements[static_cast<size_t>(o.element)].patch;
    const double rho = state.albedo[room.patches.patches[static_cast<size_t>(patch)].material];
    const Eigen::VectorXd& dimming = data.dimming[static_cast<size_t>(o.state)];
    double lx = 0;
    for (Eigen::Index k = 0; k < dimming.size(); ++k)
      lx += dimming[k] * state.luminaires[static_cast<size_t>(k)].flux_lm *
            difference[static_cast<size_t>(place - taken.begin())][k];
    bias[static_cast<Eigen::Index>(i)] = static_cast<double>(stride) * state.camera_scale * rho / kPi * lx;
  }
  return bias;
}

}  // namespace luxfit
