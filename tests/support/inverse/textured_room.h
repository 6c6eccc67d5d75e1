// A room with a carpet of unlike tiles and with posters, which its model does not have. The unbiased light tracer
// lights it: the truth shares no patch, no form factor and no material with what is estimated from it.
//
//   L_e = sum_k d_k mean over p in e of rho(p) E_k(p) / pi        e: element of the model, k: luminaire
//
// 5 m x 4 m x 2.7 m; A: a Lambertian panel 0.6 m square, B and C: downlights. Walls and floor consist of tiles of
// 0.25 m, each a facet with a material of its own. The plain room has the same tiles, each of its material's mean.
//
// Units: m, lx, lm. Light is the mean of four points of an element; the tracer's seed is kTracerSeed. A standard
// library's own distributions draw textures and noise.
#ifndef LUXFIT_TESTS_SUPPORT_INVERSE_TEXTURED_ROOM_H_
#define LUXFIT_TESTS_SUPPORT_INVERSE_TEXTURED_ROOM_H_

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "forward/light/light_tracer.h"
#include "forward/light/room.h"
#include "inverse/fit/room_observations.h"
#include "tests/support/scenes.h"

namespace luxfit::support {

constexpr Eigen::Index kTexturedWall = 0, kTexturedFloor = 1, kTexturedCeiling = 2;
constexpr uint64_t kTracerSeed = 1;

// Returns the model of the room: six facets of three materials.
inline Room TexturedRoomModel(const Eigen::Vector3d& size_m = {5, 4, 2.7}) {
  RoomOptions options;
  options.patches.patch_size_m = 0.5;
  options.patches.element_size_m = 0.125;
  return MakeRoom(ClosedRoom(size_m, {"wall", "wall", "wall", "wall", "floor", "ceiling"}), options);
}

inline std::vector<Luminaire> TexturedRoomLuminaires() {
  std::vector<Luminaire> luminaires(3);
  const std::vector<Eigen::Vector3d> places = {{1.4, 2.6, 2.4}, {3.7, 2.9, 2.5}, {3.2, 1.0, 2.5}};
  const std::vector<double> fluxes_lm = {3000, 1200, 900};
  for (size_t k = 0; k < luminaires.size(); ++k) {
    luminaires[k].id = std::string(1, static_cast<char>('A' + k));
    luminaires[k].position = places[k];
    luminaires[k].flux_lm = fluxes_lm[k];
    if (k == 0) continue;
    luminaires[k].distribution = Distribution::kCosinePower;
    luminaires[k].cosine_exponent = k == 1 ? 3 : 2;
  }
  luminaires[0].shape = LuminaireShape::kRectangle;
  luminaires[0].size_m = {0.6, 0.6};
  return luminaires;
}

// Holds the tiles of one facet of the model: row by row along edge_u.
struct TileGrid {
  int first = 0, count_u = 1, count_v = 1;
  int At(const Eigen::Vector2d& uv) const {
    const int i = std::clamp(static_cast<int>(uv[0] * count_u), 0, count_u - 1);
    const int j = std::clamp(static_cast<int>(uv[1] * count_v), 0, count_v - 1);
    return first + j * count_u + i;
  }
};

struct TiledRoom {
  Scene scene;                         // its facets are the tiles; each is of a material of the same number
  Eigen::VectorXd albedo;              // by tile
  Eigen::VectorXd mean_albedo;         // by material of the model, by area
  std::vector<TileGrid> grids;         // by facet of the model
  std::vector<Luminaire> bodies = {};  // those whose bodies are there
};

// Returns factors of mean 1: the logarithm of each tile's has a sigma of 0.3.
inline std::vector<double> CarpetFactors(const TileGrid& grid, std::mt19937_64& rng) {
  constexpr double kSigma = 0.3;
  std::normal_distribution<double> normal;
  std::vector<double> factors(static_cast<size_t>(grid.count_u) * static_cast<size_t>(grid.count_v));
  for (double& factor : factors) factor = std::exp(kSigma * normal(rng) - kSigma * kSigma / 2);
  return factors;
}

// Returns factors of posters of 2 to 4 tiles a side, which cover two fifths of a wall; 1 elsewhere.
inline std::vector<double> PosterFactors(const TileGrid& grid, std::mt19937_64& rng) {
  constexpr double kCovered = 0.4;
  std::uniform_real_distribution<double> even;
  const auto draw = [&](int low, int high) { return low + static_cast<int>(even(rng) * (high - low + 1)); };
  std::vector<double> factors(static_cast<size_t>(grid.count_u) * static_cast<size_t>(grid.count_v), 1);
  const auto is_poster = [](double factor) { return factor != 1; };
  while (static_cast<double>(std::count_if(factors.begin(), factors.end(), is_poster)) <
         kCovered * static_cast<double>(factors.size())) {
    const int size_u = draw(2, 4), size_v = draw(2, 4);
    const int i0 = draw(0, grid.count_u - size_u), j0 = draw(0, grid.count_v - size_v);
    const double factor = 0.4 + even(rng);  // to 1.4, of a wall of 0.6
    for (int k = 0; k < size_u * size_v; ++k) {
      const int tile = (j0 + k / size_u) * grid.count_u + i0 + k % size_u;
      factors[static_cast<size_t>(tile)] = factor;
    }
  }
  return factors;
}

// Divides a facet of the model into tiles and adds them to the room, whose reflectances are left out.
inline TileGrid AddTiles(const Facet& facet, double tile_m, Scene& scene) {
  TileGrid grid;
  grid.first = static_cast<int>(scene.facets.size());
  grid.count_u = std::max(1, static_cast<int>(std::lround(facet.edge_u.norm() / tile_m)));
  grid.count_v = std::max(1, static_cast<int>(std::lround(facet.edge_v.norm() / tile_m)));
  const Eigen::Vector3d edge_u = facet.edge_u / grid.count_u, edge_v = facet.edge_v / grid.count_v;
  for (int k = 0; k < grid.count_u * grid.count_v; ++k) {
    const int tile = grid.first + k, i = k % grid.count_u, j = k / grid.count_u;
    scene.facets.push_back(
        {FacetKind::kParallelogram, facet.origin + i * edge_u + j * edge_v, edge_u, edge_v, tile});
    scene.materials.push_back(std::to_string(tile));
  }
  return grid;
}

// `is_textured`: false gives every tile its material's mean.
inline TiledRoom MakeTiledRoom(const Scene& model, bool is_textured) {
  constexpr double kTileM = 0.25, kWhole = 100;
  const Eigen::Vector3d paint(0.6, 0.25, 0.8);
  std::mt19937_64 rng(11);
  TiledRoom room;
  std::vector<double> albedo;
  Eigen::Vector3d sum_m2 = Eigen::Vector3d::Zero(), area_m2 = sum_m2;
  for (const Facet& facet : model.facets) {
    const bool is_ceiling = facet.material == kTexturedCeiling;
    const TileGrid grid = AddTiles(facet, is_ceiling ? kWhole : kTileM, room.scene);
    std::vector<double> factors = {1};
    if (!is_ceiling)
      factors = facet.material == kTexturedFloor ? CarpetFactors(grid, rng) : PosterFactors(grid, rng);
    for (const double factor : factors) {
      albedo.push_back(paint[facet.material] * factor);
      sum_m2[facet.material] += albedo.back() * facet.AreaM2() / static_cast<double>(factors.size());
    }
    area_m2[facet.material] += facet.AreaM2();
    room.grids.push_back(grid);
  }
  room.mean_albedo = sum_m2.cwiseQuotient(area_m2);
  room.albedo = Eigen::Map<Eigen::VectorXd>(albedo.data(), static_cast<Eigen::Index>(albedo.size()));
  for (size_t f = 0; !is_textured && f < model.facets.size(); ++f) {
    const TileGrid& grid = room.grids[f];
    room.albedo.segment(grid.first, grid.count_u * grid.count_v)
        .setConstant(room.mean_albedo[model.facets[f].material]);
  }
  return room;
}

// Adds the body of a rectangle below the ceiling: a box of reflectance 0.6, from its opening to the ceiling.
inline void AddBody(const Luminaire& luminaire, double ceiling_m, TiledRoom& room) {
  constexpr double kGapM = 0.002, kBodyAlbedo = 0.6;
  const LuminaireAxes axes = AxesOf(luminaire);
  const Eigen::Vector3d up(0, 0, ceiling_m - luminaire.position.z() - kGapM);
  const Eigen::Vector3d along = luminaire.size_m[0] * axes.along, across = luminaire.size_m[1] * axes.across;
  const Eigen::Vector3d centre = luminaire.position + Eigen::Vector3d(0, 0, kGapM);
  const auto material = static_cast<int>(room.scene.materials.size());
  room.scene.materials.push_back("body of " + luminaire.id);
  room.albedo.conservativeResize(material + 1);
  room.albedo[material] = kBodyAlbedo;
  const auto add = [&](const Eigen::Vector3d& corner, const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
    room.scene.facets.push_back({FacetKind::kParallelogram, corner, u, v, material});
  };
  const Eigen::Vector3d low = centre - along / 2 - across / 2, high = centre + along / 2 + across / 2;
  // Along, across and the aim, which points down, are right-handed.
  add(low, along, across);
  add(low, up, along);
  add(low, across, up);
  add(high, up, -along);
  add(high, -across, up);
  room.bodies.push_back(luminaire);
}

// Returns whether a body hides the point of the ceiling.
inline bool IsCovered(const TiledRoom& room, const Eigen::Vector3d& p) {
  return std::any_of(room.bodies.begin(), room.bodies.end(), [&](const Luminaire& body) {
    const LuminaireAxes axes = AxesOf(body);
    const Eigen::Vector3d to = p - body.position;
    return to.z() > 0 && std::abs(to.dot(axes.along)) <= body.size_m[0] / 2 &&
           std::abs(to.dot(axes.across)) <= body.size_m[1] / 2;
  });
}

// Holds the luminance of the observed elements by each luminaire: elements x luminaires, cd/m2.
struct TracedElements {
  std::vector<int> elements;
  Eigen::MatrixXd luminance;
  double relative_sigma = 0;  // standard error by the tracer, rms over elements and luminaires
};

// Traces a third of the elements, which lie all over the room. Those that a body covers, even in part, are left
// out.
inline TracedElements TraceElements(const Room& model, const TiledRoom& truth,
                                    const std::vector<Luminaire>& luminaires = TexturedRoomLuminaires()) {
  constexpr size_t kPoints = 4;  // of an element
  TracedElements traced;
  std::vector<Sensor> sensors;
  std::vector<double> albedo;
  for (size_t e = 0; e < model.patches.elements.size(); ++e) {
    if (e % 3 != 0) continue;
    const Element& element = model.patches.elements[e];
    const auto facet = static_cast<size_t>(model.patches.PatchOf(static_cast<int>(e)).facet);
    const auto probes = ProbesOf(element, false);
    if (std::any_of(probes.begin(), probes.end(), [&](const auto& p) { return IsCovered(truth, p); }))
      continue;
    traced.elements.push_back(static_cast<int>(e));
    for (const Eigen::Vector3d& p : probes) {
      sensors.push_back({p, element.normal});
      albedo.push_back(truth.albedo[truth.grids[facet].At(model.scene.facets[facet].CoordinatesOf(p))]);
    }
  }
  LightTracerOptions options;
  options.paths_per_sensor = 2048;  // 8192 an element: 0.2 to 0.5 % of the indirect light
  options.replicates = 2;           // long ones have the smallest errors, which are pooled over all points
  options.seed = kTracerSeed;
  const TracedIlluminance lx =
      TraceIlluminance(truth.scene, RayScene(truth.scene), luminaires, truth.albedo, sensors, options);
  const auto lamps = static_cast<Eigen::Index>(luminaires.size());
  traced.luminance.setZero(static_cast<Eigen::Index>(traced.elements.size()), lamps);
  Eigen::MatrixXd variance = traced.luminance;
  for (size_t p = 0; p < sensors.size(); ++p) {
    const auto row = static_cast<Eigen::Index>(p), element = static_cast<Eigen::Index>(p / kPoints);
    const double share = albedo[p] / (static_cast<double>(kPoints) * M_PI);
    traced.luminance.row(element) += share * (lx.direct.row(row) + lx.indirect.row(row));
    variance.row(element) +=
        share * share * (lx.direct_sigma.row(row).cwiseAbs2() + lx.indirect_sigma.row(row).cwiseAbs2());
  }
  traced.relative_sigma = std::sqrt((variance.array() / traced.luminance.array().square()).mean());
  return traced;
}

// Returns one luminaire alone in each state, then all of them.
inline std::vector<Eigen::VectorXd> TexturedRoomDimming(Eigen::Index luminaires = 3) {
  std::vector<Eigen::VectorXd> dimming;
  dimming.reserve(static_cast<size_t>(luminaires) + 1);
  for (Eigen::Index k = 0; k < luminaires; ++k) dimming.emplace_back(Eigen::VectorXd::Unit(luminaires, k));
  dimming.emplace_back(Eigen::VectorXd::Ones(luminaires));
  return dimming;
}

// Returns which sources belong to which luminaire: sources x luminaires, 0 or 1. Sources in a row that have one
// id are parts of one luminaire.
inline Eigen::MatrixXd SourcesByLuminaire(const std::vector<Luminaire>& sources) {
  std::vector<Eigen::Index> luminaire;
  luminaire.reserve(sources.size());
  for (size_t i = 0; i < sources.size(); ++i)
    luminaire.push_back(i == 0 ? 0 : luminaire.back() + (sources[i].id == sources[i - 1].id ? 0 : 1));
  Eigen::MatrixXd belongs =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(sources.size()), luminaire.back() + 1);
  for (size_t i = 0; i < sources.size(); ++i) belongs(static_cast<Eigen::Index>(i), luminaire[i]) = 1;
  return belongs;
}

