// A meeting room that its mesh describes badly: nobody measured the chairs. Photos show the luminaires.
//
//   L_ev = sum_k d_k rho E_k(q) / pi        e: element, v: view, q: what the view sees where the mesh has e
//
// 7 m x 5 m x 2.8 m with a table that the mesh has and ten chairs that it has not. P: a pendant, 2.4 m long, that shines
// up and down. D1 to D4: panels in the ceiling, on in pairs. W1 and W2: washers aimed at a wall, on together; no photo
// shows their openings. Beside the luminaires, photos show bright places that are none: on the table and on the wall.
// The light tracer lights the room: the truth shares no patch and no form factor with the model.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "forward/light/light_tracer.h"
#include "forward/light/room.h"
#include "forward/luminaire/luminaire_parts.h"
#include "inverse/fit/fit_room.h"
#include "tests/support/inverse/luminaire_outlines.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

using support::AddBox;
using support::Facing;

constexpr double kScale = 2e-3;  // relative luminance per cd/m2

Scene MeshOfRoom() {
  Scene scene = support::ClosedRoom({7, 5, 2.8}, {"wall", "wall", "wall", "wall", "floor", "ceiling"});
  AddBox(scene, {Eigen::Vector3d(2.0, 1.9, 0.69), Eigen::Vector3d(5.0, 3.1, 0.73)}, Facing::kOutward,
         {"table"});
  return scene;
}

Scene TrueRoom() {
  Scene scene = MeshOfRoom();
  for (const double y : {1.35, 3.65}) {
    for (int i = 0; i < 5; ++i) {
      const double x = 2.3 + 0.6 * i;
      AddBox(scene, {Eigen::Vector3d(x - 0.22, y - 0.22, 0.42), Eigen::Vector3d(x + 0.22, y + 0.22, 0.46)},
             Facing::kOutward, {"chair"});
      const double back = y < 2 ? y - 0.22 : y + 0.19;
      AddBox(scene, {Eigen::Vector3d(x - 0.22, back, 0.46), Eigen::Vector3d(x + 0.22, back + 0.03, 0.95)},
             Facing::kOutward, {"chair"});
    }
  }
  return scene;
}

// Walls, floor, ceiling, table, chairs.
Eigen::VectorXd TrueAlbedo() { return (Eigen::VectorXd(5) << 0.62, 0.28, 0.82, 0.45, 0.15).finished(); }

std::vector<Luminaire> TrueLuminaires() {
  std::vector<Luminaire> luminaires(7);
  luminaires[0].id = "P";
  luminaires[0].position = {3.5, 2.5, 1.95};
  luminaires[0].shape = LuminaireShape::kRectangle;
  luminaires[0].size_m = {2.4, 0.1};
  luminaires[0].distribution = Distribution::kMeasured;
  luminaires[0].table = std::make_shared<IntensityTable>(TwoSidedTable(0.35));
  luminaires[0].flux_lm = 5200;
  const std::vector<Eigen::Vector3d> panels = {
      {1.2, 1.2, 2.795}, {1.2, 3.8, 2.795}, {5.8, 1.2, 2.795}, {5.8, 3.8, 2.795}};
  for (size_t i = 0; i < panels.size(); ++i) {
    Luminaire& panel = luminaires[1 + i];
    panel.id = "D" + std::to_string(i + 1);
    panel.position = panels[i];
    panel.shape = LuminaireShape::kRectangle;
    panel.size_m = {0.6, 0.6};
    panel.flux_lm = 3400 + 50 * static_cast<double>(i);
  }
  for (size_t i = 0; i < 2; ++i) {
    Luminaire& washer = luminaires[5 + i];
    washer.id = "W" + std::to_string(i + 1);
    washer.position = {2.4 + 2.2 * static_cast<double>(i), 4.1, 2.7};
    washer.aim = Eigen::Vector3d(0, 0.62, -0.78).normalized();
    washer.distribution = Distribution::kCosinePower;
    washer.cosine_exponent = 8;
    washer.flux_lm = 1500;
  }
  return luminaires;
}

// By state: P, D1 and D2, D3 and D4, the washers, all.
std::vector<Eigen::VectorXd> Dimming() {
  std::vector<Eigen::VectorXd> dimming(5, Eigen::VectorXd::Zero(7));
  dimming[0][0] = 1;
  dimming[1].segment(1, 2).setOnes();
  dimming[2].segment(3, 2).setOnes();
  dimming[3].segment(5, 2).setOnes();
  dimming[4].setOnes();
  return dimming;
}

