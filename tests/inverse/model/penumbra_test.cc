// Elements that a shadow's edge crosses, against rays that this file casts itself through a box.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "inverse/model/internal/light_model.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

const Eigen::AlignedBox3d kScreen(Eigen::Vector3d(1.55, 0.6, 0.2), Eigen::Vector3d(1.65, 1.6, 1.2));

Eigen::AlignedBox3d Grown(const Eigen::AlignedBox3d& box, double by_m) {
  const Eigen::Vector3d by = Eigen::Vector3d::Constant(by_m);
  return {Eigen::Vector3d(box.min() - by), Eigen::Vector3d(box.max() + by)};
}

// Tells whether the segment passes through the inside of the box, by the slabs between opposite faces (Kay and Kajiya
// 1986, "Ray tracing complex scenes").
bool PassesThrough(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  double enter = 0, leave = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double along = to[axis] - from[axis];
    const double low = box.min()[axis] - from[axis], high = box.max()[axis] - from[axis];
    if (along == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    enter = std::max(enter, std::min(low / along, high / along));
    leave = std::min(leave, std::max(low / along, high / along));
  }
  return enter < leave;
}

// Returns 9 x 9 points of a parallelogram, from border to border.
std::vector<Eigen::Vector3d> PointsOver(const Eigen::Vector3d& origin, const Eigen::Vector3d& edge_u,
                                        const Eigen::Vector3d& edge_v) {
  constexpr int kPieces = 8;
  std::vector<Eigen::Vector3d> points;
  points.reserve((kPieces + 1) * (kPieces + 1));
  for (int i = 0; i <= kPieces; ++i) {
    for (int j = 0; j <= kPieces; ++j) {
      const double u = static_cast<double>(i) / kPieces, v = static_cast<double>(j) / kPieces;
      points.emplace_back(origin + u * edge_u + v * edge_v);
    }
  }
  return points;
}

// Returns the share of the rays between two sets of points that pass through the box.
double ShareThrough(const Eigen::AlignedBox3d& box, const std::vector<Eigen::Vector3d>& from,
                    const std::vector<Eigen::Vector3d>& to) {
  size_t through = 0;
  for (const Eigen::Vector3d& p : from)
    for (const Eigen::Vector3d& q : to) through += PassesThrough(box, p, q) ? 1 : 0;
  return static_cast<double>(through) / static_cast<double>(from.size() * to.size());
}

// A room with a screen between a panel of 0.2 m x 0.15 m and a point, each alone in its state, and both in the third. All
// elements are observed in each state.
class ScreenedRoom : public testing::Test {
 protected:
  ScreenedRoom() {
    state_.luminaires.resize(2);
    Luminaire &panel = state_.luminaires[0], &point = state_.luminaires[1];
    panel.id = "panel";
    panel.position = Eigen::Vector3d(0.9, 1.1, 1.6);
    panel.aim = Eigen::Vector3d(0.2, -0.1, -1).normalized();
    panel.shape = LuminaireShape::kRectangle;
    panel.size_m = {0.2, 0.15};
    panel.flux_lm = 700;
    point.id = "point";
    point.position = Eigen::Vector3d(2.3, 1.3, 1.5);
    point.distribution = Distribution::kIsotropic;
    point.flux_lm = 400;
    state_.free.resize(2);
    state_.albedo = Eigen::Vector2d(0.6, 0.4);
    state_.albedo_free = {false, false};
    data_.dimming = {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(1, 1)};
    for (int e = 0; e < static_cast<int>(room_.patches.elements.size()); ++e) {
      for (int s = 0; s < 3; ++s) {
        Observation o;
        o.element = e;
        o.state = s;
        data_.observations.push_back(o);
      }
    }
    // On the floor, where the edge of the panel's shadow lies.
    data_.readings.push_back({{{1.64, 1.1, 0.01}, {0, 0, 1}}, 0, 100, 1, true});
  }

  static Scene RoomScene() {
    Scene scene = support::ClosedRoom({3.2, 2.2, 2.4});
    support::AddBox(scene, kScreen, support::Facing::kOutward, {"screen"});
    return scene;
  }

  // The panel's surface, or the point.
  std::vector<Eigen::Vector3d> PointsOf(size_t luminaire) const {
    const Luminaire& of = state_.luminaires[luminaire];
    if (of.shape == LuminaireShape::kPoint) return {of.position};
    const LuminaireAxes axes = AxesOf(of);
    const Eigen::Vector3d along = of.size_m[0] * axes.along, across = of.size_m[1] * axes.across;
    return PointsOver(of.position - 0.5 * (along + across), along, across);
  }

  const Room room_ = MakeRoom(RoomScene(), {{0.5, 0.25}, {64}});
  LightData data_;
  LightState state_;
};

// Three kinds of elements are known for certain.
// - None of their rays meets the screen, or all do. The points are at most 0.03 m apart, so every ray keeps within 0.021 m
//   of one of those cast here all along. All of these miss a screen grown by 0.025 m, or all meet one shrunk by as much.
// - The screen's own: a convex body does not shade its faces.
// - A quarter to three quarters of their rays meet it. The model probes the middles of 4 x 4 parts of an element against
//   the 2 x 2 points of Gauss, which lie 0.21 of a side from the luminaire's border. A straight edge beyond all of them
//   leaves 0.21 at most on its other side.
// What lies between may count as either.
TEST_F(ScreenedRoom, AnElementHalfBehindTheScreenIsInPenumbra) {
  constexpr double kMarginM = 0.025;
  LightModel model(room_, data_);
  model.FreezeVisibility(state_);
  const std::vector<bool> penumbra = model.InPenumbra();
  const size_t elements = room_.patches.elements.size();
  ASSERT_EQ(penumbra.size(), 3 * elements + 1);
  ASSERT_EQ(room_.scene.materials.at(1), "screen");
  const std::array<std::vector<Eigen::Vector3d>, 2> luminaires{PointsOf(0), PointsOf(1)};
  std::array<int, 2> whole{}, half{};
  for (size_t e = 0; e < elements; ++e) {
    const Element& element = room_.patches.elements[e];
    const bool is_of_screen = room_.patches.PatchOf(static_cast<int>(e)).material == 1;
    const std::vector<Eigen::Vector3d> points = PointsOver(element.origin, element.edge_u, element.edge_v);
    for (size_t k = 0; k < 2; ++k) {
      const auto share = [&](double grown_m) {
        return ShareThrough(Grown(kScreen, grown_m), points, luminaires[k]);
      };
      const bool is_crossed = penumbra[3 * e + k];
      if (is_of_screen || share(kMarginM) <= 0 || share(-kMarginM) >= 1) {
        EXPECT_FALSE(is_crossed) << element.center.transpose() << ", luminaire " << k;
        ++whole[k];
      } else if (std::abs(share(0) - 0.5) <= 0.25) {
        EXPECT_TRUE(is_crossed) << element.center.transpose() << ", luminaire " << k;
        ++half[k];
      }
    }
    EXPECT_EQ(penumbra[3 * e + 2], penumbra[3 * e] || penumbra[3 * e + 1]) << element.center.transpose();
  }
  // Of 760 elements of the room and 48 of the screen.
  std::printf("whole: %d and %d elements, half: %d and %d of %zu\n", whole[0], whole[1], half[0], half[1],
              elements);
  for (size_t k = 0; k < 2; ++k) {
    EXPECT_GE(whole[k], 600) << k;
    EXPECT_GE(half[k], 20) << k;
  }
  // A reading is the mean over its own small head: no edge spoils it.
  EXPECT_FALSE(penumbra.back());
}

}  // namespace
}  // namespace luxfit
