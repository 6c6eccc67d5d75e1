#include "inverse/fit/internal/name_in_order.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

namespace luxfit {
namespace {

bool IsUnknown(const KnownLuminaire& known) {
  return known.photometry == KnownPhotometry::kNothing && !known.is_held && !known.position_m &&
         !known.flux_lm && !known.aim && !known.heading && !known.shape_is_known;
}

bool AreOnTogether(const RoomObservations& given, int a, int b) {
  return std::all_of(given.dimming.begin(), given.dimming.end(),
                     [&](const Eigen::VectorXd& dimming) { return dimming[a] == dimming[b]; });
}

bool ComesFirst(const Luminaire& a, const Luminaire& b) {
  const auto key = [](const Luminaire& l) {
    return std::tuple(l.position.x(), l.position.y(), l.position.z());
  };
  return key(a) < key(b);
}

// Puts the luminaires of `indices` in order; each place keeps its id.
void Order(const std::vector<int>& indices, LightState& state) {
  std::vector<Luminaire> ordered;
  ordered.reserve(indices.size());
  for (const int k : indices) ordered.push_back(state.luminaires[static_cast<size_t>(k)]);
  std::stable_sort(ordered.begin(), ordered.end(), ComesFirst);
  for (size_t i = 0; i < indices.size(); ++i) {
    Luminaire& there = state.luminaires[static_cast<size_t>(indices[i])];
    ordered[i].id = there.id;
    there = std::move(ordered[i]);
  }
}

}  // namespace

LightState WithNamesInOrder(const RoomObservations& given, LightState state) {
  for (const std::vector<int>& type : TypesOf(state)) {
    std::vector<int> unknown;
    for (const int k : type) {
      if (IsUnknown(given.luminaires[static_cast<size_t>(k)])) unknown.push_back(k);
    }
    while (unknown.size() > 1) {  // a type may hold several groups
      const auto rest = std::stable_partition(
          unknown.begin(), unknown.end(),
          [&, first = unknown.front()](int k) { return AreOnTogether(given, first, k); });
      Order({unknown.begin(), rest}, state);
      unknown.erase(unknown.begin(), rest);
    }
  }
  return state;
}

}  // namespace luxfit
