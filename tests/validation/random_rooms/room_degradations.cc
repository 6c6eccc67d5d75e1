#include "tests/validation/random_rooms/room_degradations.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/stages/degrade/degradation.h"
#include "inverse/study/degrade.h"
#include "tests/support/scenes.h"
#include "tests/validation/random_rooms/run_traced.h"

namespace luxfit {
namespace {

using support::Furniture;
using support::RandomRoom;

double Uniform(std::mt19937_64& rng, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(rng);
}
size_t Below(std::mt19937_64& rng, size_t count) {
  return std::uniform_int_distribution<size_t>(0, count - 1)(rng);
}

// Returns the shell with the pieces that are left of all.
Scene WithoutShare(const RandomRoom& drawn, double percent) {
  const int left_out = ShareOf(percent, static_cast<int>(drawn.pieces.size()), 0);
  return support::WithFurniture(drawn.shell, {drawn.pieces.begin(), drawn.pieces.end() - left_out});
}

std::optional<NamedCause> RemoveFaces(double percent, std::mt19937_64&, RandomRoom& drawn) {
  if (drawn.pieces.empty()) return {};
  drawn.mesh = WithoutShare(drawn, percent);
  return NamedCause{"unmodelled_surface", {}};
}

std::optional<NamedCause> AddFaces(double percent, std::mt19937_64&, RandomRoom& drawn) {
  if (drawn.pieces.empty()) return {};
  drawn.room.truth = WithoutShare(drawn, percent);
  drawn.room.albedo.conservativeResize(static_cast<Eigen::Index>(drawn.room.truth.materials.size()));
  return NamedCause{"unmodelled_surface", {"the room lacks it"}};
}

bool IsWall(const Scene& scene, const Facet& facet) {
  return scene.materials[static_cast<size_t>(facet.material)].rfind("wall", 0) == 0;
}
bool IsFloor(const Scene& scene, const Facet& facet) {
  return scene.materials[static_cast<size_t>(facet.material)] == "floor";
}

// Adds a part of a facet, from `from` to `to` (u, v), `lift_m` in front of it, with a reflectance of its own.
void AddPart(const Facet& facet, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double lift_m,
             double albedo, support::TracedRoom& room) {
  const Eigen::Vector2d size = to - from;
  support::AddParallelogram(room.truth, facet.PointAt(from.x(), from.y()) + lift_m * facet.Normal(),
                            size.x() * facet.edge_u, size.y() * facet.edge_v,
                            "part " + std::to_string(room.albedo.size()));
  room.albedo.conservativeResize(room.albedo.size() + 1);
  room.albedo[room.albedo.size() - 1] = albedo;
}

std::optional<NamedCause> AddTexture(double percent, std::mt19937_64& rng, RandomRoom& drawn) {
  constexpr double kTileM = 0.5, kWhitest = 0.95;
  support::TracedRoom& room = drawn.room;
  const std::vector<Facet> facets = std::exchange(room.truth.facets, {});
  std::normal_distribution<double> normal;
  for (const Facet& facet : facets) {
    if (!IsFloor(room.truth, facet) && !IsWall(room.truth, facet)) {
      room.truth.facets.push_back(facet);
      continue;
    }
    const double rho = room.albedo[facet.material];
    const int nu = static_cast<int>(std::ceil(facet.edge_u.norm() / kTileM)),
              nv = static_cast<int>(std::ceil(facet.edge_v.norm() / kTileM));
    for (int u = 0; u < nu; ++u)
      for (int v = 0; v < nv; ++v)
        AddPart(facet, Eigen::Vector2d(1.0 * u / nu, 1.0 * v / nv),
                Eigen::Vector2d(1.0 * (u + 1) / nu, 1.0 * (v + 1) / nv), 0,
                std::min(kWhitest, rho * std::exp(percent / 100 * normal(rng))), room);
  }
  return NamedCause{};
}

std::optional<NamedCause> AddPosters(double count, std::mt19937_64& rng, RandomRoom& drawn) {
  constexpr double kWidthM = 0.7, kHeightM = 1, kLowestM = 1, kLiftM = 5e-4;
  std::vector<Facet> walls;
  for (const Facet& facet : drawn.room.truth.facets)
    if (IsWall(drawn.room.truth, facet) && facet.edge_v.norm() > 2 * kWidthM) walls.push_back(facet);
  for (int i = 0; i < count; ++i) {
    const Facet& wall = walls[Below(rng, walls.size())];
    const Eigen::Vector2d size(kHeightM / wall.edge_u.norm(), kWidthM / wall.edge_v.norm());
    const Eigen::Vector2d from(kLowestM / wall.edge_u.norm(), Uniform(rng, 0, 1 - size.y()));
    AddPart(wall, from, from + size, kLiftM, Uniform(rng, 0.05, 0.8), drawn.room);
  }
  return NamedCause{};
}

std::optional<NamedCause> AddNoise(double percent, std::mt19937_64& rng, RoomObservations& given) {
  given.observations = WithPixelNoise(std::move(given.observations), percent / 100, rng);
  return NamedCause{};
}

std::optional<NamedCause> DropViews(double percent, std::mt19937_64&, RandomRoom& drawn) {
  const auto views = static_cast<int>(drawn.room.eyes.size());
  drawn.room.eyes.resize(static_cast<size_t>(views - ShareOf(percent, views, 1)));
  return NamedCause{};
}

std::optional<NamedCause> DimLuminaire(double percent, std::mt19937_64& rng, RandomRoom& drawn) {
  support::TracedRoom& room = drawn.room;
  if (room.dimming.size() < 2) return {};
  const size_t k = Below(rng, room.luminaires.size());
  room.dimming.back()[static_cast<Eigen::Index>(k)] *= percent / 100;
  return NamedCause{"states_as_if", {room.luminaires[k].id + " was", StateName(room.dimming.size() - 1)}};
}

std::optional<NamedCause> ExchangePhotos(double, std::mt19937_64& rng, RoomObservations& given) {
  if (given.dimming.size() < 2 || given.observations.empty()) return {};
  const int view = given.observations[Below(rng, given.observations.size())].view;
  const size_t first = Below(rng, given.dimming.size()), step = 1 + Below(rng, given.dimming.size() - 1);
  const auto a = static_cast<int>(first), b = static_cast<int>((first + step) % given.dimming.size());
  const auto exchange = [&](int v, int& state) {
    if (v == view && (state == a || state == b)) state = a + b - state;
  };
  for (Observation& o : given.observations) exchange(o.view, o.state);
  for (SeenOutline& o : given.outlines) exchange(o.view, o.state);
  return NamedCause{"photos_as_if",
                    {PhotoName(view, std::min(a, b)) + " and " + PhotoName(view, std::max(a, b)) + " look"}};
}

std::optional<NamedCause> FalsifyExposure(double factor, std::mt19937_64& rng, RoomObservations& given) {
  if (given.observations.empty()) return {};
  const Observation one = given.observations[Below(rng, given.observations.size())];
  for (Observation& o : given.observations) {
    if (o.view != one.view || o.state != one.state) continue;
    o.relative_luminance *= factor, o.relative_rgb *= factor, o.variance *= factor * factor;
  }
  return NamedCause{"exposure_metadata", {PhotoName(one.view, one.state) + ":"}};
}

std::optional<NamedCause> FalsifyReading(double factor, std::mt19937_64& rng, RoomObservations& given) {
  const size_t place = 1 + Below(rng, given.meter.readings.size() - 1);
  given.meter.readings[place].illuminance_lx *= factor;
  return NamedCause{"reading_disagrees", {PlaceName(place)}};
}

std::optional<NamedCause> FalsifyScale(double factor, std::mt19937_64&, RoomObservations& given) {
  given.meter.readings.front().illuminance_lx *= factor;
  return NamedCause{"readings_as_if", {"sets the scale"}};
}

}  // namespace

const std::vector<RoomDegradation>& RoomDegradations() {
  static const std::vector<RoomDegradation> all{
      {"faces_removed", {25, 100}, RemoveFaces, nullptr},
      {"faces_added", {25, 100}, AddFaces, nullptr},
      {"texture", {5, 20}, AddTexture, nullptr},
      {"posters", {4}, AddPosters, nullptr},
      {"noise", {30, 100}, nullptr, AddNoise},
      {"views_dropped", {50, 75}, DropViews, nullptr},
      {"luminaire_dimmed", {0, 50}, DimLuminaire, nullptr},
      {"photos_exchanged", {1}, nullptr, ExchangePhotos},
      {"photo_exposure", {2}, nullptr, FalsifyExposure},
      {"reading", {2}, nullptr, FalsifyReading},
      {"scale_reading", {1.5}, nullptr, FalsifyScale},
  };
  return all;
}

}  // namespace luxfit