std::vector<Eigen::Vector3d> Eyes() {
  return {{0.4, 0.4, 1.6}, {6.6, 0.4, 1.7}, {6.6, 4.6, 1.5},
          {0.4, 4.6, 1.6}, {3.5, 0.3, 1.7}, {3.5, 4.7, 1.6}};
}

struct Seen {
  Eigen::Vector3d point, normal;  // of the true room
  double albedo = 0;
};

// Returns what the eye sees where the mesh has the point; nothing where the mesh itself hides it.
std::optional<Seen> SeenAt(const Room& room, const Scene& truth, const RayScene& rays,
                           const Eigen::Vector3d& eye, const Element& element) {
  const Eigen::Vector3d point = LiftedOff(element.center, element.normal);
  if ((eye - point).dot(element.normal) <= 0.1 * (eye - point).norm() || room.rays.Occluded(eye, point))
    return {};
  const RayHit hit = rays.Trace(eye, element.center - eye);
  if (hit.facet < 0 || !hit.front) return {};
  const Facet& facet = truth.facets[static_cast<size_t>(hit.facet)];
  return Seen{LiftedOff(facet.PointAt(hit.u, hit.v), facet.Normal()), facet.Normal(),
              TrueAlbedo()[facet.material]};
}

SeenPlace Place(const Eigen::Vector3d& at, double sigma_m, double area_m2, std::vector<int> states,
                int views) {
  SeenPlace place;
  place.position = at;
  place.sigma_m = sigma_m;
  place.area_m2 = area_m2;
  place.photos = views * static_cast<int>(states.size());
  place.states = std::move(states);
  place.views = views;
  return place;
}

// Adds where photos show luminaires: 20 mm off, the long pendant 60 mm; and bright places that are none.
void AddPlaces(std::mt19937_64& rng, RoomObservations& given) {
  std::normal_distribution<double> normal;
  const auto off = [&](double sigma_m) {
    return Eigen::Vector3d(sigma_m * normal(rng), sigma_m * normal(rng), 0.3 * sigma_m * normal(rng));
  };
  const std::vector<Luminaire> truth = TrueLuminaires();
  given.seen.push_back(Place({3.3, 2.3, 0.735}, 0.01, 0.05, {0, 4}, 5));
  given.seen.push_back(Place({3.9, 2.7, 0.735}, 0.01, 0.03, {0, 4}, 4));
  given.seen.push_back(Place(truth[0].position + off(0.06), 0.06, 0.24, {0, 4}, 5));
  for (int k = 1; k < 5; ++k)
    given.seen.push_back(
        Place(truth[static_cast<size_t>(k)].position + off(0.02), 0.02, 0.37, {k < 3 ? 1 : 2, 4}, 3));
  given.seen.push_back(Place({2.4, 4.99, 1.9}, 0.02, 0.4, {3, 4}, 3));
  given.seen.push_back(Place({2.0, 2.0, 0.72}, 0.03, 0.02, {2, 4}, 3));
}

void AddOutlines(RoomObservations& given) {
  const std::vector<Luminaire> truth = TrueLuminaires();
  for (int k = 0; k < 5; ++k) {
    const int state = k == 0 ? 0 : k < 3 ? 1 : 2;
    for (int v = 0; v < 4; ++v)
      given.outlines.push_back(
          support::OutlineFrom(Eyes()[static_cast<size_t>(v)], truth[static_cast<size_t>(k)], {v, state}));
  }
}