// Returns eight places at the height of a desk, facing up.
inline std::vector<Sensor> TexturedRoomSensors() {
  std::vector<Sensor> sensors;
  sensors.reserve(8);
  for (const double y : {0.9, 2.8})
    for (const double x : {0.7, 1.8, 3.1, 4.4}) sensors.push_back({{x, y + 0.1 * x, 0.75}, {0, 0, 1}});
  return sensors;
}

struct TexturedRoomData {
  RoomObservations given;
  std::vector<double> true_lx;       // by reading of the meter
  double traced_relative_sigma = 0;  // of an element's light
};

// Returns photos and readings of the room with noise of 0.3 % and 1 %. Nothing is known of the luminaires but where
// photos show them, to some 2 cm. Four readings with all luminaires on are used; the others only check.
// Luminaires in a row that have one id are parts of one, at the place of the first.
inline TexturedRoomData ObserveTiledRoom(
    const Room& model, const TiledRoom& truth, std::mt19937_64 rng,
    const std::vector<Luminaire>& luminaires = TexturedRoomLuminaires()) {
  constexpr double kNoise = 0.003, kReadingNoise = 0.01, kPlaceSigmaM = 0.012, kScale = 2e-3;
  std::normal_distribution<double> normal;
  TexturedRoomData data;
  RoomObservations& given = data.given;
  const Eigen::MatrixXd belongs = SourcesByLuminaire(luminaires);
  given.dimming = TexturedRoomDimming(belongs.cols());
  const int all_on = static_cast<int>(given.dimming.size()) - 1;
  for (int k = 0; k < all_on; ++k) {
    Eigen::Index first = 0;
    belongs.col(k).maxCoeff(&first);
    const Luminaire& luminaire = luminaires[static_cast<size_t>(first)];
    given.luminaires.emplace_back();
    given.luminaires.back().luminaire.id = luminaire.id;
    SeenPlace seen;
    seen.position = luminaire.position;
    for (double& coordinate : seen.position) coordinate += kPlaceSigmaM * normal(rng);
    seen.sigma_m = kPlaceSigmaM;
    seen.states = {k, all_on};
    given.seen.push_back(seen);
  }

  const TracedElements traced = TraceElements(model, truth, luminaires);
  data.traced_relative_sigma = traced.relative_sigma;
  for (int state = 0; state <= all_on; ++state) {
    const Eigen::VectorXd luminance = traced.luminance * belongs * given.dimming[static_cast<size_t>(state)];
    for (size_t i = 0; i < traced.elements.size(); ++i) {
      Observation o;
      o.element = traced.elements[i];
      o.state = state;
      o.pixels = 100;
      o.relative_luminance = kScale * luminance[static_cast<Eigen::Index>(i)] * (1 + kNoise * normal(rng));
      o.variance = std::pow(kNoise * o.relative_luminance, 2);
      o.relative_rgb.setConstant(o.relative_luminance);
      given.observations.push_back(o);
    }
  }

  const std::vector<Sensor> sensors = TexturedRoomSensors();
  LightTracerOptions options;
  options.seed = kTracerSeed;
  const TracedIlluminance lx =
      TraceIlluminance(truth.scene, RayScene(truth.scene), luminaires, truth.albedo, sensors, options);
  for (int state = 0; state <= all_on; ++state) {
    const Eigen::VectorXd true_lx =
        (lx.direct + lx.indirect) * belongs * given.dimming[static_cast<size_t>(state)];
    for (size_t s = 0; s < sensors.size(); ++s) {
      data.true_lx.push_back(true_lx[static_cast<Eigen::Index>(s)]);
      const double read_lx = data.true_lx.back() * (1 + kReadingNoise * normal(rng));
      given.meter.readings.push_back({sensors[s], state, read_lx, 0, state == all_on && s % 2 == 0, -1});
    }
  }
  return data;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_INVERSE_TEXTURED_ROOM_H_
