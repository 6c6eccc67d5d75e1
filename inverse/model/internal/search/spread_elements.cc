#include "inverse/model/internal/search/spread_elements.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>

#include "calib/luminance/median.h"

namespace luxfit {
namespace {

constexpr double kFilled = 0.5;    // share of direct light
constexpr double kInBeam = 0.1;    // of the brightest direct light of the state
constexpr size_t kFewInBeam = 60;  // tell a place, an aim and a width
constexpr size_t kBrightest = 5;   // elements, which errors of single ones do not tell

int MaterialOf(const Room& room, const Observation& o) {
  const Element& element = room.patches.elements[static_cast<size_t>(o.element)];
  return room.patches.patches[static_cast<size_t>(element.patch)].material;
}

// Returns the reflectance of each material. Where no direct light falls, Y / I is that. The darkest tenth gives it roughly.
std::map<int, double> RoughAlbedo(const Room& room, const LightData& data) {
  std::map<int, std::vector<double>> ratios;
  for (const Observation& o : data.observations)
    if (o.relative_indirect > 0)
      ratios[MaterialOf(room, o)].push_back(o.relative_luminance / o.relative_indirect);
  std::map<int, double> albedo;
  for (auto& [material, values] : ratios) albedo[material] = Quantile(std::move(values), 0.1);
  return albedo;
}

struct Filled {
  int element = 0;
  double direct = 0;  // illuminance, as relative luminance of a white element
};

// Returns the elements within the beams of each state, the brightest first.
std::map<int, std::vector<Filled>> InBeamByState(const Room& room, const LightData& data) {
  const std::map<int, double> albedo = RoughAlbedo(room, data);
  std::map<int, std::vector<Filled>> filled;
  for (const Observation& o : data.observations) {
    const auto rho = albedo.find(MaterialOf(room, o));
    if (rho == albedo.end() || !(rho->second > 0)) continue;
    const double direct = o.relative_luminance / rho->second - o.relative_indirect;
    if (direct * rho->second > kFilled * o.relative_luminance) filled[o.state].push_back({o.element, direct});
  }
  for (auto& [state, elements] : filled) {
    std::stable_sort(elements.begin(), elements.end(),
                     [](const Filled& a, const Filled& b) { return a.direct > b.direct; });
    const double least = kInBeam * elements[std::min(kBrightest, elements.size()) - 1].direct;
    elements.erase(
        std::find_if(elements.begin(), elements.end(), [&](const Filled& f) { return f.direct < least; }),
        elements.end());
  }
  return filled;
}

}  // namespace

std::vector<Observation> SpreadElements(const Room& room, const LightData& data, int max_elements) {
  std::set<int> kept;
  for (const Observation& o : ThinElements(data.observations, max_elements)) kept.insert(o.element);
  for (const auto& [state, elements] : InBeamByState(room, data)) {
    auto few = static_cast<size_t>(std::count_if(elements.begin(), elements.end(),
                                                 [&](const Filled& f) { return kept.count(f.element) > 0; }));
    for (auto next = elements.begin(); next != elements.end() && few < kFewInBeam; ++next)
      few += kept.insert(next->element).second ? 1 : 0;
  }
  std::vector<Observation> spread;
  for (const Observation& o : data.observations)
    if (kept.count(o.element) > 0) spread.push_back(o);
  return spread;
}

}  // namespace luxfit
