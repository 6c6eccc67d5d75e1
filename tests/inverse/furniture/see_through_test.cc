// Views drawn from a pattern on the surfaces of a room, with or without what the mesh has.
#include "inverse/furniture/internal/see_through.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "forward/changes/pieces.h"
#include "inverse/furniture/internal/mesh_agreement.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

constexpr int kStates = 3;

Scene Room() {
  return support::ClosedRoom({4, 3, 2.5}, {"wall", "wall", "wall", "wall", "floor", "ceiling"});
}

Scene With(Scene scene, const Eigen::AlignedBox3d& box, const std::string& material) {
  support::AddBox(scene, box, support::Facing::kOutward, {material});
  return scene;
}

const Eigen::AlignedBox3d kCrate(Eigen::Vector3d(1.6, 1.1, 0), Eigen::Vector3d(2.4, 1.9, 0.9));

// Returns ln Y of a matt place; a mirror's depends on where one stands.
float Pattern(const Eigen::Vector3d& p, int material, int state, const Eigen::Vector3d& along,
              bool is_mirror) {
  const double k = 2 + state;
  double y = 0.4 * std::sin(k * p.x() + 3 * p.y() + material) + 0.3 * std::cos(4 * p.y() - k * p.z() + state);
  if (is_mirror) y += 0.5 * std::sin(9 * along.x() + 7 * along.y() + state);
  return static_cast<float>(y);
}

SignatureView Draw(const Scene& scene, const Eigen::Vector3d& eye, const std::string& mirror) {
  SignatureView view;
  view.width_px = 160, view.height_px = 120, view.states = kStates;
  view.pixel_from_ray << 90, 0, 79.5, 0, 90, 59.5, 0, 0, 1;
  const Eigen::Vector3d forward = (Eigen::Vector3d(2, 1.5, 0.5) - eye).normalized(),
                        right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d cam_from_world;
  cam_from_world << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  view.cam_from_world.linear() = cam_from_world;
  view.cam_from_world.translation() = -cam_from_world * eye;
  const RayScene rays(scene);
  for (int v = 0; v < view.height_px; ++v) {
    for (int u = 0; u < view.width_px; ++u) {
      const Eigen::Vector3d along =
          (cam_from_world.transpose() * (view.pixel_from_ray.inverse() * Eigen::Vector3d(u, v, 1)))
              .normalized();
      const RayHit hit = rays.Trace(eye, along);
      const int material = scene.facets[static_cast<size_t>(hit.facet)].material;
      const bool is_mirror = scene.materials[static_cast<size_t>(material)] == mirror;
      for (int s = 0; s < kStates; ++s)
        view.log_luminance.push_back(Pattern(eye + hit.distance * along, material, s, along, is_mirror));
    }
  }
  view.variance.assign(view.log_luminance.size(), 0);
  return view;
}

std::vector<SignatureView> Views(const Scene& scene, const std::string& mirror = "") {
  std::vector<SignatureView> views;
  for (const Eigen::Vector3d& eye :
       {Eigen::Vector3d(0.3, 0.3, 1.6), Eigen::Vector3d(0.3, 2.7, 1.7), Eigen::Vector3d(3.7, 0.3, 1.5),
        Eigen::Vector3d(3.7, 2.7, 1.8), Eigen::Vector3d(2, 0.2, 1.9), Eigen::Vector3d(2, 2.8, 2),
        Eigen::Vector3d(3.7, 1.5, 1.6)})
    views.push_back(Draw(scene, eye, mirror));
  return views;
}

SeeThrough LookAt(const Scene& mesh, const std::vector<SignatureView>& views) {
  return LookThrough(mesh, {}, RayScene(mesh), LoosePieces(mesh).at(0), views, 0.015, 0.1);
}

TEST(SeeThrough, ViewsSeeThroughWhatIsNotThere) {
  const SeeThrough seen = LookAt(With(Room(), kCrate, "crate"), Views(Room()));
  EXPECT_GT(seen.judged_m2, 0.5);
  EXPECT_GT(seen.through_m2, 0.8 * seen.judged_m2);
  EXPECT_LT(seen.confirmed_m2, 0.1 * seen.judged_m2);
  EXPECT_GE(__builtin_popcountll(seen.views), 4);
}

TEST(SeeThrough, ViewsConfirmWhatIsThere) {
  const Scene room = With(Room(), kCrate, "crate");
  const SeeThrough seen = LookAt(room, Views(room));
  EXPECT_GT(seen.judged_m2, 0.5);
  EXPECT_GT(seen.confirmed_m2, 0.9 * seen.judged_m2);
  EXPECT_EQ(seen.through_m2, 0);
}

TEST(SeeThrough, AMirrorIsNeitherConfirmedNorSeenThrough) {
  const Scene room = With(Room(), kCrate, "mirror");
  const SeeThrough seen = LookAt(room, Views(room, "mirror"));
  EXPECT_LT(seen.confirmed_m2, 0.2 * seen.judged_m2);
  EXPECT_LT(seen.through_m2, 0.05 * seen.judged_m2);
}

// The wall behind lies so near that what views see there tells nothing.
TEST(SeeThrough, WhatLiesFlatOnAWallIsNot) {
  const Eigen::AlignedBox3d board(Eigen::Vector3d(0, 1, 0.5), Eigen::Vector3d(0.03, 2, 1.5));
  const SeeThrough seen = LookAt(With(Room(), board, "board"), Views(Room()));
  EXPECT_GT(seen.judged_m2, 0.3);
  EXPECT_EQ(seen.through_m2, 0);
}

}  // namespace
}  // namespace luxfit
