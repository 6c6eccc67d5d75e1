#include "inverse/model/internal/search/alike_places.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace luxfit {

bool AreAlike(const SeenPlace& a, const SeenPlace& b) {
  constexpr double kHeight_m = 0.1, kAreaFactor = 1.3;
  return std::abs(a.position.z() - b.position.z()) < kHeight_m && a.area_m2 < kAreaFactor * b.area_m2 &&
         b.area_m2 < kAreaFactor * a.area_m2;
}

SparseSource SourceAt(const SeenPlace& place) {
  SparseSource source;
  source.luminaire.position = place.position;
  return SeenAt(std::move(source), place);
}

SparseSource SeenAt(SparseSource source, const SeenPlace& place) {
  source.is_seen = true;
  source.half_length = place.size_m[0] / 2 * place.heading;
  return source;
}

std::vector<SparseSource> SourcesAtAlike(const std::vector<SeenPlace>& places, size_t count) {
  if (count < kFewestAlike) return {};
  for (const SeenPlace& first : places) {
    std::vector<SparseSource> alike;
    for (const SeenPlace& place : places)
      if (IsSure(place) && AreAlike(first, place)) alike.push_back(SourceAt(place));
    if (alike.size() == count) return alike;
  }
  return {};
}

const SeenPlace* PlaceOf(const SparseSource& source, const std::vector<SeenPlace>& places) {
  if (!source.is_seen) return nullptr;
  const auto place = std::find_if(places.begin(), places.end(), [&](const SeenPlace& one) {
    return one.position == source.luminaire.position;
  });
  return place == places.end() ? nullptr : &*place;
}

std::vector<size_t> SourcesLike(const std::vector<SeenPlace>& places,
                                const std::vector<SparseSource>& sources, size_t i) {
  std::vector<size_t> like;
  const SeenPlace* place = PlaceOf(sources[i], places);
  for (size_t k = 0; place && k < sources.size(); ++k) {
    const SeenPlace* other = PlaceOf(sources[k], places);
    if (other && AreAlike(*place, *other)) like.push_back(k);
  }
  return like;
}

void ShareAmongAlike(const std::vector<SeenPlace>& places, std::vector<SparseSource>& sources) {
  std::vector<double> shared;
  shared.reserve(sources.size());
  for (size_t i = 0; i < sources.size(); ++i) {
    const std::vector<size_t> like = SourcesLike(places, sources, i);
    double sum = 0;
    for (const size_t k : like) sum += sources[k].strength;
    shared.push_back(like.size() < kFewestAlike ? sources[i].strength
                                                : sum / static_cast<double>(like.size()));
  }
  for (size_t i = 0; i < sources.size(); ++i) sources[i].strength = shared[i];
}

}  // namespace luxfit
