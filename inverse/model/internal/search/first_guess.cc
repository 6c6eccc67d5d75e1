#include "inverse/model/internal/search/first_guess.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "forward/luminaire/distribution_ops.h"
#include "inverse/model/internal/search/order_of_places.h"
#include "inverse/model/internal/search/places_inside.h"
#include "inverse/model/internal/search/sparse_luminaires.h"
#include "inverse/model/internal/search/watched_places.h"

namespace luxfit {
namespace {

using KnownPositions = std::vector<std::optional<Eigen::Vector3d>>;

std::vector<SparseSource> HeldSources(const LuminaireGroup& group, const KnownPositions& known) {
  std::vector<SparseSource> held;
  for (const int k : group.luminaires) {
    if (known.empty() || !known[static_cast<size_t>(k)]) continue;
    held.emplace_back();
    held.back().luminaire.position = *known[static_cast<size_t>(k)];
    held.back().is_held = true;
  }
  return held;
}

std::vector<int> SeenOf(const LuminaireGroup& group, const LightData& data,
                        const std::vector<SeenPlace>& seen) {
  std::vector<int> own;
  for (size_t i = 0; i < seen.size(); ++i) {
    if (MayBePlaceOf(seen[i], data.dimming, group.luminaires[0])) own.push_back(static_cast<int>(i));
  }
  return own;
}

struct SeenPositions {
  std::vector<int> index;
  std::vector<SeenPlace> places;  // inside the room

  std::optional<int> IndexAt(const Eigen::Vector3d& p) const {
    const auto at = std::find_if(places.begin(), places.end(),
                                 [&](const SeenPlace& place) { return place.position == p; });
    return at == places.end() ? std::nullopt : std::optional(index[static_cast<size_t>(at - places.begin())]);
  }
};

std::vector<SparseSource> InOrder(const std::vector<SparseSource>& sources) {
  std::vector<Eigen::Vector3d> places;
  places.reserve(sources.size());
  for (const SparseSource& source : sources) places.push_back(source.luminaire.position);
  std::vector<SparseSource> ordered;
  ordered.reserve(sources.size());
  for (const size_t i : OrderOfPlaces(places)) ordered.push_back(sources[i]);
  return ordered;
}

// Assigns a group's sources to its luminaires: held ones to those of a known position, in their order.
// `seen`: positions of the places seen, with their indices.
void Assign(const LuminaireGroup& group, const SparseLuminaires& found, const KnownPositions& known,
            const SeenPositions& seen, double flux_per_strength, FirstGuess& guess) {
  std::vector<SparseSource> held, free;
  for (const SparseSource& source : found.sources) (source.is_held ? held : free).push_back(source);
  free = InOrder(free);
  size_t next_held = 0, next_free = 0;
  for (size_t i = 0; i < group.luminaires.size(); ++i) {
    const auto k = static_cast<size_t>(group.luminaires[i]);
    const bool is_held = !known.empty() && known[k].has_value();
    std::vector<SparseSource>& pool = is_held ? held : free;
    size_t& next = is_held ? next_held : next_free;
    if (next >= pool.size()) continue;
    const SparseSource& source = pool[next++];
    LuminaireGuess& luminaire = guess.luminaires[k];
    luminaire.found = true;
    luminaire.position = source.luminaire.position;
    luminaire.aim = source.luminaire.aim;
    luminaire.distribution = source.luminaire.distribution;
    luminaire.cosine_exponent = source.luminaire.cosine_exponent;
    luminaire.flux = flux_per_strength * source.strength / group.share[i];
    if (!is_held) luminaire.seen = seen.IndexAt(source.luminaire.position);
    luminaire.seen_candidates = is_held ? 0 : static_cast<int>(seen.index.size());
    luminaire.rivals = source.rivals;
    luminaire.is_aimed = found.is_aimed && OpsOf(luminaire.distribution).has_aim;
    luminaire.was_searched = found.was_searched;
    luminaire.relative_residual = 0.1 * std::sqrt(found.mean_square);
  }
}

bool GoesOn(const LightData& data) {
  try {
    if (data.checkpoint) data.checkpoint(data.is_part);
  } catch (const FitStopped&) {
    return false;
  }
  return true;
}

// Averages albedo geometrically over the groups. Groups that explain their light better weigh more.
class AlbedoMean {
 public:
  explicit AlbedoMean(Eigen::Index materials)
      : sum_(Eigen::VectorXd::Zero(materials)), weight_(Eigen::VectorXd::Zero(materials)) {}

  void Add(const SparseLuminaires& found) {
    const double weight = 1 / (1e-3 + found.mean_square);
    for (const auto& [material, albedo] : found.albedo) {
      sum_[material] += weight * std::log(albedo);
      weight_[material] += weight;
    }
  }

  Eigen::VectorXd Value() const {
    Eigen::VectorXd albedo = Eigen::VectorXd::Constant(sum_.size(), 0.5);
    for (Eigen::Index m = 0; m < sum_.size(); ++m) {
      if (weight_[m] > 0) albedo[m] = std::clamp(std::exp(sum_[m] / weight_[m]), 0.05, 0.9);
    }
    return albedo;
  }

 private:
  Eigen::VectorXd sum_, weight_;
};

}  // namespace

FirstGuess GuessLuminaires(const Room& room, const LightData& data, const KnownPositions& known_positions,
                           const std::vector<SeenPlace>& seen, const std::vector<Watcher>& views,
                           const FirstGuessOptions& options) {
  FirstGuess guess;
  guess.luminaires.resize(data.dimming.empty() ? 0 : static_cast<size_t>(data.dimming[0].size()));
  const GroupedLight light = GroupLight(room, data, options.max_elements);
  guess.separable = light.separable;
  if (!light.separable) guess.message = "the observed states do not tell the luminaires apart";
  for (const LuminaireGroup& group : light.groups) guess.groups.push_back(group.luminaires);
  AlbedoMean albedo(static_cast<Eigen::Index>(room.scene.materials.size()));
  const SparseSearch search(room, light, WatchingViews(seen, views), options.grid_m, options.refinements);
  for (size_t g = 0; g < light.groups.size(); ++g) {
    const LuminaireGroup& group = light.groups[g];
    SeenPositions own{SeenOf(group, data, seen), {}};
    for (const int i : own.index) own.places.push_back(seen[static_cast<size_t>(i)]);
    own.places = PlacesInside(room.scene.Bounds(), std::move(own.places));
    const SparseLuminaires found =
        search.Find(static_cast<int>(g), static_cast<int>(group.luminaires.size()),
                    HeldSources(group, known_positions), own.places, [&] { return GoesOn(data); });
    Assign(group, found, known_positions, own, data.observations.empty() ? 1 : M_PI, guess);
    if (!found.sources.empty()) albedo.Add(found);
  }
  guess.albedo = albedo.Value();
  return guess;
}

}  // namespace luxfit
