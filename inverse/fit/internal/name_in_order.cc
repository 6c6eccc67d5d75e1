#include "inverse/fit/internal/name_in_order.h"

#include <algorithm>
#include <vector>

#include "inverse/model/internal/search/order_of_places.h"

namespace luxfit {
namespace {

bool AreOnTogether(const RoomObservations& given, int a, int b) {
  return std::all_of(given.dimming.begin(), given.dimming.end(),
                     [&](const Eigen::VectorXd& dimming) { return dimming[a] == dimming[b]; });
}

// Puts the luminaires of `indices` in order; each place keeps its id.
void Order(const std::vector<int>& indices, LightState& state) {
  std::vector<Luminaire> luminaires;
  std::vector<Eigen::Vector3d> places;
  for (const int k : indices) {
    luminaires.push_back(state.luminaires[static_cast<size_t>(k)]);
    places.push_back(luminaires.back().position);
  }
  const std::vector<size_t> order = OrderOfPlaces(places);
  for (size_t i = 0; i < indices.size(); ++i) {
    Luminaire& there = state.luminaires[static_cast<size_t>(indices[i])];
    luminaires[order[i]].id = there.id;
    there = luminaires[order[i]];
  }
}

}  // namespace

bool IsNothingKnownOf(const KnownLuminaire& luminaire) {
  return luminaire.photometry == KnownPhotometry::kNothing && !luminaire.is_held && !luminaire.position_m &&
         !luminaire.flux_lm && !luminaire.aim && !luminaire.heading && !luminaire.shape_is_known;
}

LightState WithNamesInOrder(const RoomObservations& given, LightState state) {
  for (const std::vector<int>& type : TypesOf(state)) {
    std::vector<int> unknown;
    for (const int k : type) {
      if (IsNothingKnownOf(given.luminaires[static_cast<size_t>(k)])) unknown.push_back(k);
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