RoomObservations Observe(const Room& room) {
  constexpr size_t kStride = 5;
  constexpr double kNoise = 0.003, kReadingNoise = 0.01;
  const Scene truth = TrueRoom();
  const RayScene rays(truth);
  std::vector<Sensor> sensors;
  std::vector<double> albedo;
  std::vector<Observation> slots;
  for (size_t e = 0; e < room.patches.elements.size(); e += kStride) {
    for (size_t v = 0; v < Eyes().size(); ++v) {
      const auto seen = SeenAt(room, truth, rays, Eyes()[v], room.patches.elements[e]);
      if (!seen) continue;
      Observation o;
      o.element = static_cast<int>(e), o.view = static_cast<int>(v), o.pixels = 60;
      slots.push_back(o);
      sensors.push_back({seen->point, seen->normal, {}});
      albedo.push_back(seen->albedo);
    }
  }
  LightTracerOptions options;
  options.paths_per_sensor = 1024;
  options.replicates = 8;
  const TracedIlluminance lx =
      TraceIlluminance(truth, rays, TrueLuminaires(), TrueAlbedo(), sensors, options);
  RoomObservations given;
  given.dimming = Dimming();
  std::mt19937_64 rng(11);
  std::normal_distribution<double> normal;
  for (const Luminaire& luminaire : TrueLuminaires()) {
    given.luminaires.emplace_back();
    given.luminaires.back().luminaire.id = luminaire.id;
  }
  for (size_t s = 0; s < given.dimming.size(); ++s) {
    const Eigen::VectorXd illuminance = (lx.direct + lx.indirect) * given.dimming[s];
    const Eigen::VectorXd variance = lx.indirect_sigma.cwiseAbs2() * given.dimming[s].cwiseAbs2();
    for (size_t i = 0; i < slots.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const double unit = kScale * albedo[i] / M_PI;
      Observation o = slots[i];
      o.state = static_cast<int>(s);
      o.relative_luminance = unit * illuminance[row] * (1 + kNoise * normal(rng));
      o.variance = std::pow(kNoise * unit * illuminance[row], 2) + unit * unit * variance[row];
      o.relative_rgb.setConstant(o.relative_luminance);
      given.observations.push_back(o);
    }
  }
  std::vector<Sensor> places;
  for (const double y : {0.6, 2.5, 4.4})
    for (const double x : {0.8, 3.2, 6.1}) places.push_back({{x, y, 0.75}, {0, 0, 1}, {}});
  options.paths_per_sensor = 32768;
  const TracedIlluminance read =
      TraceIlluminance(truth, rays, TrueLuminaires(), TrueAlbedo(), places, options);
  const Eigen::VectorXd read_lx = (read.direct + read.indirect) * given.dimming.back();
  for (size_t i = 0; i < places.size(); ++i) {
    given.meter.readings.push_back({places[i], 4,
                                    read_lx[static_cast<Eigen::Index>(i)] * (1 + kReadingNoise * normal(rng)),
                                    0, i == 0, -1});
  }
  AddPlaces(rng, given);
  AddOutlines(given);
  return given;
}

// Returns which luminaire of a fit stands for the true one: those of one switch are interchangeable.
int NearestOf(const std::vector<Luminaire>& found, int first, int count, const Luminaire& truth) {
  const auto nearest = std::min_element(
      found.begin() + first, found.begin() + first + count, [&](const Luminaire& a, const Luminaire& b) {
        return (a.position - truth.position).norm() < (b.position - truth.position).norm();
      });
  return static_cast<int>(nearest - found.begin());
}

// Returns how many of its sigmas the luminaire is off, along the worst axis.
double WorstZ(const RoomFit& fit, int luminaire, const Eigen::Vector3d& truth) {
  double worst = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double sigma =
        SigmaOf(fit, ParameterKind::kLuminaire, luminaire, static_cast<LuminaireQuantity>(axis));
    const double off = fit.fit.state.luminaires[static_cast<size_t>(luminaire)].position[axis] - truth[axis];
    worst = std::max(worst, std::abs(off) / sigma);
  }
  return worst;
}

// Measured: pendant and panels 0.5 mm at worst (their outlines are exact), fluxes -0.1 to +3.5 %, washers 56 mm. The mesh
// lacks the chairs: what they absorb makes fluxes too large. Only their own light tells where the washers are.
TEST(MeetingRoom, LuminairesThatPhotosShowStayThere) {
  RoomOptions options;
  options.patches.patch_size_m = 0.4;
  options.patches.element_size_m = 0.125;
  const Room room = MakeRoom(MeshOfRoom(), options);
  const RoomFit fit = FitRoom(room, Observe(room));
  ASSERT_TRUE(fit.IsUsable()) << fit.fit.message;
  const std::vector<Luminaire> truth = TrueLuminaires();
  const int first_of_switch[] = {0, 1, 1, 3, 3, 5, 5};
  for (size_t k = 0; k < truth.size(); ++k) {
    const bool is_shown = k < 5;
    const int nearest = NearestOf(fit.fit.state.luminaires, first_of_switch[k], k == 0 ? 1 : 2, truth[k]);
    const Luminaire& found = fit.fit.state.luminaires[static_cast<size_t>(nearest)];
    const double off_mm = 1000 * (found.position - truth[k].position).norm();
    const double off_percent = 100 * (found.flux_lm / truth[k].flux_lm - 1);
    const double z = WorstZ(fit, nearest, truth[k].position);
    std::printf("  %s off by %6.1f mm (%.1f sigma), flux %+6.2f %%\n", truth[k].id.c_str(), off_mm, z,
                off_percent);
    EXPECT_LT(off_mm, is_shown ? 0.9 : 85) << truth[k].id;
    EXPECT_LT(z, 3) << truth[k].id << " is not where the fit says, nor within its sigmas";
    EXPECT_LT(std::abs(off_percent), 5.3) << truth[k].id;
  }
}

}  // namespace
}  // namespace luxfit
