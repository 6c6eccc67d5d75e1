// An L-shaped room: a panel, a batwing, a globe, and two spots aimed at walls.
//
//   4 +------+          A: panel, B: disc that shines as a batwing, C: globe on a pendant
//     |  A   |          S1, S2: spots of 24 degrees, aimed at walls
//   2 |  S1  +------+
//     |  C    B  S2 |   5.5 m x 4 m, 2.7 m high
//   0 +-------------+
//     0      3    5.5
//
// The light tracer makes photos and readings (tests/support/inverse/traced_room.h).
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <memory>
#include <random>
#include <vector>

#include "forward/light/room.h"
#include "forward/luminaire/luminaire_parts.h"
#include "tests/support/closed_forms.h"
#include "tests/support/inverse/traced_room.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

using Eigen::Vector3d;

Scene LShape() {
  constexpr double kHeight = 2.7;
  Scene scene;
  const std::vector<Eigen::Vector2d> corners = {{0, 0}, {5.5, 0}, {5.5, 2}, {3, 2}, {3, 4}, {0, 4}};
  for (size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d along = corners[(i + 1) % corners.size()] - corners[i];
    support::AddParallelogram(scene, {corners[i].x(), corners[i].y(), 0}, {0, 0, kHeight},
                              {along.x(), along.y(), 0}, "wall");
  }
  for (const double z : {0.0, kHeight}) {
    const std::string material = z == 0 ? "floor" : "ceiling";
    const Vector3d x(1, 0, 0), y(0, 1, 0);
    const auto add = [&](const Vector3d& origin, double width, double depth) {
      if (z == 0)
        support::AddParallelogram(scene, origin, width * x, depth * y, material);
      else
        support::AddParallelogram(scene, origin, depth * y, width * x, material);
    };
    add({0, 0, z}, 5.5, 2);
    add({0, 2, z}, 3, 2);
  }
  return scene;
}

IntensityTable Batwing() {
  std::vector<double> gamma_rad, intensity;
  for (int deg = 0; deg <= 90; deg += 5) {
    const double g = deg * support::kPi / 180;
    gamma_rad.push_back(g);
    intensity.push_back(std::cos(g) * (0.5 + 1.6 * std::pow(std::sin(g), 2)));
  }
  return RotationalTable(gamma_rad, intensity);
}

std::vector<Luminaire> TrueLuminaires() {
  std::vector<Luminaire> luminaires(5);
  Luminaire& panel = luminaires[0];
  panel.id = "A", panel.position = {1.4, 3.1, 2.69}, panel.flux_lm = 3200;
  panel.shape = LuminaireShape::kRectangle, panel.size_m = {0.6, 0.6};
  Luminaire& batwing = luminaires[1];
  batwing.id = "B", batwing.position = {3.6, 1.0, 2.65}, batwing.flux_lm = 2600;
  batwing.shape = LuminaireShape::kDisc, batwing.size_m = {0.3, 0.3};
  batwing.distribution = Distribution::kMeasured;
  batwing.table = std::make_shared<IntensityTable>(Batwing());
  Luminaire& globe = luminaires[2];
  globe.id = "C", globe.position = {1.0, 0.9, 1.9}, globe.flux_lm = 1100;
  globe.shape = LuminaireShape::kSphere, globe.size_m = {0.25, 0.25};
  globe.distribution = Distribution::kIsotropic;
  for (int i = 0; i < 2; ++i) {
    Luminaire& spot = luminaires[static_cast<size_t>(3 + i)];
    spot.id = i == 0 ? "S1" : "S2";
    spot.position = i == 0 ? Vector3d(2.2, 2.6, 2.55) : Vector3d(4.6, 1.4, 2.5);
    spot.aim = (i == 0 ? Vector3d(-1, 0.2, -0.55) : Vector3d(0.9, -0.3, -0.5)).normalized();
    spot.distribution = Distribution::kCosinePower;
    spot.cosine_exponent = 30;
    spot.flux_lm = i == 0 ? 800 : 650;
  }
  return luminaires;
}

support::TracedRoom TrueRoom() {
  support::TracedRoom room;
  room.truth = LShape();
  room.albedo = Vector3d(0.6, 0.25, 0.8);
  room.luminaires = TrueLuminaires();
  // A, B, C, the spots together, all.
  room.dimming.assign(5, Eigen::VectorXd::Zero(5));
  for (int k = 0; k < 3; ++k) room.dimming[static_cast<size_t>(k)][k] = 1;
  room.dimming[3].tail(2).setOnes();
  room.dimming[4].setOnes();
  room.eyes = {{0.3, 0.3, 1.6}, {5.2, 0.3, 1.6}, {5.2, 1.7, 1.5},
               {0.3, 3.7, 1.6}, {2.7, 3.7, 1.7}, {2.7, 0.3, 1.5}};
  for (const Eigen::Vector2d& p : {Eigen::Vector2d(0.8, 0.8),
                                   {2.2, 0.8},
                                   {3.6, 0.8},
                                   {4.8, 0.9},
                                   {0.8, 2.2},
                                   {2.2, 2.2},
                                   {0.8, 3.4},
                                   {2.2, 3.4}})
    room.places.push_back({{p.x(), p.y(), 0.75}, {0, 0, 1}, {}});
  return room;
}

TEST(LShapedRoom, EveryLuminaireIsFound) {
  const support::TracedRoom room = TrueRoom();
  RoomOptions options;
  options.patches.patch_size_m = 0.4;
  options.patches.element_size_m = 0.2;
  const Room model = MakeRoom(room.truth, options);
  std::mt19937_64 rng(5);
  const RoomObservations given = support::ObserveTraced(room, model, rng);
  support::ExpectFound(room, model, given);
}

}  // namespace
}  // namespace luxfit
